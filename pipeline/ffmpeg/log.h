#pragma once

#include <string>

namespace rinkaku::ffmpeg {

/// FFmpeg's words for an error code, e.g. "No space left on device".
std::string error_text(int code);

/// Keeps the FFmpeg libraries quiet on standard error and hears what one of their contexts (AVFormatContext,
/// AVCodecContext) complains about. The first listener of a process silences the libraries for good.
///
/// A threaded decoder is heard as a whole if its `opaque` points at its own context. The context must live as long as
/// the listener or never log again. Thread-safe.
class LogListener {
 public:
  explicit LogListener(const void* context);
  ~LogListener();
  LogListener(const LogListener&) = delete;
  LogListener& operator=(const LogListener&) = delete;

  int errors() const;        ///< complaints heard so far
  std::string last() const;  ///< the last of them, one line; empty if there was none
  void clear();

 private:
  const void* context_;
};

/// `listener`'s last complaint, or else the words for `code`.
std::string complaint(const LogListener& listener, int code);

}  // namespace rinkaku::ffmpeg

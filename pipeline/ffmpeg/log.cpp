#include "pipeline/ffmpeg/log.h"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <map>
#include <mutex>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/error.h>
#include <libavutil/log.h>
}

namespace rinkaku::ffmpeg {
namespace {

struct Heard {
  int errors = 0;
  std::string last;
};

struct Ledger {
  std::mutex mutex;
  std::map<const void*, Heard> heard;
};

Ledger& ledger() {
  // Never destroyed: codec threads may log while the process ends.
  static auto* const only = new Ledger;
  return *only;
}

// Decoders' threads log with copies of the context, which share its `opaque`.
const void* origin(const void* context) {
  const auto* const* type = static_cast<const AVClass* const*>(context);
  if (!context || *type != avcodec_get_class()) return context;
  const void* opaque = static_cast<const AVCodecContext*>(context)->opaque;
  return opaque ? opaque : context;
}

void listen(void* context, int level, const char* format, va_list arguments) {
  if (level > AV_LOG_ERROR) return;
  std::lock_guard lock(ledger().mutex);
  const auto found = ledger().heard.find(origin(context));
  if (found == ledger().heard.end()) return;
  std::array<char, 512> line{};
  std::vsnprintf(line.data(), line.size(), format, arguments);
  std::string text(line.data());
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ' || text.back() == '.')) text.pop_back();
  ++found->second.errors;
  found->second.last = std::move(text);
}

}  // namespace

std::string error_text(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  return text.data();
}

LogListener::LogListener(const void* context) : context_(context) {
  static std::once_flag once;
  std::call_once(once, [] { av_log_set_callback(listen); });
  std::lock_guard lock(ledger().mutex);
  ledger().heard[context_] = {};
}

LogListener::~LogListener() {
  std::lock_guard lock(ledger().mutex);
  ledger().heard.erase(context_);
}

int LogListener::errors() const {
  std::lock_guard lock(ledger().mutex);
  return ledger().heard[context_].errors;
}

std::string LogListener::last() const {
  std::lock_guard lock(ledger().mutex);
  return ledger().heard[context_].last;
}

void LogListener::clear() {
  std::lock_guard lock(ledger().mutex);
  ledger().heard[context_] = {};
}

std::string complaint(const LogListener& listener, int code) {
  std::string last = listener.last();
  return last.empty() ? error_text(code) : last;
}

}  // namespace rinkaku::ffmpeg

#pragma once

#include <memory>

#include "pipeline/ffmpeg/handles.h"

namespace rinkaku::source {

/// Gives a decoder memory for its pictures on large pages, where they are large: a 1080p frame is then found through
/// two entries of the processor's page table cache instead of 760, in every stage that touches it.
///
/// Must outlive the decoder; pictures may outlive both.
class FrameMemory {
 public:
  FrameMemory();
  ~FrameMemory();
  FrameMemory(const FrameMemory&) = delete;
  FrameMemory& operator=(const FrameMemory&) = delete;

  /// Before the decoder is opened. Makes the decoder's `opaque` point at this.
  void serve(AVCodecContext& decoder);

 private:
  struct Pool;
  static int get_buffer(AVCodecContext* decoder, AVFrame* frame, int flags);
  std::unique_ptr<Pool> pool_;
};

}  // namespace rinkaku::source

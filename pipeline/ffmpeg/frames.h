#pragma once

#include "pipeline/ffmpeg/handles.h"
#include "pipeline/frame/frame.h"

namespace rinkaku::ffmpeg {

/// A Frame on the decoder's own memory: no sample is copied. It is let go once the decoder holds the AVFrame's buffers
/// no more. Takes the AVFrame over.
/// Only planes, format and storage are set. Precondition: the format's layout is the AVFrame's.
Frame wrap(FramePtr decoded, const PictureFormat& format);

/// An AVFrame on a Frame's memory, which it keeps alive; no sample is copied. Size, format, colour and aspect are set.
/// Throws Error (Runtime) when memory runs out.
FramePtr wrap(const Frame& frame);

}  // namespace rinkaku::ffmpeg

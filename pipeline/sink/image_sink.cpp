#include "pipeline/sink/image_sink.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "pipeline/frame/error.h"
#include "pipeline/sink/output_url.h"

namespace rinkaku::sink {

ImageSink::ImageSink(const Options& options, const Incoming& incoming, const AVCodec& codec)
    : options_(options),
      input_(incoming.copy_streams_from),
      pattern_(ffmpeg::parse_number_pattern(options.path)),
      packet_(av_packet_alloc()) {
  if (!packet_) throw runtime_failure(options_.path, "out of memory");
  if (pattern_) {
    // The folder is checked with the first file's name.
    const files::PendingFile probe(pattern_->file_name(0), true);
    const auto existing = ffmpeg::existing_numbers(*pattern_);
    if (!existing.empty() && !options_.overwrite) {
      throw input_error(pattern_->file_name(existing.front()), "exists already",
                        "give --force to write over it, or choose another output");
    }
  } else {
    const files::PendingFile probe(options_.path, options_.overwrite, input_);
  }
  encoder_ = std::make_unique<Encoder>(codec, nullptr, options_, incoming);
}

void ImageSink::write(const Frame& frame) {
  if (!pattern_ && frames_ > 0) {
    throw input_error(options_.path, "holds one image and more frames came", "give a pattern like out/%04d.png");
  }
  encoder_->send(frame, frames_++, 1);
  drain();
}

void ImageSink::drain() {
  std::int64_t number = 0;
  while (encoder_->receive(*packet_, &number)) {
    write_file(pattern_ ? pattern_->file_name(number) : options_.path, *packet_);
    av_packet_unref(packet_.get());
  }
}

void ImageSink::write_file(const std::string& path, const AVPacket& packet) {
  const files::PendingFile& file = pending_.emplace_back(path, true, input_);
  AVIOContext* io = nullptr;
  int code = avio_open(&io, output_url(file).c_str(), AVIO_FLAG_WRITE);
  if (code < 0) throw_write_error(path, code, pending_.size() == 1);
  avio_write(io, packet.data, packet.size);
  avio_flush(io);
  code = io->error;
  const int closed = avio_closep(&io);
  if (code < 0 || closed < 0) throw_write_error(path, code < 0 ? code : closed);
}

void ImageSink::finish() {
  if (finished_) return;
  if (frames_ == 0) throw runtime_failure(options_.path, "no frame came, so nothing is written");
  encoder_->flush();
  drain();
  for (files::PendingFile& file : pending_) file.commit();
  finished_ = true;
}

}  // namespace rinkaku::sink

#include "apps/rinkaku/picture_file.h"

#include <filesystem>

#include "pipeline/files/pending_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/sink/output_names.h"
#include "pipeline/sink/sink.h"

namespace rinkaku::app {

void refuse_own_input(const std::string& output, const std::string& input) {
  std::error_code absent;
  if (std::filesystem::equivalent(output, input, absent)) {
    throw input_error(output, "is the input itself", "choose another output");
  }
}

void check_picture_file(const std::string& picture, const std::string& input, bool force) {
  const files::PendingFile checked(picture, force);
  refuse_own_input(picture, input);
  if (std::filesystem::path(picture).extension() != ".png" || sink::is_sequence(picture)) {
    throw input_error(picture, "is no name of a PNG file", "give one that ends in .png");
  }
}

void write_picture_file(const Frame& frame, const std::string& picture, bool force) {
  sink::Options to;
  to.path = picture;
  to.overwrite = force;
  sink::Incoming incoming;
  incoming.format = frame.format;
  const auto sink = sink::open(to, incoming);
  sink->write(frame);
  sink->finish();
}

}  // namespace rinkaku::app

#include "pipeline/source/input_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <glob.h>
#include <unistd.h>

#include "pipeline/ffmpeg/number_pattern.h"
#include "pipeline/frame/error.h"

namespace rinkaku::source {
namespace {

namespace fs = std::filesystem;
using ffmpeg::error_text;

// "file:" keeps names like "take:2.mp4" from being taken for a protocol.
std::string file_url(const std::string& path) { return "file:" + path; }

void check_readable(const std::string& path) {
  if (fs::is_directory(path)) {
    throw input_error(path, "is a folder, not a video",
                      "for the images in it give a pattern like " + path + "/%04d.png");
  }
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    const int code = errno;
    const bool absent = code == ENOENT || code == ENOTDIR;
    throw input_error(path, absent ? "there is no such file" : std::string("can't be read: ") + std::strerror(code),
                      absent ? "check the path" : "check its permissions");
  }
  ::close(file);
  std::error_code ignored;
  if (fs::is_regular_file(path) && fs::file_size(path, ignored) == 0) {
    throw input_error(path, "the file is empty", "give a video or an image");
  }
}

Input numbered(const std::string& path, const ffmpeg::NumberPattern& pattern) {
  const auto numbers = existing_numbers(pattern);
  if (numbers.empty()) throw input_error(path, "no file of that pattern exists", "check the folder and the pattern");
  std::size_t count = 1;
  while (count < numbers.size() && numbers[count] == numbers[count - 1] + 1) ++count;
  Input input{path, path, true, numbers.front(), static_cast<std::int64_t>(count), {}};
  if (count < numbers.size()) {
    input.missing = pattern.file_name(numbers[count - 1] + 1) + " is missing: stopped there, " +
                    std::to_string(numbers.size() - count) + " later pictures are left out";
  }
  check_readable(pattern.file_name(numbers.front()));
  return input;
}

bool is_glob(const std::string& path) {
  return fs::path(path).filename().string().find_first_of("*?[") != std::string::npos;
}

std::vector<std::string> expand_glob(const std::string& path) {
  glob_t found{};
  std::vector<std::string> names;
  if (::glob(path.c_str(), 0, nullptr, &found) == 0) names.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (names.empty()) throw input_error(path, "no file matches", "check the pattern");
  return names;
}

// Demuxers that make pictures of any text.
bool draws_text(const AVInputFormat& format) {
  constexpr std::array<std::string_view, 5> names{"tty", "bin", "xbin", "adf", "idf"};
  return std::find(names.begin(), names.end(), format.name) != names.end();
}

void set_options(const Input& input, const OpenOptions& options, ffmpeg::Dictionary& dictionary) {
  // A playlist can't make this program talk to the network.
  dictionary.set("protocol_whitelist", "file,crypto,data");
  if (!input.image_sequence) {
    dictionary.set("pattern_type", "none");
    return;
  }
  const std::string rate = std::to_string(options.image_rate.num) + "/" + std::to_string(options.image_rate.den);
  dictionary.set("framerate", rate.c_str());
  if (input.first_number < 0) {
    dictionary.set("pattern_type", "glob");
  } else {
    dictionary.set("pattern_type", "sequence");
    dictionary.set("start_number", std::to_string(input.first_number).c_str());
    dictionary.set("start_number_range", "1");
  }
}

}  // namespace

Input find_input(const std::string& path) {
  if (path.empty()) throw input_error("", "the name of the input is empty", "give a video, an image or a pattern");
  if (fs::exists(path)) {
    check_readable(path);
    return {path, file_url(path), false, 0, 0, {}};
  }
  if (const auto pattern = ffmpeg::parse_number_pattern(path)) return numbered(path, *pattern);
  if (is_glob(path)) {
    const auto names = expand_glob(path);
    check_readable(names.front());
    return {path, path, true, -1, static_cast<std::int64_t>(names.size()), {}};
  }
  check_readable(path);
  return {path, file_url(path), false, 0, 0, {}};
}

std::vector<std::string> input_files(const std::string& path) {
  if (fs::exists(path)) return {path};
  if (const auto pattern = ffmpeg::parse_number_pattern(path)) {
    std::vector<std::string> names;
    for (const std::int64_t number : existing_numbers(*pattern)) names.push_back(pattern->file_name(number));
    return names;
  }
  return is_glob(path) ? expand_glob(path) : std::vector<std::string>{path};
}

Demuxer open_demuxer(const Input& input, const OpenOptions& options) {
  Demuxer out;
  AVFormatContext* context = avformat_alloc_context();
  if (!context) throw runtime_failure(input.name, "out of memory");
  out.listener = std::make_unique<ffmpeg::LogListener>(context);
  ffmpeg::Dictionary dictionary;
  set_options(input, options, dictionary);
  const AVInputFormat* format = input.image_sequence ? av_find_input_format("image2") : nullptr;
  int code = avformat_open_input(&context, input.url.c_str(), format, dictionary.address());
  const char* remedy = "give a video or image that ffprobe can read, or mend the file";
  if (code < 0)
    throw input_error(input.name, "is no video that can be read: " + complaint(*out.listener, code), remedy);
  out.context.reset(context);
  if (draws_text(*context->iformat)) throw input_error(input.name, "is a text, not a video", remedy);
  code = avformat_find_stream_info(context, nullptr);
  if (code < 0) throw input_error(input.name, "its streams can't be read: " + complaint(*out.listener, code), remedy);
  out.video_stream = av_find_best_stream(context, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (out.video_stream < 0) throw input_error(input.name, "holds no pictures", "give a file with a video stream");
  for (unsigned i = 0; i < context->nb_streams; ++i) {
    if (static_cast<int>(i) != out.video_stream) context->streams[i]->discard = AVDISCARD_ALL;
  }
  return out;
}

ffmpeg::CodecPtr open_decoder(const Input& input, const Demuxer& demuxer, const OpenOptions& options) {
  const AVStream& stream = *demuxer.context->streams[demuxer.video_stream];
  const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
  if (!codec) {
    throw input_error(input.name, std::string("no decoder for ") + avcodec_get_name(stream.codecpar->codec_id),
                      "convert it to another codec");
  }
  ffmpeg::CodecPtr decoder(avcodec_alloc_context3(codec));
  if (!decoder) throw runtime_failure(input.name, "out of memory");
  const ffmpeg::LogListener listener(decoder.get());
  avcodec_parameters_to_context(decoder.get(), stream.codecpar);
  decoder->pkt_timebase = stream.time_base;
  decoder->thread_count = options.threads;
  decoder->opaque = decoder.get();
  decoder->err_recognition = AV_EF_CRCCHECK;
  decoder->thread_type = FF_THREAD_FRAME | FF_THREAD_SLICE;
  const int code = avcodec_open2(decoder.get(), codec, nullptr);
  if (code < 0) {
    throw input_error(input.name, std::string("the decoder ") + codec->name + " refuses: " + complaint(listener, code),
                      "convert it to another codec");
  }
  return decoder;
}

}  // namespace rinkaku::source

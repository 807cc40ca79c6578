#include "recordings/generator/film.h"

#include <algorithm>
#include <cmath>

#include "pipeline/frame/error.h"
#include "recordings/generator/parallel.h"
#include "recordings/generator/random.h"

namespace rinkaku::recordings {
namespace {

// sRGB's curve with a shoulder, so that lights roll off instead of clipping.
float tone(float light) {
  constexpr float knee = 0.62f;
  float v = std::max(0.0f, light);
  if (v > knee) v = knee + (1 - knee) * (1 - std::exp(-(v - knee) / (1 - knee)));
  const float s = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
  return std::min(1.0f, s + 0.10f * s * (1 - s) * (2 * s - 1));  // a little more contrast
}

}  // namespace

cv::Mat3f develop(const cv::Mat3f& light, const FilmOptions& options, int frame) {
  cv::Mat3f out(light.size());
  const float cx = 0.5f * static_cast<float>(light.cols - 1), cy = 0.5f * static_cast<float>(light.rows - 1);
  parallel_for(light.rows, [&](int y) {
    for (int x = 0; x < light.cols; ++x) {
      const float dx = (static_cast<float>(x) - cx) / cx, dy = (static_cast<float>(y) - cy) / cx;
      const float r2 = (dx * dx + dy * dy) / (1 + cy * cy / (cx * cx));
      const float gain = options.exposure * (1 - options.vignette * r2);
      for (int i = 0; i < 3; ++i) {
        const float clean = light(y, x)[i] * gain;
        const std::uint32_t ux = static_cast<std::uint32_t>(x), uy = static_cast<std::uint32_t>(y);
        const std::uint32_t key = static_cast<std::uint32_t>(frame * 3 + i);
        const float unit =
            gaussian({uniform({options.seed, key, ux, uy, 1}), uniform({options.seed, key, ux, uy, 2})}).x;
        const float sigma =
            std::sqrt(std::max(0.0f, clean) / options.electrons +
                      options.read_electrons * options.read_electrons / options.electrons / options.electrons);
        out(y, x)[i] = tone(clean + sigma * unit);
      }
    }
  });
  return out;
}

cv::Mat1b to_yuv420(const cv::Mat3f& rgb) {
  const int w = rgb.cols, h = rgb.rows;
  cv::Mat1b out(h * 3 / 2, w);
  cv::Mat2f chroma(h, w);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const cv::Vec3f& c = rgb(y, x);
      const float luma = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
      out(y, x) = cv::saturate_cast<uchar>(16 + 219 * luma);
      chroma(y, x) = {(c[2] - luma) / 1.8556f, (c[0] - luma) / 1.5748f};
    }
  }
  uchar* plane[2] = {out.ptr(h), out.ptr(h) + (w / 2) * (h / 2)};
  for (int y = 0; y < h / 2; ++y) {
    for (int x = 0; x < w / 2; ++x) {
      cv::Vec2f sum(0, 0);
      for (int j = 0; j < 2; ++j) {
        for (int i = -1; i <= 1; ++i) {
          sum += chroma(2 * y + j, std::max(0, 2 * x + i)) * ((i == 0 ? 2 : 1) / 8.0f);
        }
      }
      for (int i = 0; i < 2; ++i) plane[i][y * (w / 2) + x] = cv::saturate_cast<uchar>(128 + 224 * sum[i]);
    }
  }
  return out;
}

cv::Mat3b to_bgr(const cv::Mat3f& rgb) {
  cv::Mat3b out(rgb.size());
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      for (int i = 0; i < 3; ++i) out(y, x)[2 - i] = cv::saturate_cast<uchar>(255 * rgb(y, x)[i]);
    }
  }
  return out;
}

Encoder::Encoder(const std::string& file, int width_px, int height_px, double rate, Kind kind, int quality)
    : file_(file) {
  const bool matte = kind == Kind::Matte;
  const std::string tags = "-color_primaries bt709 -color_trc bt709 -colorspace bt709 -color_range tv ";
  const std::string codec = matte ? "-c:v ffv1 -level 3 -coder 1 -context 1 -g 300 -slices 4 -pix_fmt gray "
                                  : "-c:v libx264 -preset veryslow -tune grain -pix_fmt yuv420p -x264-params "
                                    "threads=2:lookahead-threads=1 -crf " +
                                        std::to_string(quality) + " " + tags +
                                        "-chroma_sample_location left -movflags +faststart ";
  const std::string call =
      "ffmpeg -nostdin -loglevel error -y -f rawvideo -pix_fmt " + std::string(matte ? "gray" : "yuv420p " + tags) +
      " -video_size " + std::to_string(width_px) + "x" + std::to_string(height_px) + " -framerate " +
      std::to_string(rate) + " -i - -map_metadata -1 -fflags +bitexact -flags:v +bitexact " + codec + "'" + file + "'";
  pipe_ = popen(call.c_str(), "w");
  if (!pipe_) throw runtime_failure(file, "the ffmpeg program could not be started", "install ffmpeg");
}

Encoder::~Encoder() {
  if (pipe_) pclose(pipe_);
}

void Encoder::write(const cv::Mat1b& picture) {
  if (std::fwrite(picture.data, 1, picture.total(), pipe_) != picture.total()) {
    throw runtime_failure(file_, "ffmpeg took no more pictures", "see its message above");
  }
}

void Encoder::finish() {
  const int status = pclose(pipe_);
  pipe_ = nullptr;
  if (status != 0) throw runtime_failure(file_, "ffmpeg failed", "see its message above");
}

}  // namespace rinkaku::recordings

#include "pipeline/window/presenter.h"

#include <array>
#include <cstdlib>

#include <epoxy/gl.h>

#include "pipeline/gl/context.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/source/media_tools.h"

namespace rinkaku::window {
namespace {

using test::picture;

class PresenterTest : public test::GlTest {};

using Rgb = std::array<int, 3>;

// Every sample of a component gets one value.
Frame flat(const PictureFormat& format, const std::array<int, 4>& codes) {
  FramePool pool;
  Frame frame = pool.allocate(format);
  for (int c = 0; c < format.pixels.components; ++c) {
    const Component& component = format.pixels.component[static_cast<std::size_t>(c)];
    const Plane& plane = frame.planes[static_cast<std::size_t>(component.plane)];
    const int code = codes[static_cast<std::size_t>(c)] << component.shift_bits;
    for (int y = 0; y < format.component_height_px(c); ++y) {
      for (int x = 0; x < format.component_width_px(c); ++x) {
        std::uint8_t* at = plane.data + y * plane.stride_bytes + x * component.step_bytes + component.offset_bytes;
        at[0] = static_cast<std::uint8_t>(code);
        if (component.depth_bits + component.shift_bits > 8) at[1] = static_cast<std::uint8_t>(code >> 8);
      }
    }
  }
  return frame;
}

// What a window of that size shows, its rows from the top.
std::vector<Rgb> shown(Presenter& presenter, int width, int height) {
  GLuint texture = 0, framebuffer = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, GL_RGBA8, width, height);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
  presenter.draw(width, height, framebuffer);
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteTextures(1, &texture);
  std::vector<Rgb> pixels;
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* at =
          rgba.data() +
          (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 4;
      pixels.push_back({at[0], at[1], at[2]});
    }
  }
  return pixels;
}

int difference(const Rgb& a, const Rgb& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

constexpr ColourTags bt601_limited{6, 6, 6, ColourTags::Range::Limited, 1},
    bt709_limited{1, 1, 1, ColourTags::Range::Limited, 1};
constexpr ColourTags bt709_full{1, 1, 1, ColourTags::Range::Full, 1};

// Red in the code values that the standards give for it, rounded: that alone is up to 2 in R, G and B.
TEST_F(PresenterTest, ColoursAreThoseOfTheStandards) {
  struct Case {
    const char* pixels;
    ColourTags colour;
    std::array<int, 4> red;
  };
  const Case cases[] = {{"yuv420p", bt601_limited, {81, 90, 240, 0}},
                        {"yuv420p", bt709_limited, {63, 102, 240, 0}},
                        {"yuv422p", bt709_limited, {63, 102, 240, 0}},
                        {"yuv444p", bt709_full, {54, 99, 255, 0}},
                        {"nv12", bt709_limited, {63, 102, 240, 0}},
                        {"yuyv422", bt601_limited, {81, 90, 240, 0}},
                        {"uyvy422", bt601_limited, {81, 90, 240, 0}},
                        {"yuv420p10le", bt709_limited, {250, 409, 960, 0}},
                        {"p010le", bt709_limited, {250, 409, 960, 0}},
                        {"rgb24", {}, {255, 0, 0, 0}},
                        {"gbrp", {}, {255, 0, 0, 0}}};
  for (const Presenter::Way way : {Presenter::Way::Shader, Presenter::Way::Cpu}) {
    Presenter presenter(way);
    for (const Case& c : cases) {
      presenter.take(flat(picture(c.pixels, 16, 8, c.colour), c.red));
      const auto pixels = shown(presenter, 16, 8);
      EXPECT_LE(difference(pixels[40], {255, 0, 0}), 3)
          << c.pixels << " " << pixels[40][0] << " " << pixels[40][1] << " " << pixels[40][2];
    }
  }
}

TEST_F(PresenterTest, GreyKeepsItsRange) {
  for (const Presenter::Way way : {Presenter::Way::Shader, Presenter::Way::Cpu}) {
    Presenter presenter(way);
    ColourTags full, limited;
    full.range = ColourTags::Range::Full;
    limited.range = ColourTags::Range::Limited;
    presenter.take(flat(picture("gray", 16, 8, full), {100, 0, 0, 0}));
    EXPECT_LE(difference(shown(presenter, 16, 8)[9], {100, 100, 100}), 1);
    presenter.take(flat(picture("gray", 16, 8, limited), {126, 0, 0, 0}));  // (126 - 16) / 219 of 255
    EXPECT_LE(difference(shown(presenter, 16, 8)[9], {128, 128, 128}), 1);
  }
}

// libyuv takes the nearest chroma sample where the shader interpolates: smooth chroma, any luma.
TEST_F(PresenterTest, BothWaysShowTheSamePicture) {
  const PictureFormat format = picture("yuv420p", 64, 48, bt709_limited);
  Frame frame = test::noise(format, 1);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      std::uint8_t& luma = frame.planes[0].data[y * frame.planes[0].stride_bytes + x];
      luma = static_cast<std::uint8_t>(60 + luma / 2);
    }
  }
  for (std::size_t p = 1; p < 3; ++p) {
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 32; ++x) {
        frame.planes[p].data[y * frame.planes[p].stride_bytes + x] = static_cast<std::uint8_t>(110 + x / 2 + y / 2);
      }
    }
  }
  Presenter shader(Presenter::Way::Shader), cpu(Presenter::Way::Cpu);
  shader.take(frame);
  cpu.take(frame);
  const auto a = shown(shader, 64, 48), b = shown(cpu, 64, 48);
  int largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, difference(a[i], b[i]));
  // Chroma a step of 1 apart is 2.1 of blue, and libyuv's fixed point is right to 1 or 2.
  EXPECT_LE(largest, 5);
}

TEST_F(PresenterTest, PictureIsUprightAndOnItsPlace) {
  const PictureFormat format = picture("gray", 16, 8);
  Frame frame = flat(format, {0, 0, 0, 0});
  frame.planes[0].data[2 * frame.planes[0].stride_bytes + 3] = 255;
  for (const Presenter::Way way : {Presenter::Way::Shader, Presenter::Way::Cpu}) {
    Presenter presenter(way);
    presenter.take(frame);
    const auto pixels = shown(presenter, 16, 8);
    for (std::size_t i = 0; i < pixels.size(); ++i) EXPECT_EQ(pixels[i][0], i == 2 * 16 + 3 ? 255 : 0) << i;
  }
}

TEST_F(PresenterTest, AspectIsKeptInAnyWindow) {
  Presenter presenter(Presenter::Way::Cpu);
  presenter.take(flat(picture("gray", 16, 8), {255, 0, 0, 0}));
  const auto tall = shown(presenter, 32, 64);  // 32 x 16 of it, 24 rows of black above and below
  EXPECT_EQ(tall[23 * 32 + 5][0], 0);
  EXPECT_EQ(tall[24 * 32 + 5][0], 255);
  EXPECT_EQ(tall[39 * 32 + 5][0], 255);
  EXPECT_EQ(tall[40 * 32 + 5][0], 0);
  PictureFormat narrow = picture("gray", 16, 8);
  narrow.sample_aspect = {1, 2};
  const Presenter::Place place = Presenter::place(narrow, 100, 40);
  EXPECT_EQ(place.width_px, 40);
  EXPECT_EQ(place.height_px, 40);
  EXPECT_EQ(place.x_px, 30);
}

TEST_F(PresenterTest, WithoutAPictureItIsBlack) {
  Presenter presenter(Presenter::Way::Cpu);
  EXPECT_EQ(shown(presenter, 4, 4)[5], (Rgb{0, 0, 0}));
}

}  // namespace
}  // namespace rinkaku::window

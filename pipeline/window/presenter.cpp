#include "pipeline/window/presenter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "embedded/plate.frag.h"
#include "embedded/plate.vert.h"
#include "pipeline/frame/colour_matrix.h"

namespace rinkaku::window {
namespace {

gl::TextureHandle make_texture(GLenum format, int width_px, int height_px) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  gl::TextureHandle texture(name);
  glTextureStorage2D(name, 1, format, width_px, height_px);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

// From code values less their offset to RGB in 0..1: the inverse of what compositing uses.
struct FromCode {
  glm::mat3 matrix{1};
  glm::vec3 offset{0};
};

FromCode from_code(const PictureFormat& format) {
  const auto weights = component_weights(format);
  FromCode result;
  if (format.pixels.model == ColourModel::Grey) {
    const float range = weights[0].red + weights[0].green + weights[0].blue;
    result.matrix = glm::mat3(1.0f / (255.0f * range));
    result.offset = glm::vec3(weights[0].alpha * 255.0f);
    return result;
  }
  glm::mat3 code_from_rgb(1);  // columns are R, G, B
  for (int row = 0; row < 3; ++row) {
    const auto& w = weights[static_cast<std::size_t>(row)];
    code_from_rgb[0][row] = w.red * 255.0f;
    code_from_rgb[1][row] = w.green * 255.0f;
    code_from_rgb[2][row] = w.blue * 255.0f;
    result.offset[row] = w.alpha * 255.0f;
  }
  result.matrix = glm::inverse(code_from_rgb);
  return result;
}

}  // namespace

Presenter::Presenter(Way way) : way_(way), framebuffer_(gl::make_framebuffer()) {
  if (way_ == Way::Cpu) return;
  const std::string_view vertex[] = {embedded::plate_vert}, fragment[] = {embedded::plate_frag};
  program_ = gl::Program("plate", {}, vertex, fragment);
  nothing_ = gl::make_vertex_array();
}

void Presenter::make_picture(int width_px, int height_px) {
  picture_ = make_texture(GL_RGBA8, width_px, height_px);
  glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, picture_.name(), 0);
}

void Presenter::take(const Frame& frame) {
  const PictureFormat& format = frame.format;
  if (!picture_ || format.width_px != format_.width_px || format.height_px != format_.height_px) {
    make_picture(format.width_px, format.height_px);
  }
  format_ = format;
  if (way_ == Way::Cpu) {
    const std::uint8_t* rgba = converter_.convert(frame);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(picture_.name(), 0, 0, 0, format.width_px, format.height_px, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    return;
  }
  upload_planes(frame);
  convert(frame);
}

void Presenter::upload_planes(const Frame& frame) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (int p = 0; p < frame.format.pixels.planes; ++p) {
    const Plane& plane = frame.planes[static_cast<std::size_t>(p)];
    if (!planes_[p] || plane_widths_[p] != plane.row_bytes || plane_heights_[p] != plane.rows) {
      planes_[p] = make_texture(GL_R8, plane.row_bytes, plane.rows);
      plane_widths_[p] = plane.row_bytes;
      plane_heights_[p] = plane.rows;
    }
    if (plane.stride_bytes > 0) {
      glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(plane.stride_bytes));
      glTextureSubImage2D(planes_[p].name(), 0, 0, 0, plane.row_bytes, plane.rows, GL_RED, GL_UNSIGNED_BYTE,
                          plane.data);
    } else {
      // Stored bottom up: OpenGL knows no negative stride.
      glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
      for (int y = 0; y < plane.rows; ++y) {
        glTextureSubImage2D(planes_[p].name(), 0, 0, y, plane.row_bytes, 1, GL_RED, GL_UNSIGNED_BYTE,
                            plane.data + y * plane.stride_bytes);
      }
    }
    glBindTextureUnit(static_cast<GLuint>(p), planes_[p].name());
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void Presenter::convert(const Frame& frame) {
  const PictureFormat& format = frame.format;
  const PixelFormat& pixels = format.pixels;
  const GLuint program = program_.name();
  for (int c = 0; c < pixels.components; ++c) {
    const Component& component = pixels.component[static_cast<std::size_t>(c)];
    const std::string at = "components[" + std::to_string(c) + "].";
    const auto set = [&](const char* member, int value) {
      glProgramUniform1i(program, program_.uniform((at + member).c_str()), value);
    };
    set("plane", component.plane);
    set("step_bytes", component.step_bytes);
    set("offset_bytes", component.offset_bytes);
    set("shift_bits", component.shift_bits);
    set("depth_bits", component.depth_bits);
  }
  glProgramUniform1i(program, program_.uniform("component_count"), pixels.components);
  glProgramUniform1i(program, program_.uniform("big_endian"), pixels.big_endian);
  glProgramUniform2i(program, program_.uniform("log2_chroma"), pixels.log2_chroma_width, pixels.log2_chroma_height);
  glProgramUniform2i(program, program_.uniform("chroma_size"), format.component_width_px(1),
                     format.component_height_px(1));
  // H.273's types 0, 2 and 4 lie on luma's column, and so do samples that nothing is said of.
  const int location = format.colour.chroma_location;
  glProgramUniform1i(program, program_.uniform("chroma_is_left"), location == 0 || location % 2 == 1);
  const FromCode code = from_code(format);
  glProgramUniformMatrix3fv(program, program_.uniform("rgb_from_code"), 1, GL_FALSE, &code.matrix[0][0]);
  glProgramUniform3f(program, program_.uniform("code_offset"), code.offset.x, code.offset.y, code.offset.z);
  glProgramUniform1i(program, program_.uniform("colour_model"),
                     pixels.model == ColourModel::Grey  ? 0
                     : pixels.model == ColourModel::Yuv ? 1
                                                        : 2);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, format.width_px, format.height_px);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_SCISSOR_TEST);
  glUseProgram(program);
  glBindVertexArray(nothing_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Presenter::Place Presenter::place(const PictureFormat& format, int width_px, int height_px) {
  if (format.width_px <= 0 || format.height_px <= 0) return {};
  const Rational aspect = format.sample_aspect;
  const double stretch = aspect.num > 0 && aspect.den > 0 ? aspect.value() : 1;
  const double picture = format.width_px * stretch / format.height_px;
  Place place;
  place.width_px = std::min(width_px, static_cast<int>(std::lround(height_px * picture)));
  place.height_px = std::min(height_px, static_cast<int>(std::lround(width_px / picture)));
  place.x_px = (width_px - place.width_px) / 2;
  place.y_px = (height_px - place.height_px) / 2;
  return place;
}

void Presenter::draw(int width_px, int height_px, GLuint framebuffer) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glDisable(GL_SCISSOR_TEST);
  glViewport(0, 0, width_px, height_px);
  const Place to = picture_ ? place(format_, width_px, height_px) : Place{};
  if (to.width_px < width_px || to.height_px < height_px) {
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  if (!picture_) return;
  const bool as_it_is = to.width_px == format_.width_px && to.height_px == format_.height_px;
  // The picture's rows run downwards, the window's upwards.
  glBlitNamedFramebuffer(framebuffer_.name(), framebuffer, 0, format_.height_px, format_.width_px, 0, to.x_px, to.y_px,
                         to.x_px + to.width_px, to.y_px + to.height_px, GL_COLOR_BUFFER_BIT,
                         as_it_is ? GL_NEAREST : GL_LINEAR);
}

}  // namespace rinkaku::window

// The GL wrappers: owned names, buffers, textures, programs and the target.

#include <cstdint>
#include <cstring>
#include <thread>
#include <type_traits>

#include <gtest/gtest.h>

#include "pipeline/gl/buffer.h"
#include "pipeline/gl/program.h"
#include "pipeline/gl/target.h"
#include "pipeline/gl/texture.h"
#include "tests/pipeline/passes/gl_test.h"

namespace rinkaku::test {
namespace {

class Gl : public GlTest {
 protected:
  void TearDown() override {
    if (IsSkipped()) return;
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  }
};

static_assert(!std::is_copy_constructible_v<gl::BufferHandle> &&
              std::is_nothrow_move_constructible_v<gl::BufferHandle>);
static_assert(!std::is_copy_constructible_v<gl::Program> && !std::is_copy_constructible_v<gl::Texture>);
static_assert(!std::is_copy_constructible_v<gl::Context>);

constexpr const char* whole_picture_vertex = R"(
const vec2 corners[3] = vec2[](vec2(-1, -1), vec2(3, -1), vec2(-1, 3));
void main() { gl_Position = vec4(corners[gl_VertexID], 0.5, 1); }
)";

gl::Program program(std::string_view fragment, std::initializer_list<std::string_view> defines = {}) {
  const std::string_view vertex_parts[] = {whole_picture_vertex};
  const std::string_view fragment_parts[] = {"layout(location = 0) out vec4 colour;", fragment};
  return gl::Program("test", std::vector<std::string_view>(defines), vertex_parts, fragment_parts);
}

// Draws over the whole viewport, at a depth of 0.5.
void draw(const gl::Program& p) {
  GLuint array = 0;
  glCreateVertexArrays(1, &array);
  const gl::VertexArrayHandle handle(array);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glDisable(GL_BLEND);
  glBindVertexArray(array);
  glUseProgram(p.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

TEST_F(Gl, ContextIsOpenGL45OrNewer) {
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  EXPECT_GE(major * 10 + minor, 45);
  EXPECT_FALSE(context().renderer().empty());
  EXPECT_EQ(context().software(), context().renderer().find("pipe") != std::string::npos);
}

TEST_F(Gl, AnotherThreadMayHaveAContextOfItsOwn) {
  bool ok = false;
  std::thread([&ok] {
    const auto own = gl::Context::headless();
    ok = glGetString(GL_RENDERER) != nullptr;
  }).join();
  EXPECT_TRUE(ok);
  EXPECT_NE(glGetString(GL_RENDERER), nullptr);  // this thread's is still current
}

TEST_F(Gl, HandlesFreeWhatTheyOwnOnce) {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  {
    gl::BufferHandle first(name);
    gl::BufferHandle second(std::move(first));
    EXPECT_EQ(second.name(), name);
    EXPECT_FALSE(first);
    gl::BufferHandle third;
    third = std::move(second);
    EXPECT_TRUE(glIsBuffer(name));
  }
  EXPECT_FALSE(glIsBuffer(name));
}

TEST_F(Gl, ProgramsGetTheirDefines) {
  gl::Target target;
  std::uint8_t rgba[4];
  for (bool green : {false, true}) {
    const char* fragment =
        "\n#ifdef GREEN\nvoid main() { colour = vec4(0, 1, 0, 1); }\n#else\n"
        "void main() { colour = vec4(1, 0, 0, 1); }\n#endif\n";
    const gl::Program p = green ? program(fragment, {"GREEN"}) : program(fragment);
    target.begin(1, 1);
    draw(p);
    target.read(1, 1, rgba);
    EXPECT_EQ(rgba[green ? 1 : 0], 255);
    EXPECT_EQ(rgba[green ? 0 : 1], 0);
  }
}

TEST_F(Gl, BrokenShadersAreReportedByNameInOneLine) {
  const int before = gl::made().programs;
  try {
    program("void main() { colour = nonsense; }");
    FAIL() << "compiled";
  } catch (const Error& error) {
    const std::string line = error.what();
    EXPECT_EQ(error.kind(), Error::Kind::Runtime);
    EXPECT_NE(line.find("shader test"), std::string::npos) << line;
    EXPECT_NE(line.find("nonsense"), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  // Compiles but does not link: nothing writes the input.
  EXPECT_THROW(program("in vec3 from_nowhere; void main() { colour = vec4(from_nowhere, 1); }"), Error);
  EXPECT_EQ(gl::made().programs, before);
}

// A colour for each pixel that tells where it is.
const char* const position_fragment = "void main() { colour = vec4(floor(gl_FragCoord.xy) / 255.0, 0.2, 1.0); }";

TEST_F(Gl, TargetReadsRowsFromWindowYZeroForOddSizes) {
  gl::Target target;
  const gl::Program p = program(position_fragment);
  // Growing, shrinking, and back: storage is kept, what is read is this frame's.
  for (const auto& [width, height] : {std::pair{1, 1}, {35, 29}, {3, 201}, {131, 7}, {35, 29}, {128, 128}}) {
    target.begin(width, height);
    draw(p);
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width) * height * 4 + 4, 77);
    target.read(width, height, rgba.data());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::uint8_t* at = rgba.data() + (y * width + x) * 4;
        ASSERT_EQ(at[0], x);
        ASSERT_EQ(at[1], y);
      }
    }
    EXPECT_EQ(rgba[rgba.size() - 1], 77);  // nothing is written past the end
  }
}

TEST_F(Gl, TargetBeginsEmpty) {
  gl::Target target;
  target.begin(20, 20);
  draw(program(position_fragment));
  glDepthMask(GL_FALSE);  // as drawing edges leaves it
  target.begin(20, 20);
  std::vector<std::uint8_t> rgba(20 * 20 * 4, 77);
  target.read(20, 20, rgba.data());
  for (std::uint8_t v : rgba) ASSERT_EQ(v, 0);
  float depth = 1;
  glReadPixels(10, 10, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
  EXPECT_EQ(depth, 0);
}

TEST_F(Gl, TargetLargerThanTheDriverDrawsIsRefused) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  gl::Target target;
  EXPECT_THROW(target.begin(most + 1, 1), Error);
  // And still draws what it can.
  target.begin(8, 8);
  draw(program(position_fragment));
  std::vector<std::uint8_t> rgba(8 * 8 * 4);
  target.read(8, 8, rgba.data());
  EXPECT_EQ(rgba[(3 * 8 + 5) * 4], 5);
}

TEST_F(Gl, TextureHoldsItsTexelsRowsFromTheTop) {
  std::vector<std::uint8_t> texels;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      for (int v : {x * 40, y * 90, 7, 255}) texels.push_back(static_cast<std::uint8_t>(v));
    }
  }
  const gl::Texture texture(5, 3, texels);
  std::vector<std::uint8_t> back(texels.size());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(back.size()), back.data());
  EXPECT_EQ(back, texels);
  std::uint8_t smallest[4];
  glGetTextureImage(texture.name(), 2, GL_RGBA, GL_UNSIGNED_BYTE, 4, smallest);  // 5x3, 2x1, 1x1
  EXPECT_NEAR(smallest[0], 80, 20);  // the mean; how odd sizes are halved is the driver's affair
  EXPECT_NEAR(smallest[1], 90, 45);
}

TEST_F(Gl, TextureLargerThanTheDriverTakesIsHalvedAlongItsLongSide) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (most > 1 << 16) GTEST_SKIP() << "this driver takes textures of any size that fits into memory";
  const int length = most + 4;
  for (const bool wide : {true, false}) {
    // Along the long side texels are 0, 10, 20, 30, 0, ..., along the short one they differ by 100.
    std::vector<std::uint8_t> texels;
    for (int y = 0; y < (wide ? 2 : length); ++y) {
      for (int x = 0; x < (wide ? length : 2); ++x) {
        const int value = (wide ? x : y) % 4 * 10 + (wide ? y : x) * 100;
        texels.insert(texels.end(), {static_cast<std::uint8_t>(value), 0, 0, 255});
      }
    }
    const gl::Texture texture(wide ? length : 2, wide ? 2 : length, texels);
    GLint width = 0, height = 0;
    glGetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(texture.name(), 0, GL_TEXTURE_HEIGHT, &height);
    ASSERT_EQ(wide ? width : height, length / 2);
    ASSERT_EQ(wide ? height : width, 2);
    std::vector<std::uint8_t> back(static_cast<std::size_t>(width) * height * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(back.size()), back.data());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int mean = ((wide ? x : y) % 2 == 0 ? 5 : 25) + (wide ? y : x) * 100;
        ASSERT_EQ(back[(static_cast<std::size_t>(y) * width + x) * 4], mean) << x << " " << y;
      }
    }
  }
}

std::vector<std::uint8_t> contents(GLuint buffer, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  glGetNamedBufferSubData(buffer, 0, static_cast<GLsizeiptr>(size), bytes.data());
  return bytes;
}

TEST_F(Gl, StreamBufferKeepsTheLastTwoWritesApartAndAllocatesOnlyToGrow) {
  gl::StreamBuffer buffer;
  const gl::Made before = gl::made();
  std::vector<std::pair<GLuint, std::vector<std::uint8_t>>> written;
  for (int i = 0; i < 12; ++i) {
    const std::vector<std::uint8_t> bytes(static_cast<std::size_t>(10 + i % 4 * 30), static_cast<std::uint8_t>(i + 1));
    buffer.write(std::as_bytes(std::span(bytes)));
    written.emplace_back(buffer.name(), bytes);
    for (int back = 0; back < 3 && back <= i; ++back) {
      const auto& [name, wish] = written[static_cast<std::size_t>(i - back)];
      EXPECT_EQ(contents(name, wish.size()), wish) << i << " minus " << back;
    }
  }
  buffer.write({});
  EXPECT_EQ(gl::made(), before);
}

TEST_F(Gl, StreamBufferIsFilledInPlaceAsItIsWritten) {
  gl::StreamBuffer buffer;
  std::vector<std::pair<GLuint, std::vector<std::uint8_t>>> written;
  for (int i = 0; i < 6; ++i) {
    const std::vector<std::uint8_t> bytes(static_cast<std::size_t>(10 + i % 3 * 30), static_cast<std::uint8_t>(i + 1));
    buffer.fill(bytes.size(), [&](std::span<std::byte> to) {
      ASSERT_EQ(to.size(), bytes.size());
      std::memcpy(to.data(), bytes.data(), bytes.size());
    });
    written.emplace_back(buffer.name(), bytes);
    for (int back = 0; back < 3 && back <= i; ++back) {
      const auto& [name, wish] = written[static_cast<std::size_t>(i - back)];
      EXPECT_EQ(contents(name, wish.size()), wish) << i << " minus " << back;
    }
  }
  buffer.fill(0, [](std::span<std::byte> to) { EXPECT_TRUE(to.empty()); });
}

TEST_F(Gl, MadeCountsEveryObject) {
  const gl::Made before = gl::made();
  const std::uint8_t texel[4] = {1, 2, 3, 4};
  const gl::Texture texture(1, 1, texel);
  const gl::StaticBuffer fixed(std::as_bytes(std::span(texel)));
  const gl::StreamBuffer stream;
  const gl::Target target;
  const gl::Program p = program(position_fragment);
  const gl::Made after = gl::made();
  EXPECT_EQ(after.textures - before.textures, 1);
  EXPECT_EQ(after.buffers - before.buffers, 1 + 3);
  EXPECT_EQ(after.targets - before.targets, 1);
  EXPECT_EQ(after.programs - before.programs, 1);
  EXPECT_EQ(after.contexts, before.contexts);
}

}  // namespace
}  // namespace rinkaku::test

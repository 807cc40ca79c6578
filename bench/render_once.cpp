// Renders a scene as `rinkaku render` does, and nothing else: what is built twice for rinkaku-bench-leaving-out, once
// with all stages and once without water, filmed things and fluff (bench/without.cpp). Prints what was
// made of OpenGL: "PROGRAMS BUFFERS
// TEXTURES".

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "pipeline/gl/context.h"
#include "pipeline/pipeline.h"

int main(int argc, char** argv) {
  using namespace rinkaku;
  if (argc != 4) {
    std::fprintf(stderr, "usage: %s SCENE OUTPUT FRAMES\n", argv[0]);
    return 2;
  }
  try {
    pipeline::RenderOptions options;
    options.output = argv[2];
    options.codec = "mpeg4";
    options.bit_rate = 6'000'000;
    options.end_frame = std::atoll(argv[3]);
    options.overwrite = true;
    const std::atomic<bool> never{false};
    pipeline::render(pipeline::prepare(pipeline::read_scene(argv[1]), options), options, never, {}, nullptr);
    const gl::Made made = gl::made();
    std::printf("%d %d %d\n", made.programs, made.buffers, made.textures);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

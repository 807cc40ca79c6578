#pragma once

#include <cstdint>
#include <string>

#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// [output]: what is written when the command line gives no -o.
struct OutputScene {
  std::string path;  ///< video, image pattern or "-"; empty if the scene has none
  std::string codec;
  std::int64_t bit_rate = 0;
  enum class Content { Composite, Cg } content = Content::Composite;  ///< Cg: CG on nothing, straight alpha
};

toml::Schema output_schema();

/// Throws Error (Input).
OutputScene read_output(const toml::Table& output);

}  // namespace rinkaku::pipeline

#pragma once

#include <array>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "pipeline/frame/picture_format.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// Kinds of values that several sections of a scene file share. All throw Error (Input) with line and column.

/// Beyond this a length is a slip of the pen: a thousand kilometres.
inline constexpr toml::Limits metres{-1e6, 1e6};

/// The path behind a key, which must name a file that can be read; absolute.
std::filesystem::path existing_file(const toml::Table& table, std::string_view key);

/// A pattern of image files, made absolute: it must hold one of `signs`. `example` is for the message.
std::string image_pattern(const toml::Table& table, std::string_view key, std::string_view signs, const char* example);

/// Frames a second; 23.976, 29.97 and their like stand for multiples of 1000/1001. The key must be there.
Rational read_fps(const toml::Table& table);

/// An sRGB colour, "#rrggbb" or three numbers from 0 to 1; empty if the key is absent.
std::optional<std::array<double, 3>> read_colour(const toml::Table& table, std::string_view key);

/// The value that a key's word stands for; empty if the key is absent.
template <class Value>
std::optional<Value> read_choice(const toml::Table& table, std::string_view key,
                                 std::initializer_list<std::pair<std::string_view, Value>> choices) {
  const auto text = table.text(key);
  if (!text) return std::nullopt;
  std::string expected;
  std::size_t left = choices.size();
  for (const auto& [word, value] : choices) {
    if (*text == word) return value;
    expected += "\"" + std::string(word) + "\"" + (--left > 1 ? ", " : left == 1 ? " or " : "");
  }
  throw table.wrong(key, expected);
}

}  // namespace rinkaku::pipeline

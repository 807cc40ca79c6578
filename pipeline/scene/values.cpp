#include "pipeline/scene/values.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <numeric>
#include <variant>

#include <glm/vec3.hpp>

namespace rinkaku::pipeline {

namespace fs = std::filesystem;
using toml::Table;

fs::path existing_file(const Table& table, std::string_view key) {
  fs::path path = toml::resolved(table.required(key, table.text(key)), table.file());
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw table.error_at(key, "names a file that doesn't exist: " + path.string());
  if (fs::is_directory(status)) throw table.error_at(key, "names a folder, not a file: " + path.string());
  if (fs::is_character_file(status) || fs::is_block_file(status)) {
    throw table.error_at(key, "names a device: " + path.string(), "give a recorded file");
  }
  if (fs::is_regular_file(status) && !std::ifstream(path)) {
    throw table.error_at(key, "names a file that can't be read: " + path.string(), "check its permissions");
  }
  return path;
}

std::string image_pattern(const Table& table, std::string_view key, std::string_view signs, const char* example) {
  const std::string text = table.required(key, table.text(key));
  if (text.find_first_of(signs) == std::string::npos) {
    throw table.wrong(key, std::string("a pattern of image files such as \"") + example + "\"");
  }
  return toml::resolved(text, table.file()).string();
}

Rational read_fps(const Table& table) {
  const double fps = *table.number("fps", {0.001, 1000});
  // 23.976 (or 23.98), 29.97 and their like stand for 24 and 30 times 1000/1001.
  const std::int64_t whole = std::llround(fps);
  const bool ntsc = whole > 0 && (whole % 12 == 0 || whole % 15 == 0);
  if (ntsc && std::abs(fps - static_cast<double>(whole) * 1000 / 1001) < 0.005) return {whole * 1000, 1001};
  const std::int64_t millionths = std::llround(fps * 1e6), divisor = std::gcd(millionths, std::int64_t{1'000'000});
  return {millionths / divisor, 1'000'000 / divisor};
}

std::optional<std::array<double, 3>> read_colour(const Table& table, std::string_view key) {
  if (!table.has(key)) return std::nullopt;
  if (std::holds_alternative<toml::Array>(table.find(key)->held)) {
    const glm::dvec3 rgb = *table.vector3(key, {0, 1});
    return std::array{rgb.r, rgb.g, rgb.b};
  }
  const auto* text = std::get_if<std::string>(&table.find(key)->held);
  const bool good = text && text->size() == 7 && text->front() == '#' &&
                    text->find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!good) throw table.wrong(key, "a colour, \"#rrggbb\" or [r, g, b] from 0 to 1");
  const unsigned long rgb = std::stoul(text->substr(1), nullptr, 16);
  return std::array{static_cast<double>(rgb >> 16 & 255) / 255, static_cast<double>(rgb >> 8 & 255) / 255,
                    static_cast<double>(rgb & 255) / 255};
}

}  // namespace rinkaku::pipeline

#include "pipeline/toml/value.h"

#include <charconv>
#include <cmath>

namespace rinkaku::toml {
namespace {

std::string shortest(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "infinity" : "-infinity";
  const double size = std::abs(number);
  const bool readable = size == 0 || (size >= 1e-4 && size < 1e12);
  const auto format = readable ? std::chars_format::fixed : std::chars_format::scientific;
  char digits[64];
  return {digits, std::to_chars(digits, digits + sizeof digits, number, format).ptr};
}

struct Describe {
  std::string operator()(const DateOrTime&) const { return "a date or time"; }
  std::string operator()(bool flag) const { return flag ? "true" : "false"; }
  std::string operator()(std::int64_t integer) const { return std::to_string(integer); }
  std::string operator()(double number) const { return shortest(number); }
  std::string operator()(const std::string& text) const { return "the text \"" + quotable(text) + "\""; }
  std::string operator()(const Array& array) const {
    return array.empty() ? "an empty array" : "an array of " + std::to_string(array.size());
  }
  std::string operator()(const Entries&) const { return "a table"; }
};

}  // namespace

std::string quotable(std::string_view text) {
  constexpr std::size_t most_bytes = 60;
  std::string shown(text.substr(0, most_bytes));
  if (text.size() > most_bytes) {
    // Never half a character: continuation bytes go, then the byte that began it.
    const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; };
    std::size_t end = most_bytes;
    while (end > 0 && continues(end)) --end;
    shown.resize(end);
    shown += "...";
  }
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return shown;
}

std::string described(const Value& value) { return std::visit(Describe{}, value.held); }

}  // namespace rinkaku::toml

#include "pipeline/toml/value.h"

#include <charconv>
#include <cmath>

#include "pipeline/frame/error.h"

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

std::string described(const Value& value) { return std::visit(Describe{}, value.held); }

}  // namespace rinkaku::toml

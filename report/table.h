#pragma once

#include <string>
#include <variant>
#include <vector>

namespace rinkaku::report {

/// What stands in a column: its name in the CSV, which has the unit in it, and its heading on the page.
struct Column {
  std::string name;
  std::string heading;
};

/// A text, a number, or nothing (not measured).
using Cell = std::variant<std::monostate, std::string, double>;

struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;  ///< each as long as `columns`
};

/// A table as RFC 4180 has it, but with plain line ends: a header of names; texts with commas, quotes or line ends in
/// quotes; numbers so that reading them gives the same double; nothing for what was not measured or is not finite.
std::string csv(const Table& table);

/// A number for the eye: four significant digits, no exponent between 0.001 and a billion; "-" if not finite.
std::string readable(double value);

}  // namespace rinkaku::report

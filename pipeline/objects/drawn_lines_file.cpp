#include "pipeline/objects/drawn_lines_file.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>

#include "pipeline/files/read_file.h"
#include "pipeline/frame/error.h"

namespace rinkaku::pipeline {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 28;

// Rows of a text, without their ends.
class Rows {
 public:
  explicit Rows(std::string_view text) : rest_(text) {}
  std::optional<std::string_view> next() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view row = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (row.ends_with('\r')) row.remove_suffix(1);
      if (row.find_first_not_of(" \t") != std::string_view::npos && !row.starts_with('#')) return row;
    }
    return std::nullopt;
  }
  int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

// The next of the numbers in a row, which commas and spaces part.
template <class Number>
std::optional<Number> take(std::string_view& row) {
  const std::size_t start = row.find_first_not_of(", \t");
  if (start == std::string_view::npos) return std::nullopt;
  row.remove_prefix(start);
  Number value{};
  const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), value);
  if (error != std::errc{}) return std::nullopt;
  row.remove_prefix(static_cast<std::size_t>(end - row.data()));
  return value;
}

bool is_empty(std::string_view row) { return row.find_first_not_of(", \t") == std::string_view::npos; }

Error row_error(const std::filesystem::path& file, int row, const std::string& what, const std::string& remedy) {
  return input_error(file.string() + ":" + std::to_string(row), what, remedy);
}

}  // namespace

std::vector<std::vector<glm::dvec2>> read_lines_px(const std::filesystem::path& file) {
  const std::string text = files::read_file(file, kMostBytes);
  Rows rows(text);
  std::vector<std::vector<glm::dvec2>> lines;
  while (std::optional<std::string_view> row = rows.next()) {
    std::vector<glm::dvec2> line;
    while (!is_empty(*row)) {
      const auto x = take<double>(*row), y = take<double>(*row);
      if (!x || !y || !(std::abs(*x) <= 1e6) || !(std::abs(*y) <= 1e6)) {
        throw row_error(file, rows.number(), "is no line", "write it as pixels: 610,300 615,304 622,310");
      }
      line.emplace_back(*x, *y);
    }
    if (line.size() < 2) {
      throw row_error(file, rows.number(), "a line needs two points", "write them as pixels: 610,300 615,304");
    }
    lines.push_back(std::move(line));
  }
  if (lines.empty()) throw input_error(file.string(), "holds no lines", "write one a row: 610,300 615,304 622,310");
  return lines;
}

std::string drawn_lines_text(const std::vector<outline::DrawnLine>& lines, std::size_t triangles) {
  std::string text = "triangles," + std::to_string(triangles) + "\nline,triangle,b,c\n";
  char row[96];
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const outline::SurfacePlace& place : lines[i]) {
      // Nine digits give a float back exactly.
      std::snprintf(row, sizeof row, "%zu,%u,%.9g,%.9g\n", i, place.triangle, place.b, place.c);
      text += row;
    }
  }
  return text;
}

std::vector<outline::DrawnLine> read_drawn_lines(const std::filesystem::path& file, std::size_t triangles) {
  constexpr std::string_view head = "triangles,", columns = "line,triangle,b,c";
  const std::string text = files::read_file(file, kMostBytes);
  Rows rows(text);
  std::optional<std::string_view> row = rows.next();
  if (!row || !row->starts_with(head)) {
    throw input_error(file.string(), "holds no lines on a mesh", "make it with: rinkaku trace");
  }
  row->remove_prefix(head.size());
  if (take<std::size_t>(*row) != triangles) {
    throw input_error(file.string(),
                      "was made for another mesh, not for one of " + std::to_string(triangles) + " triangles",
                      "make it anew with: rinkaku trace");
  }
  row = rows.next();
  if (!row || *row != columns) throw row_error(file, rows.number(), "isn't '" + std::string(columns) + "'", "");
  std::vector<outline::DrawnLine> lines;
  while ((row = rows.next())) {
    const auto line = take<std::size_t>(*row);
    const auto triangle = take<std::uint32_t>(*row);
    const auto b = take<float>(*row), c = take<float>(*row);
    const bool good = line && triangle && b && c && is_empty(*row) && *triangle < triangles && *b >= 0 && *c >= 0 &&
                      *b + *c <= 1.0001f && *line <= lines.size() && *line + 1 >= lines.size();
    if (!good) throw row_error(file, rows.number(), "is no place on the mesh", "make it anew with: rinkaku trace");
    if (*line == lines.size()) lines.emplace_back();
    lines[*line].push_back({*triangle, *b, *c});
  }
  return lines;
}

}  // namespace rinkaku::pipeline

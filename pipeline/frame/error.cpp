#include "pipeline/frame/error.h"

namespace rinkaku {
namespace {

std::string one_line(std::string_view where, std::string_view what, std::string_view remedy) {
  std::string line;
  if (!where.empty()) line.append(where).append(": ");
  line.append(what);
  if (!remedy.empty()) line.append("; ").append(remedy);
  for (char& c : line) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return line;
}

}  // namespace

Error::Error(Kind kind, std::string_view where, std::string_view what, std::string_view remedy)
    : std::runtime_error(one_line(where, what, remedy)), kind_(kind) {}

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

}  // namespace rinkaku

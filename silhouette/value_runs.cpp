#include "silhouette/value_runs.h"

namespace rinkaku::silhouette {

void append_runs(std::span<const std::uint8_t> values, std::vector<std::uint8_t>& out) {
  for (std::size_t i = 0; i < values.size();) {
    std::size_t end = i + 1;
    while (end < values.size() && values[end] == values[i]) ++end;
    std::size_t length = end - i - 1;
    out.push_back(static_cast<std::uint8_t>(values[i] << 6 | (length > 31 ? 32 : 0) | (length & 31)));
    for (length >>= 5; length > 0; length >>= 7) {
      out.push_back(static_cast<std::uint8_t>((length > 127 ? 128 : 0) | (length & 127)));
    }
    i = end;
  }
}

std::optional<RunReader::Run> RunReader::next() {
  if (at_ == bytes_.size()) return std::nullopt;
  const std::uint8_t head = bytes_[at_++];
  std::uint64_t length = head & 31u;
  bool more = (head & 32) != 0;
  for (int shift = 5; more; shift += 7) {
    if (at_ == bytes_.size() || shift > 32) return std::nullopt;
    const std::uint8_t byte = bytes_[at_++];
    length |= std::uint64_t{byte & 127u} << shift;
    more = (byte & 128) != 0;
  }
  if (++length > total_ - first_) return std::nullopt;
  const Run run{static_cast<std::uint8_t>(head >> 6), first_, static_cast<std::uint32_t>(length)};
  first_ += run.count;
  return run;
}

}  // namespace rinkaku::silhouette

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rinkaku::silhouette {

/// Appends values from 0 to 3 as runs: a byte with the value (2 bits), whether more bytes follow (1 bit) and 5 bits of
/// the run's length less one; then 7 bits of it a byte, the highest bit telling whether more follow. Neighbouring
/// triangles mostly share a role, so a region's roles take about a twentieth of a byte each.
void append_runs(std::span<const std::uint8_t> values, std::vector<std::uint8_t>& out);

/// Reads them back, from bytes that may be anything.
class RunReader {
 public:
  struct Run {
    std::uint8_t value = 0;
    std::uint32_t first = 0;  ///< the number of its first value
    std::uint32_t count = 0;
  };

  /// `total`: how many values there must be.
  RunReader(std::span<const std::uint8_t> bytes, std::uint32_t total) : bytes_(bytes), total_(total) {}

  /// The next run; none at the end and where the bytes make no sense.
  std::optional<Run> next();

  /// Whether all bytes were read and gave all values.
  bool complete() const { return at_ == bytes_.size() && first_ == total_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::uint32_t total_;
  std::size_t at_ = 0;
  std::uint32_t first_ = 0;
};

}  // namespace rinkaku::silhouette

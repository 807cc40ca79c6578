#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace rinkaku::outline {

/// A piece of a line from one vertex to another.
struct Segment {
  std::uint32_t from = 0, to = 0;  ///< vertices of the mesh
};

/// Segments that follow one another.
struct Chain {
  std::uint32_t first = 0, count = 0;  ///< of Chains::vertices(); a closed one has its first vertex again at the end
  bool closed = false;
};

/// Links segments into chains as long as possible. No GL. Allocates nothing once warm; some 20 ns a segment.
class Chains {
 public:
  /// `welded` says which point of the surface each vertex is, as mesh::Mesh has it; it is copied.
  explicit Chains(std::span<const std::uint32_t> welded);

  /// Segments keep their direction: one goes on with another that begins where it ends. Where several do, with the one
  /// that comes first in the list.
  void link(std::span<const Segment> segments);

  std::span<const Chain> chains() const { return chains_; }
  std::span<const std::uint32_t> vertices() const { return vertices_; }
  /// Per vertex: which segment leads to it; that of a chain's first one means nothing.
  std::span<const std::uint32_t> steps() const { return steps_; }

 private:
  static constexpr std::uint32_t kNoSegment = 0xffffffffu;
  std::uint32_t take_from(std::uint32_t point);
  void walk(std::span<const Segment> segments, std::uint32_t start);

  std::vector<std::uint32_t> welded_;
  std::vector<std::uint32_t> first_from_;  // per point: the first free segment that begins there
  std::vector<std::uint32_t> next_from_;   // per segment: the next one that begins at the same point
  std::vector<std::int32_t> ends_;         // per point: segments that begin here, less those that end here
  std::vector<std::uint8_t> used_;         // per segment
  std::vector<Chain> chains_;
  std::vector<std::uint32_t> vertices_, steps_;
};

/// The same for segments without direction, once: turned so that they follow one another, and in that order. A chain
/// ends where three or more meet.
std::vector<Segment> in_order(std::span<const Segment> segments, std::span<const std::uint32_t> welded);

}  // namespace rinkaku::outline

#include "outline/fluffy/band_lists.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "mesh/bounds.h"

namespace rinkaku::fluffy {
namespace {

// More than what rounding does to a facing computed in float.
constexpr double kMargin = 2e-5;

silhouette::UnitFrame unit_frame_of(const BandSurface& surface) {
  const mesh::Sphere sphere = mesh::bounding_sphere(surface.points);
  return {sphere.centre, sphere.radius > 0 ? sphere.radius : 1};
}

// A surface in the unit frame, one array a component.
struct Corners {
  std::vector<float> x, y, z, nx, ny, nz;
};

Corners unit_corners(const BandSurface& surface, const silhouette::UnitFrame& frame) {
  Corners out;
  for (std::size_t p = 0; p < surface.points.size(); ++p) {
    const glm::vec3 place(frame.to_unit(glm::dvec3(surface.points[p])));
    out.x.push_back(place.x), out.y.push_back(place.y), out.z.push_back(place.z);
    const glm::vec3& n = surface.normals[p];
    out.nx.push_back(n.x), out.ny.push_back(n.y), out.nz.push_back(n.z);
  }
  return out;
}

// How the corners stand to whole regions; one for each thread.
class Classifier {
 public:
  Classifier(const Corners& corners, double sine)
      : corners_(corners),
        square_(static_cast<float>((sine + kMargin) * (sine + kMargin))),
        least_(corners.x.size()),
        most_(corners.x.size()),
        side_(corners.x.size()) {}

  // Per corner: 1 above the band for all eyes, 2 below it, 0 neither.
  const std::vector<std::uint8_t>& classify(const silhouette::ViewRegion& region) {
    const std::size_t count = side_.size();
    std::fill(least_.begin(), least_.end(), 1e30f);
    std::fill(most_.begin(), most_.end(), -1e30f);
    for (const glm::dvec4& vertex : region.hull) meet(glm::vec4(vertex));
    for (std::size_t p = 0; p < count; ++p) {
      side_[p] = static_cast<std::uint8_t>((least_[p] > 0 ? 1 : 0) | (most_[p] < 0 ? 2 : 0));
    }
    return side_;
  }

 private:
  // Facing f is above s where f |f| > s^2, f = height / distance.
  void meet(const glm::vec4& h) {
    const float *x = corners_.x.data(), *y = corners_.y.data(), *z = corners_.z.data();
    const float *nx = corners_.nx.data(), *ny = corners_.ny.data(), *nz = corners_.nz.data();
    float *least = least_.data(), *most = most_.data();
    const float square = square_;
    const std::size_t count = side_.size();
    for (std::size_t p = 0; p < count; ++p) {
      const float dx = h.x - h.w * x[p], dy = h.y - h.w * y[p], dz = h.z - h.w * z[p];
      const float height = nx[p] * dx + ny[p] * dy + nz[p] * dz;
      const float signed_square = height * std::fabs(height);
      const float edge = square * (dx * dx + dy * dy + dz * dz);
      const float above = signed_square - edge, below = signed_square + edge;
      least[p] = above < least[p] ? above : least[p];
      most[p] = below > most[p] ? below : most[p];
    }
  }

  const Corners& corners_;
  float square_;
  std::vector<float> least_, most_;
  std::vector<std::uint8_t> side_;
};

void append_number(std::vector<std::uint8_t>& bytes, std::uint32_t number) {
  for (; number >= 128; number >>= 7) bytes.push_back(static_cast<std::uint8_t>(number | 128));
  bytes.push_back(static_cast<std::uint8_t>(number));
}

void append_runs(const std::vector<glm::uvec3>& triangles, const std::vector<std::uint8_t>& side,
                 std::vector<std::uint8_t>& bytes) {
  std::uint32_t length = 0;
  bool listing = false;
  for (const glm::uvec3& t : triangles) {
    const bool listed = (side[t.x] & side[t.y] & side[t.z]) == 0;
    if (listed != listing) {
      append_number(bytes, length);
      length = 0;
      listing = listed;
    }
    ++length;
  }
  if (listing) append_number(bytes, length);
}

}  // namespace

BandLists::BandLists(const BandSurface& surface, double sine, const silhouette::RegionLayout& layout)
    : frame_(unit_frame_of(surface)), finder_(layout) {
  const Corners corners = unit_corners(surface, frame_);
  const std::uint32_t regions = silhouette::region_count(layout);
  // Each thread makes the lists of a run of regions.
  const std::uint32_t threads = std::clamp(std::thread::hardware_concurrency(), 1u, regions);
  std::vector<std::vector<std::uint8_t>> bytes(threads);
  std::vector<std::uint32_t> sizes(regions);
  const auto make = [&](std::uint32_t thread) {
    Classifier classifier(corners, sine);
    const auto begin_of = [&](std::uint32_t t) {
      return static_cast<std::uint32_t>(std::uint64_t{regions} * t / threads);
    };
    for (std::uint32_t r = begin_of(thread); r < begin_of(thread + 1); ++r) {
      const std::size_t before = bytes[thread].size();
      append_runs(surface.triangles, classifier.classify(silhouette::view_region(layout, r)), bytes[thread]);
      sizes[r] = static_cast<std::uint32_t>(bytes[thread].size() - before);
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::uint32_t t = 1; t < threads; ++t) others.emplace_back(make, t);
    make(0);
  }
  first_byte_.push_back(0);
  for (const std::uint32_t size : sizes) first_byte_.push_back(first_byte_.back() + size);
  runs_.reserve(first_byte_.back());
  for (const auto& part : bytes) runs_.insert(runs_.end(), part.begin(), part.end());
}

void BandLists::list(std::uint32_t region, std::vector<std::uint32_t>& triangles) const {
  triangles.clear();
  std::uint32_t at = 0;
  bool listing = false;
  for (std::uint32_t b = first_byte_[region]; b < first_byte_[region + 1]; listing = !listing) {
    std::uint32_t number = 0;
    for (int shift = 0;; shift += 7) {
      const std::uint8_t byte = runs_[b++];
      number |= static_cast<std::uint32_t>(byte & 127) << shift;
      if (byte < 128) break;
    }
    const std::uint32_t end = at + number;
    if (listing) {
      for (std::uint32_t t = at; t < end; ++t) triangles.push_back(t);
    }
    at = end;
  }
}

}  // namespace rinkaku::fluffy

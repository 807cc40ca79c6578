#include "silhouette/view_regions.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "pipeline/frame/error.h"

namespace rinkaku::silhouette {
namespace {

constexpr double kQuarterPi = 0.78539816339744830962;

/// Homogeneous points and planes closer than this count as touching: far above rounding, far below what regions need.
constexpr double kTouch = 1e-12;

/// A direction of a cube's face: 0 and 1 are +x and -x, then y, z; u and v along the next two axes.
glm::dvec3 on_cube(int face, double u, double v) {
  const int axis = face / 2;
  glm::dvec3 out;
  out[axis] = face % 2 == 0 ? 1 : -1;
  out[(axis + 1) % 3] = u;
  out[(axis + 2) % 3] = v;
  return out;
}

/// Where a cell's border `i` of `cells` lies on a cube's face from -1 to 1, cells being equal in angle.
double border(int i, int cells) { return std::tan((2.0 * i / cells - 1) * kQuarterPi); }

int cell_of(double along, int cells) {
  const int cell = static_cast<int>((std::atan(along) / kQuarterPi + 1) * 0.5 * cells);
  return std::clamp(cell, 0, cells - 1);
}

ViewRegion layout_region(const RegionLayout& layout, std::uint32_t index) {
  const int cells = layout.cells;
  const int shell = static_cast<int>(index) / (6 * cells * cells);
  const int face = static_cast<int>(index) / (cells * cells) % 6;
  const int row = static_cast<int>(index) / cells % cells;
  const int column = static_cast<int>(index) % cells;
  // Uniform in 1/r: nearest at shell 0.
  const auto nearness = [&](int s) { return (1 - static_cast<double>(s) / layout.shells) / layout.inner_radii; };

  std::vector<glm::dvec3> corners;
  for (const auto& [c, r] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
    corners.push_back(glm::normalize(on_cube(face, border(column + c, cells), border(row + r, cells))));
  }
  const glm::dvec3 axis = glm::normalize(corners[0] + corners[1] + corners[2] + corners[3]);

  ViewRegion out;
  for (const glm::dvec3& d : corners) out.hull.emplace_back(d / nearness(shell), 1.0);
  for (const glm::dvec3& d : corners) {
    if (shell + 1 == layout.shells) {
      out.hull.emplace_back(d, 0.0);
    } else {
      // On the plane that touches the outer sphere on the cell's axis: the whole cap lies on its inner side.
      out.hull.emplace_back(d / (nearness(shell + 1) * glm::dot(d, axis)), 1.0);
    }
  }
  return out;
}

/// The plane through three homogeneous points: zero where they are in one line.
glm::dvec4 plane_through(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c) {
  const auto minor = [&](int i, int j, int k) {
    return glm::dot(glm::dvec3(a[i], a[j], a[k]),
                    glm::cross(glm::dvec3(b[i], b[j], b[k]), glm::dvec3(c[i], c[j], c[k])));
  };
  return {minor(1, 2, 3), -minor(0, 2, 3), minor(0, 1, 3), -minor(0, 1, 2)};
}

/// Points of size one, so that one tolerance fits all.
std::vector<glm::dvec4> scaled(const ViewRegion& region) {
  std::vector<glm::dvec4> out = region.hull;
  for (glm::dvec4& h : out) h /= glm::length(h);
  return out;
}

/// The planes of a hull's faces, inside positive; empty if it has no volume.
std::vector<glm::dvec4> hull_planes(const ViewRegion& region) {
  const std::vector<glm::dvec4> hull = scaled(region);
  std::vector<glm::dvec4> planes;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t j = i + 1; j < hull.size(); ++j) {
      for (std::size_t k = j + 1; k < hull.size(); ++k) {
        glm::dvec4 plane = plane_through(hull[i], hull[j], hull[k]);
        const double length = glm::length(plane);
        if (length < kTouch) continue;
        plane /= length;
        double least = 0;
        double most = 0;
        for (const glm::dvec4& h : hull) {
          least = std::min(least, glm::dot(plane, h));
          most = std::max(most, glm::dot(plane, h));
        }
        if (most - least < kTouch) return {};  // all in one plane
        if (least >= -kTouch) planes.push_back(plane);
        if (most <= kTouch) planes.push_back(-plane);
      }
    }
  }
  return planes;
}

/// Whether a region keeps clear of the unit sphere, with the object in it: walks over the region towards its point that
/// is nearest to the centre, until the plane across the way separates the two, or the point is inside the sphere
/// (Gilbert's method).
bool clear_of_object(const ViewRegion& region) {
  constexpr double kFar = 1e6;  // stands for infinity
  std::vector<glm::dvec3> vertices;
  for (const glm::dvec4& h : region.hull) vertices.push_back(glm::dvec3(h) * (h.w > 0 ? 1.0 : kFar));
  glm::dvec3 nearest = vertices.front();
  for (int step = 0; step < 10000; ++step) {
    const double distance = glm::length(nearest);
    if (distance <= 1) return false;
    const auto first = std::min_element(vertices.begin(), vertices.end(), [&](const auto& l, const auto& r) {
      return glm::dot(nearest, l) < glm::dot(nearest, r);
    });
    if (glm::dot(nearest, *first) > distance) return true;
    const glm::dvec3 way = *first - nearest;
    const double length_sq = glm::dot(way, way);
    if (length_sq == 0) return false;
    nearest += way * std::clamp(-glm::dot(nearest, way) / length_sq, 0.0, 1.0);
  }
  return false;  // as good as touching
}

void check_layout(const RegionLayout& layout, const char* where) {
  if (layout.cells < 1 || layout.cells > 64) {
    throw input_error(where, "cells is " + std::to_string(layout.cells), "give 1 to 64");
  }
  if (layout.shells < 1 || layout.shells > 16) {
    throw input_error(where, "shells is " + std::to_string(layout.shells), "give 1 to 16");
  }
  if (!(layout.inner_radii >= 1.05 && layout.inner_radii <= 100)) {
    throw input_error(where, "the inner radius is " + std::to_string(layout.inner_radii) + " object radii",
                      "give 1.05 to 100");
  }
}

void check_region(const ViewRegion& region, const char* where) {
  if (region.hull.size() < 4 || region.hull.size() > 64) {
    throw input_error(where, "the view region has " + std::to_string(region.hull.size()) + " hull vertices",
                      "give 4 to 64");
  }
  for (const glm::dvec4& h : region.hull) {
    const bool finite = std::isfinite(h.x) && std::isfinite(h.y) && std::isfinite(h.z);
    const double size = glm::length(glm::dvec3(h));
    if (!finite || (h.w != 0 && h.w != 1) || !(size > 1e-9 && size < 1e9)) {
      throw input_error(where, "a hull vertex of the view region is not usable",
                        "give finite vertices with w = 1, or w = 0 in infinity");
    }
  }
  if (hull_planes(region).empty()) {
    throw input_error(where, "the view region has no volume", "give vertices that are not all in one plane");
  }
  if (!clear_of_object(region)) {
    throw input_error(where, "the view region touches the object's bounding sphere", "move it away from the object");
  }
}

}  // namespace

void check(const ViewSpace& space, const char* where) {
  if (const auto* layout = std::get_if<RegionLayout>(&space)) check_layout(*layout, where);
  if (const auto* region = std::get_if<ViewRegion>(&space)) check_region(*region, where);
}

std::uint32_t region_count(const ViewSpace& space) {
  const auto* layout = std::get_if<RegionLayout>(&space);
  return layout ? static_cast<std::uint32_t>(6 * layout->cells * layout->cells * layout->shells) : 1;
}

ViewRegion view_region(const ViewSpace& space, std::uint32_t index) {
  const auto* layout = std::get_if<RegionLayout>(&space);
  return layout ? layout_region(*layout, index) : std::get<ViewRegion>(space);
}

RegionFinder::RegionFinder(ViewSpace space) : space_(std::move(space)) {
  if (const auto* region = std::get_if<ViewRegion>(&space_)) planes_ = hull_planes(*region);
}

std::optional<std::uint32_t> RegionFinder::find(const glm::dvec3& eye) const {
  const double distance = glm::length(eye);
  if (!std::isfinite(distance)) return std::nullopt;
  const auto* layout = std::get_if<RegionLayout>(&space_);
  if (layout == nullptr) {
    const glm::dvec4 h = glm::normalize(glm::dvec4(eye, 1));
    const bool inside = std::all_of(planes_.begin(), planes_.end(),
                                    [&](const glm::dvec4& plane) { return glm::dot(plane, h) >= -kTouch; });
    return inside ? std::optional<std::uint32_t>(0) : std::nullopt;
  }
  if (distance < layout->inner_radii) return std::nullopt;
  const int shell =
      std::min(static_cast<int>(layout->shells * (1 - layout->inner_radii / distance)), layout->shells - 1);
  const glm::dvec3 size = glm::abs(eye);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int face = axis * 2 + (eye[axis] > 0 ? 0 : 1);
  const int cells = layout->cells;
  const int column = cell_of(eye[(axis + 1) % 3] / size[axis], cells);
  const int row = cell_of(eye[(axis + 2) % 3] / size[axis], cells);
  return static_cast<std::uint32_t>(((shell * 6 + face) * cells + row) * cells + column);
}

}  // namespace rinkaku::silhouette

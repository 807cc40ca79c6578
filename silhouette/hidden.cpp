#include "silhouette/hidden.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rinkaku::silhouette {
namespace {

/// Parts that grow beyond this are given up: their beam is wide or runs along the front mesh.
constexpr std::size_t kMostFaces = 200;

/// Eyes that most of what is not hidden fails at: in the middle, and on the rim. All are in the region.
std::vector<glm::dvec3> trial_eyes(const ViewRegion& region) {
  constexpr double kFar = 20;
  glm::dvec4 sum(0);
  glm::dvec3 middle(0);
  double finite = 0;
  for (const glm::dvec4& h : region.hull) {
    sum += h;
    middle += h.w * glm::dvec3(h);
    finite += h.w;
  }
  middle /= finite;
  std::vector<glm::dvec3> out{glm::dvec3(sum) / sum.w};
  constexpr std::size_t kMost = 4;
  const std::size_t step = (region.hull.size() + kMost - 1) / kMost;
  for (std::size_t i = 0; i < region.hull.size(); i += step) {
    const glm::dvec4& h = region.hull[i];
    out.push_back(h.w > 0 ? glm::dvec3(h) : middle + kFar * glm::dvec3(h));
  }
  return out;
}

}  // namespace

void HiddenFinder::start(const ViewRegion& region, const CollapseMesh& front) {
  front_ = &front;
  beam_.set_region(region);
  faces_.clear();
  for (const auto face : front.all_faces()) {
    if (front.status(face).deleted()) continue;
    FrontFace placed{face, {}};
    auto half_edge = front.halfedge_handle(face);
    for (glm::dvec3& corner : placed.corners) {
      corner = place_of(front, front.to_vertex_handle(half_edge));
      half_edge = front.next_halfedge_handle(half_edge);
    }
    faces_.push_back(placed);
  }
  const std::vector<glm::dvec3> eyes = trial_eyes(region);
  view_count_ = eyes.size();
  if (views_.size() < view_count_) views_.resize(view_count_);
  for (std::size_t i = 0; i < view_count_; ++i) views_[i].set(eyes[i], faces_);
  part_mark_.assign(front.n_faces(), 0);
  search_ = 0;
}

bool HiddenFinder::covers(Face first) {
  ++search_;
  part_.assign(1, first);
  part_mark_[first.idx()] = search_;
  for (std::size_t i = 0; i < part_.size(); ++i) {
    auto half_edge = front_->halfedge_handle(part_[i]);
    for (int side = 0; side < 3; ++side, half_edge = front_->next_halfedge_handle(half_edge)) {
      const Face beside = front_->face_handle(front_->opposite_halfedge_handle(half_edge));
      if (beside.is_valid() && part_mark_[beside.idx()] == search_) continue;
      const glm::dvec3 p = place_of(*front_, front_->from_vertex_handle(half_edge));
      const glm::dvec3 q = place_of(*front_, front_->to_vertex_handle(half_edge));
      if (beam_.is_clear_of(p, q)) continue;
      if (!beside.is_valid() || part_.size() >= kMostFaces) return false;
      part_mark_[beside.idx()] = search_;
      part_.push_back(beside);
    }
  }
  return true;
}

bool HiddenFinder::is_hidden(const std::array<glm::dvec3, 3>& triangle) {
  const glm::dvec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
  // Trials from some eyes save the search for nearly all that are not hidden; they prove nothing.
  const auto covered_everywhere = [this](const glm::dvec3& point) {
    return std::all_of(views_.begin(), views_.begin() + static_cast<std::ptrdiff_t>(view_count_),
                       [&](const FrontView& view) { return view.any_over(point, [](Face) { return true; }); });
  };
  if (!covered_everywhere(middle)) return false;
  for (const glm::dvec3& corner : triangle) {
    if (!covered_everywhere(glm::mix(corner, middle, 0.01))) return false;
  }
  beam_.set_triangle(triangle);
  return views_[0].any_over(middle, [this](Face face) { return covers(face); });
}

}  // namespace rinkaku::silhouette

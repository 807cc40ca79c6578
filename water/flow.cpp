#include "water/flow.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace rinkaku::water {

FlowGrid::FlowGrid(const Surface& surface, int cells) {
  const glm::dvec2 size = surface.most() - surface.least();
  cell_m = std::max(size.x, size.y) / cells, cells_per_m = 1 / cell_m;
  const auto count = [this](double length) { return static_cast<int>(std::ceil(length / cell_m - 1e-9)) + 4; };
  columns = count(size.x), rows = count(size.y);
  origin = (surface.least() + surface.most()) / 2.0 - glm::dvec2(columns, rows) * (cell_m / 2);
}

Flow::Flow(const Surface& surface, std::vector<ArrowKey> keys, const FlowOptions& options,
           std::span<const Segment> bodies)
    : surface_(&surface), keys_(std::move(keys)), grid_(surface, options.cells) {
  alpha_m_ = options.alpha_m > 0 ? options.alpha_m : glm::distance(surface.least(), surface.most()) / 8;
  for (const ArrowKey& key : keys_) {
    for (const Arrow& a : key.arrows) still_ = still_ && glm::length(a.velocity) <= 0;
  }
  if (still_) return;
  wish_.resize(grid_.nodes());
  crowd_.resize(grid_.nodes());
  if (options.method == FlowOptions::Method::DivergenceFree) stream_.emplace(surface, grid_, bodies);
}

void Flow::set_frame(double frame) {
  if (still_ || keys_.empty()) return;
  // Before the first key and after the last one nothing changes.
  frame = std::clamp(frame, static_cast<double>(keys_.front().frame), static_cast<double>(keys_.back().frame));
  if (frame_ == frame) return;
  frame_ = frame;
  arrows_at(keys_, frame, arrows_);
  for (int y = 0; y <= grid_.rows; ++y) {
    for (int x = 0; x <= grid_.columns; ++x) {
      wish_[grid_.node(x, y)] = wished_velocity(arrows_, alpha_m_, grid_.place(x, y));
      double near = 0;
      for (const Arrow& a : arrows_) near += std::exp(-std::pow(glm::distance(a.at, grid_.place(x, y)) / alpha_m_, 2));
      crowd_[grid_.node(x, y)].x = near;
    }
  }
  if (stream_) stream_->fit(wish_);
}

double Flow::crowding(glm::dvec2 p) const { return crowd_.empty() ? 0 : grid_.between(crowd_, p).x; }

Deviation Flow::deviation() const {
  Deviation d;
  double wished = 0, flows = 0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < arrows_.size(); ++i) {
    const glm::dvec2 a = arrows_[i].velocity, v = velocity(arrows_[i].at);
    if (!(glm::length(a) > 0) || !surface_->contains(arrows_[i].at)) continue;
    const double angle = std::abs(std::atan2(a.x * v.y - a.y * v.x, glm::dot(a, v)));
    if (angle > d.largest_rad) d.largest_rad = angle, d.worst = i;
    d.mean_rad += angle;
    wished += glm::length(a), flows += glm::length(v);
    ++counted;
  }
  if (counted > 0) d.mean_rad /= static_cast<double>(counted), d.speed_ratio = flows / wished;
  return d;
}

namespace {

glm::dvec2 stepped(const Flow& flow, glm::dvec2 p, glm::dvec2 k1, double dt) {
  const glm::dvec2 k2 = flow.velocity(p + k1 * (dt / 2));
  const glm::dvec2 k3 = flow.velocity(p + k2 * (dt / 2));
  const glm::dvec2 k4 = flow.velocity(p + k3 * dt);
  return p + (k1 + (k2 + k3) * 2.0 + k4) * (dt / 6);
}

// The way from a to b, along the shore where it would cross one.
glm::dvec2 kept_in(const Surface& surface, glm::dvec2 a, glm::dvec2 b, double margin_m) {
  for (int bounce = 0; bounce < 2; ++bounce) {
    const Surface::Nearest hit = surface.crossed_shore(a, b);
    if (!hit.found) return b;
    const BorderEdge& edge = surface.edges()[hit.edge];
    const glm::dvec2 d = glm::normalize(edge.b - edge.a), inward(-d.y, d.x);
    b = hit.point + inward * margin_m + d * glm::dot(b - hit.point, d);
  }
  return surface.crossed_shore(a, b).found ? a : b;
}

}  // namespace

void carry_along(const Flow& flow, const Surface& surface, double seconds, glm::dvec2& p, glm::dvec2& velocity) {
  if (flow.still()) return;
  const double cell = flow.grid().cell_m;
  velocity = flow.velocity(p);
  const double way = glm::length(velocity) * seconds;
  const int steps = std::clamp(static_cast<int>(std::ceil(way / (0.5 * cell))), 1, 64);
  for (int i = 0; i < steps; ++i) {
    if (i > 0) velocity = flow.velocity(p);
    p = kept_in(surface, p, stepped(flow, p, velocity, seconds / steps), 1e-3 * cell);
  }
}

}  // namespace rinkaku::water

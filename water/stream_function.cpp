#include "water/stream_function.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace rinkaku::water {
namespace {

// The four cubic B-splines over a cell and their slopes.
template <typename Real>
struct Basis {
  std::array<Real, 4> value, slope;
};
template <typename Real>
inline Basis<Real> basis(Real f) {
  const Real g = 1 - f, ff = f * f, gg = g * g;
  // Products, as divisions take most of the time here.
  constexpr Real sixth = Real(1) / 6, half = Real(0.5), thirds = Real(2) / 3;
  return {{gg * g * sixth, thirds - ff * (1 - half * f), thirds - gg * (1 - half * g), ff * f * sixth},
          {-gg * half, f * (Real(1.5) * f - 2), g * (2 - Real(1.5) * g), ff * half}};
}

// Weight of the flow across a shore, per metre, against that of the water's wish, per cell's area.
constexpr double shore_weight = 3e4;
// Just enough to settle what no water reaches.
constexpr double smooth_weight = 1e-4, least_weight = 1e-9;

std::array<double, 16> along(const Basis<double>& bx, const Basis<double>& by, glm::dvec2 direction) {
  std::array<double, 16> form;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      form[y * 4 + x] = direction.x * bx.value[x] * by.slope[y] - direction.y * bx.slope[x] * by.value[y];
    }
  }
  return form;
}

}  // namespace

StreamFunction::StreamFunction(const Surface& surface, const FlowGrid& grid, std::span<const Segment> bodies)
    : grid_(grid), by_columns_(grid.rows > grid.columns) {
  const std::size_t wide = grid.columns + 3, high = grid.rows + 3;
  equations_ = BandedCholesky(wide * high, 3 * std::min(wide, high) + 3);
  add_water(surface);
  for (const BorderEdge& e : surface.edges()) {
    if (!e.open) add_shore(e.a, e.b);
  }
  for (const Segment& s : bodies) add_shore(s.a, s.b);
  add_smoothness();
  equations_.factorise();
  solved_.resize(wide * high);
  coefficients_.resize(wide * high);
}

std::size_t StreamFunction::unknown(int x, int y) const {
  return by_columns_ ? static_cast<std::size_t>(y) * (grid_.columns + 3) + x
                     : static_cast<std::size_t>(x) * (grid_.rows + 3) + y;
}

void StreamFunction::add_form(const FlowGrid::Cell& c, const Form& form, double weight) {
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 16; ++j) {
      const std::size_t row = unknown(c.x + i % 4, c.y + i / 4), column = unknown(c.x + j % 4, c.y + j / 4);
      if (column <= row) equations_.add(row, column, weight * form[i] * form[j]);
    }
  }
}

void StreamFunction::add_water(const Surface& surface) {
  for (int y = 0; y < grid_.rows; ++y) {
    for (int x = 0; x < grid_.columns; ++x) {
      // Gauss points: exact for cubics.
      for (const double fy : {0.2113248654, 0.7886751346}) {
        for (const double fx : {0.2113248654, 0.7886751346}) {
          const glm::dvec2 at = grid_.origin + glm::dvec2(x + fx, y + fy) * grid_.cell_m;
          if (surface.contains(at)) samples_.push_back({at, 0.25});
        }
      }
    }
  }
  // A surface that slips between the points is asked at its middle.
  if (samples_.empty())
    samples_.push_back({(surface.triangles()[0] + surface.triangles()[1] + surface.triangles()[2]) / 3.0, 0.25});
  for (const Sample& s : samples_) {
    const FlowGrid::Cell c = grid_.cell_of(s.at);
    const Basis<double> bx = basis(c.fx), by = basis(c.fy);
    for (const glm::dvec2 direction : {glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
      const Form form = along(bx, by, direction);
      add_form(c, form, s.weight);
    }
  }
}

void StreamFunction::add_shore(glm::dvec2 a, glm::dvec2 b) {
  const double length = glm::distance(a, b);
  if (!(length > 0)) return;
  const int points = std::max(1, static_cast<int>(std::ceil(3 * length / grid_.cell_m)));
  const glm::dvec2 d = (b - a) / length, across(d.y, -d.x);
  const double weight = shore_weight * length / grid_.cell_m / points;
  for (int k = 0; k < points; ++k) {
    const FlowGrid::Cell c = grid_.cell_of(a + (b - a) * ((k + 0.5) / points));
    add_form(c, along(basis(c.fx), basis(c.fy), across), weight);
  }
}

void StreamFunction::add_smoothness() {
  const int wide = grid_.columns + 3, high = grid_.rows + 3;
  const auto bend = [&](int x, int y, int dx, int dy) {
    const std::array<std::size_t, 3> at{unknown(x, y), unknown(x + dx, y + dy), unknown(x + 2 * dx, y + 2 * dy)};
    const std::array<double, 3> form{1, -2, 1};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) equations_.add(at[i], at[j], smooth_weight * form[i] * form[j]);
    }
  };
  for (int y = 0; y < high; ++y) {
    for (int x = 0; x < wide; ++x) {
      equations_.add(unknown(x, y), unknown(x, y), least_weight);
      if (x + 2 < wide) bend(x, y, 1, 0);
      if (y + 2 < high) bend(x, y, 0, 1);
    }
  }
}

void StreamFunction::fit(const std::vector<glm::dvec2>& wish) {
  std::fill(solved_.begin(), solved_.end(), 0.0);
  for (const Sample& s : samples_) {
    const FlowGrid::Cell c = grid_.cell_of(s.at);
    const Form form = along(basis(c.fx), basis(c.fy), grid_.between(wish, s.at));
    for (int i = 0; i < 16; ++i) solved_[unknown(c.x + i % 4, c.y + i / 4)] += s.weight * form[i];
  }
  equations_.solve(solved_);
  const int wide = grid_.columns + 3, high = grid_.rows + 3;
  for (int y = 0; y < high; ++y) {
    for (int x = 0; x < wide; ++x) {
      coefficients_[static_cast<std::size_t>(y) * wide + x] = static_cast<float>(solved_[unknown(x, y)]);
    }
  }
}

glm::dvec2 StreamFunction::velocity(glm::dvec2 p) const {
  const FlowGrid::Cell c = grid_.cell_of(p);
  const auto bx = basis(static_cast<float>(c.fx)), by = basis(static_cast<float>(c.fy));
  const float* from = coefficients_.data() + static_cast<std::size_t>(c.y) * (grid_.columns + 3) + c.x;
  // Sums over each column first: four side by side.
  std::array<float, 4> slopes{}, values{};
  for (std::size_t y = 0; y < 4; ++y, from += grid_.columns + 3) {
    for (std::size_t x = 0; x < 4; ++x) slopes[x] += by.slope[y] * from[x], values[x] += by.value[y] * from[x];
  }
  float u = 0, v = 0;
  for (std::size_t x = 0; x < 4; ++x) u += bx.value[x] * slopes[x], v -= bx.slope[x] * values[x];
  return {u, v};
}

}  // namespace rinkaku::water

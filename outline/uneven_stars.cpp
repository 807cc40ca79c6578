#include "outline/uneven_stars.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rinkaku::outline {
namespace {

// The mean of each point and its neighbours. A neighbour is met in the two faces beside the edge to it, so each counts
// half; on a border it is met once.
void mean_over_neighbours(const FaceStars& stars, std::span<const Measures> measures,
                          std::span<const MeanAndGauss> values, std::span<MeanAndGauss> means) {
  for (std::size_t p = 0; p < values.size(); ++p) {
    float weight = std::max(measures[p].area, 0.0f);
    float mean = weight * values[p].mean, gauss = weight * values[p].gauss;
    for (const std::uint32_t corner : stars.at(p)) {
      const glm::uvec3& face = stars.faces[corner / 3];
      for (std::uint32_t step = 1; step < 3; ++step) {
        const std::uint32_t q = face[static_cast<int>((corner + step) % 3)];
        const float half = 0.5f * std::max(measures[q].area, 0.0f);
        weight += half, mean += half * values[q].mean, gauss += half * values[q].gauss;
      }
    }
    means[p] = weight > 0 ? MeanAndGauss{mean / weight, gauss / weight} : values[p];
  }
}

}  // namespace

UnevenStars::UnevenStars(const FaceStars& stars)
    : unevenness_(stars.point_count()), once_(stars.point_count()), twice_(stars.point_count()) {}

void UnevenStars::find_unevenness(const FaceStars& stars, std::span<const glm::vec4> points,
                                  std::span<const glm::vec4> normals) {
  for (std::size_t p = 0; p < unevenness_.size(); ++p) {
    glm::vec3 moment(0);
    float most = 0;
    const glm::vec3 at(points[p]), normal(normals[p]);
    for (const std::uint32_t corner : stars.at(p)) {
      const glm::uvec3& face = stars.faces[corner / 3];
      const glm::vec3 a = glm::vec3(points[face[static_cast<int>((corner + 1) % 3)]]) - at;
      const glm::vec3 b = glm::vec3(points[face[static_cast<int>((corner + 2) % 3)]]) - at;
      const float twice_area = glm::length(glm::cross(a, b));
      moment += twice_area * (a + b);
      most += twice_area * glm::length(a + b);
    }
    moment -= normal * glm::dot(normal, moment);
    unevenness_[p] = most > 0 ? glm::length(moment) / most : 0.0f;
  }
}

void UnevenStars::average(const FaceStars& stars, std::span<const glm::vec4> points, std::span<const glm::vec4> normals,
                          std::span<const Measures> measures, std::span<MeanAndGauss> values) {
  constexpr float even = 0.15f, uneven = 0.3f;
  find_unevenness(stars, points, normals);
  mean_over_neighbours(stars, measures, values, once_);
  mean_over_neighbours(stars, measures, once_, twice_);
  for (std::size_t p = 0; p < values.size(); ++p) {
    float most = unevenness_[p];
    for (const std::uint32_t corner : stars.at(p)) {
      for (int c = 0; c < 3; ++c) most = std::max(most, unevenness_[stars.faces[corner / 3][c]]);
    }
    const float share = std::clamp((most - even) / (uneven - even), 0.0f, 1.0f);
    values[p].mean += share * (twice_[p].mean - values[p].mean);
    values[p].gauss += share * (twice_[p].gauss - values[p].gauss);
  }
}

}  // namespace rinkaku::outline

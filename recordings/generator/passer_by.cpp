#include "recordings/generator/passer_by.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

#include "recordings/generator/parallel.h"
#include "recordings/generator/random.h"
#include "recordings/generator/rasterise.h"

namespace rinkaku::recordings {
namespace {

constexpr int coarse = 2;              // the shadow's picture is so much smaller
constexpr int finer = 3;               // the walker's picture is so much larger, each way
constexpr int instants = 8;            // of the exposure
constexpr int light_rays = 24;         // towards the window, and as many around
constexpr float around_share = 0.34f;  // of the light on an open floor that does not come from the window

glm::vec3 to_glm(const cv::Vec3f& v) { return {v[0], v[1], v[2]}; }

glm::vec3 around(glm::vec3 normal, int i) {
  const glm::vec2 u = low_discrepancy(i, {0.3f, 0.7f});
  const float r = std::sqrt(u.x), a = 6.2831853f * u.y;
  return frame_along(normal) * glm::vec3(r * std::cos(a), r * std::sin(a), std::sqrt(1 - u.x));
}

bool blocked(const std::array<Limb, Walker::bones>& limbs, glm::vec3 origin, glm::vec3 direction, float distance,
             float slim) {
  return std::any_of(limbs.begin(), limbs.end(),
                     [&](const Limb& limb) { return meets(limb, origin, direction, distance, slim); });
}

}  // namespace

PasserByRenderer::PasserByRenderer(const Room& room, const CameraModel& camera, const LensRays& rays,
                                   const RigidTransform& world_from_camera, glm::vec3 start)
    : room_(room),
      camera_(camera),
      camera_from_world_(inverse(world_from_camera)),
      start_(start),
      points_(camera.height_px / coarse, camera.width_px / coarse),
      normals_(points_.size()) {
  const glm::mat3 rotation(glm::mat3_cast(world_from_camera.rotation));
  const glm::vec3 eye(world_from_camera.translation_m);
  parallel_for(points_.rows, [&](int y) {
    for (int x = 0; x < points_.cols; ++x) {
      const float px = (static_cast<float>(x) + 0.5f) * coarse - 0.5f,
                  py = (static_cast<float>(y) + 0.5f) * coarse - 0.5f;
      const glm::vec3 direction = glm::normalize(rotation * glm::vec3(rays.at(px, py), 1));
      const Hit hit = room.trace(eye, direction);
      points_(y, x) = {hit.point.x, hit.point.y, hit.point.z};
      normals_(y, x) = {hit.normal.x, hit.normal.y, hit.normal.z};
    }
  });
}

cv::Mat1f PasserByRenderer::shadow(const Walker::Moment& moment, double time_s) const {
  std::array<Limb, Walker::bones> limbs = moment.limbs;
  for (Limb& limb : limbs) {
    limb.from += start_;
    limb.to += start_;
  }
  const glm::vec3 centre = start_ + glm::vec3(static_cast<float>(time_s * Walker::speed_m_s), 0, 0.85f);
  const Window& window = room_.window();
  const glm::vec3 out = glm::normalize(glm::cross(window.side_u, window.side_v));
  cv::Mat1f left(points_.size(), 1.0f);
  parallel_for(left.rows, [&](int y) {
    for (int x = 0; x < left.cols; ++x) {
      const glm::vec3 normal = to_glm(normals_(y, x)), point = to_glm(points_(y, x)) + 1e-3f * normal;
      const auto near_walker = [&](glm::vec3 direction) {
        const glm::vec3 to = centre - point;
        const float along = glm::dot(to, direction);
        return along > -1.1f && glm::dot(to, to) - along * along < 1.1f * 1.1f;
      };
      float open = 0, all = 0;
      for (int i = 0; i < light_rays; ++i) {
        const glm::vec2 u = low_discrepancy(i, {0.1f, 0.2f});
        const glm::vec3 to = window.corner + u.x * window.side_u + u.y * window.side_v - point;
        const float distance = glm::length(to);
        const glm::vec3 direction = to / distance;
        const float weight = std::max(0.0f, glm::dot(direction, normal)) * std::max(0.0f, -glm::dot(direction, out)) /
                             (distance * distance);
        all += weight;
        if (!near_walker(direction) || !blocked(limbs, point, direction, distance, 1)) open += weight;
      }
      int free = light_rays;
      if (glm::distance(centre, point) < 2.2f) {
        for (int i = 0; i < light_rays; ++i) free -= blocked(limbs, point, around(normal, i), 2.0f, 1) ? 1 : 0;
      }
      const float direct = all > 0 ? open / all : 1.0f, share = all > 0.01f ? around_share : 1.0f;
      left(y, x) = (1 - share) * direct + share * static_cast<float>(free) / light_rays;
    }
  });
  cv::GaussianBlur(left, left, {}, 1.2);
  cv::Mat1f full;
  cv::resize(left, full, {camera_.width_px, camera_.height_px}, 0, 0, cv::INTER_LINEAR);
  return full;
}

std::vector<glm::vec3> PasserByRenderer::light_on(const Walker::Moment& moment) const {
  std::vector<glm::vec3> light(moment.positions.size());
  const Window& window = room_.window();
  const glm::vec3 out = glm::cross(window.side_u, window.side_v);
  parallel_for(static_cast<int>(light.size()), [&](int v) {
    const std::size_t i = static_cast<std::size_t>(v);
    const glm::vec3 normal = moment.normals[i], at = moment.positions[i] + 0.03f * normal;
    glm::vec3 direct(0), ambient(0);
    for (int k = 0; k < light_rays; ++k) {
      const glm::vec2 u = low_discrepancy(k, {0.1f, 0.2f});
      const glm::vec3 to = window.corner + u.x * window.side_u + u.y * window.side_v - (at + start_);
      const float d2 = glm::dot(to, to), d = std::sqrt(d2);
      const glm::vec3 direction = to / d;
      const float weight = glm::dot(direction, normal) * -glm::dot(direction, out) / d2;
      if (weight > 0 && !blocked(moment.limbs, at, direction, d, 0.9f)) direct += window.radiance * weight;
      const glm::vec3 other = around(normal, k);
      if (blocked(moment.limbs, at, other, 1.0f, 0.9f)) {
        ambient += glm::vec3(0.05f, 0.045f, 0.04f);
      } else {
        ambient += glm::mix(glm::vec3(0.24f, 0.19f, 0.14f), glm::vec3(0.42f, 0.40f, 0.38f), 0.5f + 0.5f * other.z);
      }
    }
    light[i] = direct / (3.14159265f * light_rays) + ambient / static_cast<float>(light_rays);
  });
  return light;
}

PasserBy PasserByRenderer::render(int frame, const ShotOptions& options) const {
  const double time = frame / options.rate_hz;
  const Walker::Moment middle = walker_.at(time);
  PasserBy out{cv::Mat3f(camera_.height_px, camera_.width_px, cv::Vec3f(0, 0, 0)),
               cv::Mat1f(camera_.height_px, camera_.width_px, 0.0f), shadow(middle, time)};
  const std::vector<glm::vec3> light = light_on(middle);

  std::array<cv::Mat3f, instants> lights;
  std::array<cv::Mat1f, instants> alphas;
  parallel_for(instants, [&](int instant) {
    const Walker::Moment moment = walker_.at(time + ((instant + 0.5) / instants - 0.5) * options.exposure_s);
    const std::size_t count = moment.positions.size();
    std::vector<glm::vec3> seen(count);
    for (std::size_t v = 0; v < count; ++v) {
      const glm::dvec3 p = camera_from_world_ * glm::dvec3(moment.positions[v] + start_);
      const glm::dvec2 pixel = to_pixels(camera_, distort(camera_, {p.x / p.z, p.y / p.z}));
      seen[v] = {(pixel.x + 0.5) * finer - 0.5, (pixel.y + 0.5) * finer - 0.5, 1 / p.z};
    }
    // Only the walker's own rectangle is drawn.
    glm::vec2 low(1e9f), high(-1e9f);
    for (const glm::vec3& p : seen) {
      low = glm::min(low, glm::vec2(p) / static_cast<float>(finer));
      high = glm::max(high, glm::vec2(p) / static_cast<float>(finer));
    }
    const cv::Rect picture(0, 0, camera_.width_px, camera_.height_px);
    const cv::Point from(cvFloor(low.x) - 1, cvFloor(low.y) - 1), to(cvCeil(high.x) + 2, cvCeil(high.y) + 2);
    const cv::Rect area = cv::Rect(from, to) & picture;
    cv::Mat3f& colour = lights[static_cast<std::size_t>(instant)];
    cv::Mat1f& cover = alphas[static_cast<std::size_t>(instant)];
    colour = cv::Mat3f(picture.size(), cv::Vec3f(0, 0, 0));
    cover = cv::Mat1f(picture.size(), 0.0f);
    if (area.empty()) return;
    const cv::Size size = area.size() * finer;
    for (glm::vec3& p : seen) p -= glm::vec3(area.x * finer, area.y * finer, 0);
    cv::Mat1f nearest(size, 0.0f);
    cv::Mat1i triangle(size, -1);
    cv::Mat3f weights(size);
    const auto& mesh = walker_.skin();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const std::array<glm::vec3, 3> corner{seen[static_cast<std::size_t>(a)], seen[static_cast<std::size_t>(b)],
                                            seen[static_cast<std::size_t>(c)]};
      rasterise(corner, size.width, size.height, [&](int x, int y, float inverse_depth, glm::vec3 w) {
        if (inverse_depth <= nearest(y, x)) return;
        nearest(y, x) = inverse_depth;
        triangle(y, x) = static_cast<int>(t);
        weights(y, x) = {w.x, w.y, w.z};
      });
    }
    constexpr float share = 1.0f / (finer * finer);
    for (int y = 0; y < area.height; ++y) {
      for (int x = 0; x < area.width; ++x) {
        glm::vec3 sum(0);
        float covered = 0;
        for (int k = 0; k < finer * finer; ++k) {
          const int sx = x * finer + k % finer, sy = y * finer + k / finer;
          const int t = triangle(sy, sx);
          if (t < 0) continue;
          covered += share;
          const glm::vec3 w = to_glm(weights(sy, sx));
          const auto& corner = mesh.triangles[static_cast<std::size_t>(t)];
          glm::vec3 rest(0), on(0);
          for (int i = 0; i < 3; ++i) {
            rest += w[i] * mesh.positions[static_cast<std::size_t>(corner[static_cast<std::size_t>(i)])];
            on += w[i] * light[static_cast<std::size_t>(corner[static_cast<std::size_t>(i)])];
          }
          sum += share * on * Walker::colour(mesh.materials[static_cast<std::size_t>(t)], rest);
        }
        colour(area.y + y, area.x + x) = {sum.x, sum.y, sum.z};
        cover(area.y + y, area.x + x) = covered;
      }
    }
  });
  for (int i = 0; i < instants; ++i) {
    out.light += lights[static_cast<std::size_t>(i)] * (1.0 / instants);
    out.alpha += alphas[static_cast<std::size_t>(i)] * (1.0 / instants);
  }
  // The lens blurs the walker as it blurs the room.
  cv::GaussianBlur(out.light, out.light, {}, options.softness_px);
  cv::GaussianBlur(out.alpha, out.alpha, {}, options.softness_px);
  return out;
}

}  // namespace rinkaku::recordings

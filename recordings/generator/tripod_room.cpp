#include "recordings/generator/tripod_room.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

#include "recordings/generator/noise.h"
#include "recordings/generator/random.h"
#include "recordings/generator/textures.h"

namespace rinkaku::recordings {
namespace {

using Shape = Solid::Shape;

cv::Mat3b rug(int width_px, int height_px) {
  cv::Mat3b weave = cloth(width_px, height_px, 2.5f, {196, 206, 214}, {182, 192, 204}, 71);
  const auto border = [&](int inset, int thick, cv::Scalar colour) {
    cv::rectangle(weave, {inset, inset, width_px - 2 * inset, height_px - 2 * inset}, colour, thick);
  };
  cv::Mat3b plain = weave.clone();
  border(26, 22, {112, 92, 58});
  border(70, 6, {70, 84, 150});
  const int step = 150;
  for (int y = 120 + step / 2; y < height_px - 110; y += step) {
    for (int x = 120 + step / 2; x < width_px - 110; x += step) {
      for (const auto& [size, colour] :
           {std::pair{58, cv::Scalar(112, 92, 58)}, {38, cv::Scalar(200, 208, 216)}, {20, cv::Scalar(70, 84, 150)}}) {
        const std::vector<cv::Point> diamond{{x - size, y}, {x, y - size}, {x + size, y}, {x, y + size}};
        cv::fillConvexPoly(weave, diamond, colour, cv::LINE_AA);
      }
    }
  }
  return weave * 0.8 + plain * 0.2;
}

// Hills in mist, painted broadly.
cv::Mat3b landscape(int width_px, int height_px) {
  cv::Mat3b picture(height_px, width_px);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(width_px),
                  v = static_cast<float>(y) / static_cast<float>(height_px);
      const float brush = 14 * fractal_noise({u * 30, v * 60}, 3, 81);
      cv::Vec3f c = cv::Vec3f(214, 196, 168) + v * cv::Vec3f(-30, 10, 70);
      for (int hill = 0; hill < 4; ++hill) {
        const float h = static_cast<float>(hill);
        const float top =
            0.42f + 0.13f * h + (0.12f - 0.02f * h) * fractal_noise({u * (2.0f + h) + 9 * h, 1.0f}, 4, 82);
        if (v > top) c = cv::Vec3f(168, 150, 120) * (1 - 0.22f * h) + cv::Vec3f(0, 8 * h, 4 * h);
      }
      const float sun = std::hypot((u - 0.68f) * 1.5f, v - 0.25f);
      if (sun < 0.075f) c = {120, 190, 246};
      for (int i = 0; i < 3; ++i) picture(y, x)[i] = cv::saturate_cast<uchar>(c[i] + brush);
    }
  }
  return picture;
}

void add_frame(Room& room, glm::vec3 centre, glm::vec2 half, const Surface& picture) {
  const int image = room.add_surface(picture);
  const int wood = room.add_surface({{0.10f, 0.055f, 0.03f}, {}, 0.4f, 40});
  const int mat = room.add_surface({glm::vec3(0.82f), {}, 0, 0});
  room.add(
      {Shape::Box, {half.x - 0.07f, 0.006f, half.y - 0.07f}, centre + glm::vec3(0, -0.008f, 0), glm::mat3(1), {image}});
  room.add({Shape::Box, {half.x, 0.008f, half.y}, centre, glm::mat3(1), {mat}});
  constexpr float bar = 0.016f;
  for (const float s : {-1.0f, 1.0f}) {
    room.add(
        {Shape::Box, {bar, 0.02f, half.y + bar}, centre + glm::vec3(s * half.x, -0.004f, 0), glm::mat3(1), {wood}});
    room.add({Shape::Box, {half.x, 0.02f, bar}, centre + glm::vec3(0, -0.004f, s * half.y), glm::mat3(1), {wood}});
  }
}

void add_sideboard(Room& room, glm::vec3 at) {
  const cv::Mat3b grain = wood(1400, 700, 900, {98, 142, 184}, {48, 78, 122}, 0.9f, 75);
  const int veneer = room.add_surface({glm::vec3(0.9f), grain, 0.5f, 30});
  const int gap = room.add_surface({glm::vec3(0.015f), {}, 0, 0});
  const int brass = room.add_surface({{0.45f, 0.30f, 0.10f}, {}, 3.0f, 90});
  const int leg = room.add_surface({{0.09f, 0.05f, 0.028f}, {}, 0.3f, 30});
  room.add({Shape::Box, {0.80f, 0.205f, 0.24f}, at + glm::vec3(0, 0, 0.45f), glm::mat3(1), {veneer}});
  room.add({Shape::Box, {0.83f, 0.225f, 0.0125f}, at + glm::vec3(0, -0.005f, 0.70f), glm::mat3(1), {veneer}});
  room.add({Shape::Box, {0.775f, 0.003f, 0.215f}, at + glm::vec3(0, -0.204f, 0.45f), glm::mat3(1), {gap}});
  for (int door = 0; door < 3; ++door) {
    const float x = 0.516f * static_cast<float>(door - 1);
    room.add({Shape::Box, {0.253f, 0.009f, 0.209f}, at + glm::vec3(x, -0.207f, 0.45f), glm::mat3(1), {veneer}});
    room.add({Shape::Ellipsoid,
              glm::vec3(0.014f),
              at + glm::vec3(x + (door == 2 ? -0.21f : 0.21f), -0.228f, 0.50f),
              glm::mat3(1),
              {brass}});
  }
  for (const float x : {-0.70f, 0.70f}) {
    for (const float y : {-0.15f, 0.15f})
      room.add({Shape::Frustum, {0.014f, 0.022f, 0.22f}, at + glm::vec3(x, y, 0), glm::mat3(1), {leg}});
  }
  // On it: a vase, books upright, a bowl of oranges.
  const float top = 0.7125f;
  const int vase = room.add_surface({{0.16f, 0.27f, 0.34f}, {}, 1.0f, 500});
  room.add({Shape::Ellipsoid, {0.085f, 0.085f, 0.105f}, at + glm::vec3(-0.55f, 0, top + 0.10f), glm::mat3(1), {vase}});
  room.add({Shape::Frustum, {0.050f, 0.028f, 0.10f}, at + glm::vec3(-0.55f, 0, top + 0.175f), glm::mat3(1), {vase}});
  const glm::vec3 bindings[] = {{0.30f, 0.05f, 0.04f}, {0.05f, 0.12f, 0.20f}, {0.45f, 0.36f, 0.20f},
                                {0.07f, 0.16f, 0.09f}, {0.42f, 0.16f, 0.04f}, {0.14f, 0.09f, 0.16f}};
  float x = 0.12f;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const float half = 0.012f + 0.010f * uniform({i, 3}), height = 0.095f + 0.03f * uniform({i, 4});
    const int binding = room.add_surface({bindings[i], {}, 0.3f, 25});
    room.add(
        {Shape::Box, {half, 0.085f, height}, at + glm::vec3(x + half, 0.02f, top + height), glm::mat3(1), {binding}});
    x += 2 * half + 0.001f;
  }
  const int bowl = room.add_surface({{0.58f, 0.55f, 0.50f}, {}, 0.7f, 300});
  const int orange = room.add_surface({{0.72f, 0.24f, 0.025f}, {}, 0.3f, 40});
  const glm::vec3 in_bowl = at + glm::vec3(0.60f, -0.02f, top);
  room.add({Shape::Tube, {0.055f, 0.135f, 0.065f}, in_bowl, glm::mat3(1), {bowl}});
  room.add({Shape::Ring, {0, 0.056f, 0}, in_bowl + glm::vec3(0, 0, 0.002f), glm::mat3(1), {bowl}});
  for (const glm::vec2 o : {glm::vec2(-0.045f, 0.01f), {0.045f, 0.02f}, {0.0f, -0.055f}, {0.005f, 0.06f}})
    room.add({Shape::Ellipsoid, glm::vec3(0.040f), in_bowl + glm::vec3(o, 0.055f), glm::mat3(1), {orange}});
  room.add({Shape::Ellipsoid, glm::vec3(0.040f), in_bowl + glm::vec3(0.005f, 0.005f, 0.105f), glm::mat3(1), {orange}});
}

void add_tree(Room& room, glm::vec3 at) {
  const int basket =
      room.add_surface({{0.95f, 0.85f, 0.7f}, cloth(900, 320, 14.0f, {110, 156, 196}, {90, 134, 172}, 77), 0, 0});
  const int earth = room.add_surface({{0.04f, 0.028f, 0.02f}, {}, 0, 0});
  const int bark = room.add_surface({{0.16f, 0.10f, 0.065f}, {}, 0, 0});
  const int green = room.add_surface({glm::vec3(0.8f), leaf(128, 128, 78), 0.5f, 40});
  const int light = room.add_surface({{1.2f, 1.15f, 0.8f}, leaf(128, 128, 79), 0.5f, 40});
  room.add({Shape::Tube, {0.17f, 0.21f, 0.36f}, at, glm::mat3(1), {basket}});
  room.add({Shape::Ring, {0, 0.205f, 0}, at + glm::vec3(0, 0, 0.33f), glm::mat3(1), {earth}});
  glm::vec3 joint = at + glm::vec3(0, 0, 0.32f);
  for (std::uint32_t i = 0; i < 5; ++i) {
    const glm::vec3 next =
        joint + glm::vec3(0.10f * (uniform({i, 1, 7}) - 0.5f), 0.08f * (uniform({i, 2, 7}) - 0.5f), 0.21f);
    room.add(
        {Shape::Frustum,
         {0.017f - 0.002f * static_cast<float>(i), 0.015f - 0.002f * static_cast<float>(i), glm::length(next - joint)},
         joint,
         frame_along(glm::normalize(next - joint)),
         {bark}});
    joint = next;
  }
  // Broad leaves on bowed stalks around the stem.
  for (std::uint32_t i = 0; i < 44; ++i) {
    const float a = 2.39996f * static_cast<float>(i), t = static_cast<float>(i) / 43;
    const float rise = 0.15f + 0.9f * t * t + 0.35f * (uniform({i, 3}) - 0.5f);
    const glm::vec3 along(std::cos(a) * std::cos(rise), std::sin(a) * std::cos(rise), std::sin(rise));
    const glm::vec3 side(-std::sin(a), std::cos(a), 0);
    const glm::vec3 foot = at + glm::vec3(0.03f * along.x, 0.03f * along.y, 0.62f + 0.74f * t);
    const float stalk = 0.05f + 0.06f * uniform({i, 4}) * (1 - 0.5f * t), half = 0.105f + 0.045f * uniform({i, 5});
    room.add({Shape::Tube, {0.004f, 0.003f, stalk}, foot, frame_along(along), {green}});
    const float droop = rise - 0.35f - 0.5f * uniform({i, 6});
    const glm::vec3 blade(std::cos(a) * std::cos(droop), std::sin(a) * std::cos(droop), std::sin(droop));
    const glm::mat3 frame(side, glm::cross(blade, side), blade);
    room.add({Shape::Ellipsoid,
              {0.058f + 0.022f * uniform({i, 8}), 0.005f, half},
              foot + along * stalk + blade * half * 0.9f,
              frame,
              {i % 3 == 0 ? light : green}});
  }
}

void add_armchair(Room& room, glm::vec3 at, float turn) {
  const int fabric =
      room.add_surface({{0.85f, 0.80f, 0.70f}, cloth(700, 700, 3.0f, {92, 118, 72}, {82, 106, 64}, 85), 0, 0});
  const int leg = room.add_surface({{0.10f, 0.055f, 0.03f}, {}, 0.3f, 30});
  const glm::mat3 r = turn_z(turn);
  // Cushions: rounded by ellipsoids on the boxes' ends would show seams; slim boxes with half-round edges do not.
  const auto cushion = [&](glm::vec3 half, glm::vec3 offset, const glm::mat3& lean, float edge) {
    const glm::mat3 frame = r * lean;
    const glm::vec3 c = at + r * offset;
    room.add({Shape::Box, {half.x - edge, half.y - edge, half.z}, c, frame, {fabric}});
    room.add({Shape::Box, {half.x - edge, half.y, half.z - edge}, c, frame, {fabric}});
    room.add({Shape::Box, {half.x, half.y - edge, half.z - edge}, c, frame, {fabric}});
    const glm::vec3 in = half - edge;
    for (const float u : {-1.0f, 1.0f}) {
      for (const float v : {-1.0f, 1.0f}) {
        const glm::mat3 along_x(glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1, 0, 0));
        const glm::mat3 along_y(glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0));
        room.add({Shape::Tube,
                  {edge, edge, 2 * in.x},
                  c + frame * glm::vec3(-in.x, u * in.y, v * in.z),
                  frame * along_x,
                  {fabric}});
        room.add({Shape::Tube,
                  {edge, edge, 2 * in.y},
                  c + frame * glm::vec3(u * in.x, -in.y, v * in.z),
                  frame * along_y,
                  {fabric}});
        room.add(
            {Shape::Tube, {edge, edge, 2 * in.z}, c + frame * glm::vec3(u * in.x, v * in.y, -in.z), frame, {fabric}});
        for (const float w : {-1.0f, 1.0f})
          room.add({Shape::Ellipsoid,
                    glm::vec3(edge),
                    c + frame * glm::vec3(u * in.x, v * in.y, w * in.z),
                    glm::mat3(1),
                    {fabric}});
      }
    }
  };
  const auto lean = [](float a) {
    return glm::mat3(1, 0, 0, 0, std::cos(a), std::sin(a), 0, -std::sin(a), std::cos(a));
  };
  cushion({0.34f, 0.35f, 0.085f}, {0, 0, 0.27f}, glm::mat3(1), 0.03f);
  cushion({0.29f, 0.30f, 0.075f}, {0, -0.06f, 0.415f}, glm::mat3(1), 0.05f);
  cushion({0.34f, 0.085f, 0.30f}, {0, 0.33f, 0.62f}, lean(-0.22f), 0.06f);
  for (const float s : {-1.0f, 1.0f}) cushion({0.065f, 0.34f, 0.20f}, {s * 0.39f, -0.01f, 0.40f}, glm::mat3(1), 0.05f);
  for (const float x : {-0.32f, 0.32f}) {
    for (const float y : {-0.28f, 0.28f})
      room.add({Shape::Frustum, {0.012f, 0.020f, 0.19f}, at + r * glm::vec3(x, y, 0), glm::mat3(1), {leg}});
  }
}

}  // namespace

Room make_tripod_room(glm::vec3 eye) {
  Room room;
  const int floor =
      room.add_surface({glm::vec3(0.85f), wood(3600, 3000, 450, {128, 172, 206}, {66, 104, 148}, 0.16f, 70), 1.0f, 45});
  const int wall = room.add_surface({glm::vec3(1), plaster(2000, 900, 260, {188, 204, 206}, 0.03f, 72), 0, 0});
  const int white = room.add_surface({glm::vec3(0.74f), {}, 0.15f, 20});
  room.add({Shape::Box, {4.0f, 3.33f, 0.05f}, {0, -0.3f, -0.05f}, glm::mat3(1), {floor}});
  room.add({Shape::Box, {4.0f, 0.05f, 1.5f}, {0, 2.25f, 1.5f}, glm::mat3(1), {wall}});
  room.add({Shape::Box, {0.05f, 3.3f, 1.5f}, {3.25f, -0.3f, 1.5f}, glm::mat3(1), {wall}});
  room.add({Shape::Box, {0.05f, 3.3f, 1.5f}, {-3.30f, -0.3f, 1.5f}, glm::mat3(1), {wall}});
  room.add({Shape::Box, {4.0f, 0.009f, 0.05f}, {0, 2.192f, 0.05f}, glm::mat3(1), {white}});
  room.add({Shape::Box, {0.009f, 3.3f, 0.05f}, {3.192f, -0.3f, 0.05f}, glm::mat3(1), {white}});

  const int carpet = room.add_surface({glm::vec3(0.9f), rug(1600, 1040), 0, 0});
  room.add({Shape::Box, {1.15f, 0.75f, 0.004f}, {0.25f, 0.55f, 0.004f}, glm::mat3(1), {carpet}});
  add_sideboard(room, {-0.85f, 1.94f, 0});
  add_frame(room, {-0.85f, 2.185f, 1.52f}, {0.52f, 0.38f}, {glm::vec3(0.95f), landscape(900, 600), 0.2f, 200});
  add_frame(room, {0.62f, 2.185f, 1.48f}, {0.24f, 0.31f},
            {glm::vec3(0.9f), book_cover(500, 700, {120, 84, 60}, "", true, 87), 0.2f, 200});
  add_tree(room, {-2.15f, 1.75f, 0});
  add_armchair(room, {1.75f, 1.25f, 0}, -28);

  room.set_light({{-3.20f, -2.30f, 0.75f}, {0, 2.0f, 0}, {0, 0, 1.5f}, {26.0f, 26.0f, 26.4f}}, {0.34f, 0.33f, 0.315f},
                 {0.17f, 0.145f, 0.12f});
  room.bake(0.012f, 160, {eye});
  return room;
}

}  // namespace rinkaku::recordings

#include "recordings/generator/desk_room.h"

#include <cmath>
#include <string>

#include <glm/geometric.hpp>
#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>

#include "recordings/generator/random.h"
#include "recordings/generator/textures.h"

namespace rinkaku::recordings {
namespace {

using Shape = Solid::Shape;
constexpr float desk_z = -0.004f;  // the board is 4 mm thick

// The printed sheet: A4 across, the grid in its middle.
cv::Mat3b board_print(const BoardLayout& board, glm::vec2 sheet_m) {
  constexpr float px_per_m = 5000;
  const cv::Size size(cvRound(sheet_m.x * px_per_m), cvRound(sheet_m.y * px_per_m));
  cv::Mat3b print = plaster(size.width, size.height, px_per_m, {238, 242, 243}, 0.012f, 3);
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
  const int side = cvRound(board.size_m * px_per_m), pitch = cvRound((board.size_m + board.gap_m) * px_per_m);
  const cv::Point corner((size.width - cvRound(board.width_m() * px_per_m)) / 2,
                         (size.height - cvRound(board.height_m() * px_per_m)) / 2);
  for (int id = 0; id < board.columns * board.rows; ++id) {
    cv::Mat marker;
    cv::aruco::drawMarker(dictionary, id, side, marker, 1);
    cv::Mat3b place = print({corner.x + id % board.columns * pitch, corner.y + id / board.columns * pitch, side, side});
    place.setTo(cv::Vec3b(44, 41, 40), marker == 0);  // toner is no perfect black
  }
  cv::putText(print, "4X4_50  ids 0-11  52 mm", {corner.x, size.height - 18}, cv::FONT_HERSHEY_SIMPLEX, 0.7,
              cv::Scalar(120, 120, 120), 2, cv::LINE_AA);
  return print;
}

void add_book(Room& room, glm::vec3 at, float turn, glm::vec3 half, const Surface& cover, unsigned seed) {
  const int front = room.add_surface(cover);
  Surface plain = cover;
  plain.texture = cv::Mat3b();
  const cv::Scalar mean = cv::mean(cover.texture);
  const auto linear = [](double v) { return static_cast<float>(std::pow(v / 255, 2.2)); };
  plain.colour = {linear(mean[2]), linear(mean[1]), linear(mean[0])};
  const int binding = room.add_surface(plain);
  const int pages = room.add_surface({glm::vec3(1), page_edges(900, 90, seed), 0, 0});
  const glm::mat3 rotation = turn_z(turn);
  constexpr float board = 0.0013f;
  const auto put = [&](glm::vec3 size, glm::vec3 offset, std::vector<int> surfaces) {
    room.add({Shape::Box, size, at + rotation * offset, rotation, std::move(surfaces)});
  };
  put({half.x, half.y, board}, {0, 0, board}, {binding});
  put({half.x - 0.003f, half.y - 0.004f, half.z - 2 * board}, {0.001f, 0, half.z}, {pages});
  put({half.x, half.y, board}, {0, 0, 2 * half.z - board}, {binding, binding, binding, binding, binding, front});
  put({board, half.y, half.z - 2 * board}, {-half.x + board, 0, half.z}, {binding});
}

void add_mug(Room& room, glm::vec3 at, float handle_turn) {
  constexpr float r = 0.041f, h = 0.094f, wall = 0.0035f;
  const int outside = room.add_surface({glm::vec3(1), glazed_mug(1200, 480, 21), 1.0f, 900});
  const int inside = room.add_surface({{0.62f, 0.56f, 0.48f}, {}, 0.7f, 300});
  const int rim = room.add_surface({{0.50f, 0.42f, 0.33f}, {}, 0.8f, 300});
  const int coffee = room.add_surface({{0.030f, 0.014f, 0.007f}, {}, 1.3f, 1500});
  const int glaze = room.add_surface({{0.115f, 0.23f, 0.30f}, {}, 1.0f, 700});
  room.add({Shape::Tube, {r * 0.93f, r, h}, at, turn_z(40), {outside}});
  room.add({Shape::Tube, {r * 0.93f - wall, r - wall, h - 0.004f}, at + glm::vec3(0, 0, 0.004f), turn_z(0), {inside}});
  room.add({Shape::Ring, {r - wall, r, 0}, at + glm::vec3(0, 0, h), turn_z(0), {rim}});
  room.add({Shape::Ring, {0, r - wall, 0}, at + glm::vec3(0, 0, 0.076f), turn_z(0), {coffee}});
  room.add({Shape::Arc,
            {0.028f, 0.0056f, 0},
            at + turn_z(handle_turn) * glm::vec3(r * 0.965f, 0, 0.048f),
            turn_z(handle_turn),
            {glaze}});
}

void add_pencil(Room& room, glm::vec2 at, float turn, glm::vec3 paint, bool eraser) {
  constexpr float r = 0.0037f, body = 0.145f, point = 0.017f;
  const float a = turn * 3.14159265f / 180;
  const glm::vec3 along(std::cos(a), std::sin(a), 0);
  const glm::vec3 start(at, desk_z + r);
  const glm::mat3 frame = frame_along(along);
  const int lacquer = room.add_surface({paint, {}, 0.9f, 200});
  const int shaft = room.add_surface({{0.62f, 0.40f, 0.21f}, {}, 0.1f, 20});
  const int lead = room.add_surface({{0.04f, 0.04f, 0.045f}, {}, 0.5f, 60});
  room.add({Shape::Frustum, {r, r, body}, start, frame, {lacquer, shaft, shaft}});
  room.add({Shape::Frustum, {r, 0.0012f, point * 0.72f}, start + along * body, frame, {shaft}});
  room.add({Shape::Frustum, {0.0012f, 0.0002f, point * 0.28f}, start + along * (body + point * 0.72f), frame, {lead}});
  if (!eraser) return;
  const int metal = room.add_surface({{0.42f, 0.40f, 0.36f}, {}, 5.0f, 120});
  const int rubber = room.add_surface({{0.62f, 0.20f, 0.20f}, {}, 0.1f, 10});
  room.add({Shape::Frustum, {r * 1.03f, r * 1.03f, 0.013f}, start - along * 0.013f, frame, {metal}});
  room.add({Shape::Frustum, {r * 0.85f, r * 0.95f, 0.009f}, start - along * 0.022f, frame, {rubber}});
}

void add_succulent(Room& room, glm::vec3 at) {
  const int clay =
      room.add_surface({{0.52f, 0.21f, 0.115f}, plaster(500, 200, 4000, {235, 240, 245}, 0.08f, 31), 0.12f, 12});
  const int earth =
      room.add_surface({{0.055f, 0.038f, 0.026f}, plaster(300, 300, 3000, {200, 220, 240}, 0.5f, 33), 0, 0});
  const int green = room.add_surface({glm::vec3(1), leaf(128, 128, 37), 0.35f, 25});
  const int young = room.add_surface({{1.15f, 1.1f, 0.85f}, leaf(128, 128, 38), 0.35f, 25});
  room.add({Shape::Frustum, {0.036f, 0.046f, 0.064f}, at, turn_z(10), {clay}});
  room.add({Shape::Tube, {0.050f, 0.051f, 0.016f}, at + glm::vec3(0, 0, 0.060f), turn_z(0), {clay}});
  room.add({Shape::Ring, {0.045f, 0.051f, 0}, at + glm::vec3(0, 0, 0.076f), turn_z(0), {clay}});
  room.add({Shape::Ring, {0, 0.047f, 0}, at + glm::vec3(0, 0, 0.069f), turn_z(0), {earth}});
  // Leaves around the heart by the golden angle, the outer ones longer and flatter.
  constexpr int leaves = 30;
  for (int i = 0; i < leaves; ++i) {
    const float t = static_cast<float>(i) / (leaves - 1), a = 2.39996f * static_cast<float>(i);
    const float rise = 1.35f - 1.20f * t + 0.15f * uniform({static_cast<std::uint32_t>(i), 5});
    const float length = 0.012f + 0.030f * std::sqrt(t);
    const glm::vec3 along(std::cos(a) * std::cos(rise), std::sin(a) * std::cos(rise), std::sin(rise));
    const glm::vec3 side(-std::sin(a), std::cos(a), 0);
    const glm::mat3 frame(side, glm::cross(along, side), along);
    const glm::vec3 foot = at + glm::vec3(0, 0, 0.074f + 0.022f * (1 - t));
    room.add({Shape::Ellipsoid,
              {0.0065f + 0.0065f * t, 0.0032f, length},
              foot + along * length * 0.85f,
              frame,
              {t < 0.4f ? young : green}});
  }
}

void add_lamp(Room& room, glm::vec3 at) {
  const int enamel = room.add_surface({{0.030f, 0.060f, 0.075f}, {}, 1.0f, 120});
  const int brass = room.add_surface({{0.45f, 0.30f, 0.10f}, {}, 4.0f, 90});
  const int shade =
      room.add_surface({{0.62f, 0.55f, 0.42f}, cloth(800, 300, 3.0f, {235, 240, 245}, {225, 232, 240}, 8), 0, 0});
  room.add({Shape::Frustum, {0.075f, 0.070f, 0.016f}, at, turn_z(0), {enamel}});
  room.add({Shape::Frustum, {0.007f, 0.007f, 0.30f}, at + glm::vec3(0, 0, 0.016f), turn_z(0), {brass}});
  room.add({Shape::Tube, {0.125f, 0.085f, 0.16f}, at + glm::vec3(0, 0, 0.26f), turn_z(0), {shade}});
}

}  // namespace

Room make_desk_room(const BoardLayout& board, const std::vector<glm::vec3>& eyes) {
  Room room;
  const glm::vec2 middle(0.5f * board.width_m(), 0.5f * board.height_m()), sheet(0.297f, 0.210f);

  const int top = room.add_surface(
      {glm::vec3(0.95f), wood(4600, 2900, 2200, {146, 182, 214}, {74, 112, 156}, 0.145f, 1), 0.8f, 16});
  const int edge = room.add_surface({{0.35f, 0.22f, 0.12f}, {}, 0.3f, 12});
  room.add({Shape::Box,
            {1.045f, 0.659f, 0.015f},
            {0.12f, 0.10f, desk_z - 0.015f},
            glm::mat3(1),
            {edge, edge, edge, edge, edge, top}});
  const int wall = room.add_surface({glm::vec3(1), plaster(2400, 900, 1000, {206, 214, 214}, 0.035f, 2), 0, 0});
  room.add({Shape::Box, {1.6f, 0.05f, 0.6f}, {0.12f, 0.815f, 0.55f}, glm::mat3(1), {wall}});

  const int print = room.add_surface({glm::vec3(1), board_print(board, sheet), 0.25f, 12});
  const int foam = room.add_surface({glm::vec3(0.80f), {}, 0, 0});
  room.add({Shape::Box,
            {0.5f * sheet.x, 0.5f * sheet.y, 0.002f},
            {middle, -0.002f},
            glm::mat3(1),
            {foam, foam, foam, foam, foam, print}});

  add_book(room, {-0.170f, 0.295f, desk_z}, 12, {0.108f, 0.077f, 0.014f},
           {glm::vec3(0.9f), book_cover(1300, 930, {96, 62, 34}, "NIGHT HILLS", true, 41), 0.4f, 30}, 51);
  add_book(room, {-0.160f, 0.300f, desk_z + 0.028f}, -9, {0.092f, 0.064f, 0.009f},
           {glm::vec3(0.9f), book_cover(1100, 780, {52, 60, 158}, "LINES & LIGHT", false, 43), 0.4f, 30}, 53);
  add_mug(room, {0.395f, 0.245f, desk_z}, -62);
  add_succulent(room, {0.155f, 0.385f, desk_z});
  add_lamp(room, {0.56f, 0.52f, desk_z});
  add_pencil(room, {0.315f, 0.020f}, 62, {0.80f, 0.46f, 0.04f}, true);
  add_pencil(room, {0.352f, 0.000f}, 78, {0.035f, 0.16f, 0.36f}, false);

  const int paper = room.add_surface({glm::vec3(1), notebook_page(1480, 2100, 61), 0, 0});
  const int paper_edge = room.add_surface({glm::vec3(0.7f), {}, 0, 0});
  room.add({Shape::Box,
            {0.074f, 0.105f, 0.0012f},
            {-0.155f, 0.045f, desk_z + 0.0012f},
            turn_z(14),
            {paper_edge, paper_edge, paper_edge, paper_edge, paper_edge, paper}});
  const int note = room.add_surface({glm::vec3(1), sticky_note(640, "tea 4 pm\ncall Aki\n12 frames", 63), 0, 0});
  room.add({Shape::Box,
            {0.037f, 0.037f, 0.0004f},
            {0.365f, -0.085f, desk_z + 0.0004f},
            turn_z(-11),
            {paper_edge, paper_edge, paper_edge, paper_edge, paper_edge, note}});
  const int sleeve = room.add_surface({{0.05f, 0.13f, 0.42f}, {}, 0.2f, 15});
  const int rubber = room.add_surface({{0.72f, 0.72f, 0.70f}, {}, 0.15f, 10});
  room.add({Shape::Box, {0.018f, 0.0105f, 0.0058f}, {0.345f, 0.145f, desk_z + 0.0058f}, turn_z(32), {rubber}});
  room.add({Shape::Box,
            {0.0125f, 0.0108f, 0.0061f},
            glm::vec3(0.345f, 0.145f, desk_z + 0.0061f) - turn_z(32) * glm::vec3(0.006f, 0, 0),
            turn_z(32),
            {sleeve}});

  room.set_light({{-1.35f, -1.05f, 0.35f}, {0, 1.25f, 0}, {0, 0, 1.15f}, {15.4f, 15.2f, 14.9f}}, {0.32f, 0.33f, 0.345f},
                 {0.15f, 0.13f, 0.11f});
  room.bake(0.0032f, 128, eyes);
  return room;
}

}  // namespace rinkaku::recordings

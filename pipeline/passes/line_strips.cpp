#include "pipeline/passes/line_strips.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

namespace rinkaku::passes {
namespace {

// Per point, from 0 where its faces' normals are nearly its outline normal to 1 where one of them is far from it.
std::vector<float> hardness(const mesh::Topology& topology) {
  constexpr float smooth = 0.966f, hard = 0.819f;  // cosines of 15 and 35 degrees
  std::vector<float> least(topology.points.size(), 1.0f);
  for (std::size_t f = 0; f < topology.faces.size(); ++f) {
    const glm::vec3 normal = topology.turned[f] != 0 ? -topology.face_normals[f] : topology.face_normals[f];
    if (normal == glm::vec3(0)) continue;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t p = topology.faces[f][k];
      least[p] = std::min(least[p], glm::dot(normal, topology.outline_normals[p]));
    }
  }
  for (float& cosine : least) cosine = 1 - glm::smoothstep(hard, smooth, cosine);
  return least;
}

// To the nearest; above 0 before it is cut, so that no call to round is needed.
std::int16_t snorm(float f) {
  return static_cast<std::int16_t>(static_cast<int>(std::clamp(f, -1.0f, 1.0f) * 32767.0f + 32768.5f) - 32768);
}

// How the lens moves a pixel of the plate when the pixel of the pinhole picture moves.
glm::mat2 lens_around(const glm::vec3& seen, const CameraModel& camera) {
  if (!(seen.z > 0)) return glm::mat2(1);
  const glm::dvec2 pixel = glm::dvec2(seen) / static_cast<double>(seen.z);
  const auto shown = [&](const glm::dvec2& p) { return to_pixels(camera, distort(camera, to_normalised(camera, p))); };
  const glm::dvec2 here = shown(pixel);
  const glm::mat2 lens(shown(pixel + glm::dvec2(1, 0)) - here, shown(pixel + glm::dvec2(0, 1)) - here);
  // Beyond where the lens folds its formula means nothing.
  return glm::determinant(lens) > 0.1f ? lens : glm::mat2(1);
}

glm::vec2 unit(const glm::vec2& v) {
  const float length = glm::length(v);
  return length > 0 ? v / length : glm::vec2(0);
}

}  // namespace

LineStrips::LineStrips(const mesh::Mesh& mesh, const mesh::Topology& topology, bool mirrored)
    : mirrored_(mirrored),
      welded_(mesh.welded),
      hard_(hardness(topology)),
      factors_(topology.points.size(), 1.0f),
      place_of_(topology.points.size(), 0) {}

void LineStrips::style(const LineStyle& style) {
  taper_px_ = style.taper_px;
  longest_px_ = style.longest_px;
  factors_.assign(style.factors.begin(), style.factors.end());
  factors_.resize(hard_.size(), 1.0f);
  largest_factor_ = factors_.empty() ? 1.0f : *std::max_element(factors_.begin(), factors_.end());
  most_added_m_ = style.most_added_m;
  width_px_ = style.width_px, width_m_ = style.width_m, least_px_ = style.least_px, most_px_ = style.most_px;
  follow_ = style.follow;
  if (follow_) largest_factor_ = std::max(largest_factor_, style.most_factor);
}

void LineStrips::find_factors(const ContourStrips& contour, std::span<const glm::vec3> points,
                              std::span<const glm::vec3> outline_normals) {
  if (!follow_) return;
  wanted_.clear();
  for (const ContourStrips::Piece& piece : contour.pieces()) {
    wanted_.push_back(welded_[piece.from]);
    wanted_.push_back(welded_[piece.to]);
  }
  follow_({points, outline_normals, wanted_, factors_});
}

// The factor of a place, or what adds the most that may be added there.
float LineStrips::limited(const Place& place, float focal_px) const {
  if (most_added_m_.empty() || place.factor <= 1 || !(place.seen.z > 0)) return place.factor;
  const float px_per_m = focal_px / place.seen.z;
  const float base_px = std::clamp(width_px_ + width_m_ * px_per_m, least_px_, most_px_);
  return std::min(place.factor, 1 + most_added_m_[place.point] * px_per_m / std::max(base_px, 1e-6f));
}

std::uint32_t LineStrips::place_at(std::uint32_t vertex, std::span<const ShapeVertex> vertices,
                                   const glm::mat4& to_pixels, const CameraModel* lens) {
  const std::uint32_t point = welded_[vertex];
  const std::uint32_t known = place_of_[point];
  if (known < places_.size() && places_[known].point == point) return known;
  const ShapeVertex& v = vertices[vertex];
  Place place;
  place.point = point;
  place.position = v.position;
  place.factor = factors_[point];
  place.soft = hard_[point] < 0.5f;
  place.seen = glm::vec3(to_pixels * glm::vec4(v.position, 1));
  const glm::vec3 n(to_pixels * glm::vec4(v.outline_normal[0], v.outline_normal[1], v.outline_normal[2], 0));
  const float z = place.seen.z;
  // Which way the pixel moves when the point moves along its normal.
  place.normal = glm::vec2(n) * z - glm::vec2(place.seen) * n.z;
  if (lens != nullptr) {
    place.plate_from_pinhole = lens_around(place.seen, *lens);
    place.normal = place.plate_from_pinhole * place.normal;
  }
  place.normal = unit(place.normal);
  place.shortest_px = 1e30f;
  place_of_[point] = static_cast<std::uint32_t>(places_.size());
  places_.push_back(place);
  return place_of_[point];
}

// Whether the contour bends the same way here and at both neighbours, as a rim does.
bool LineStrips::bends_evenly(const Place& place) const {
  const auto bend = [](const Place& p) { return p.ends == 2 ? -glm::dot(p.outwards[1], p.onwards[0]) : 0.0f; };
  const float here = bend(place);
  return here * bend(places_[place.next[0]]) > 0 && here * bend(places_[place.next[1]]) > 0;
}

void LineStrips::find_push(Place& place) const {
  // Edges shorter than this count less where a contour zigzags: over small triangles, corners say nothing.
  constexpr float full_px = 3;
  place.push = {place.normal, place.normal};
  const float hard = hard_[place.point];
  if (hard == 0 || place.ends == 0) return;
  const glm::vec2 first = place.outwards[0], second = place.outwards[1];
  if (place.ends != 2) {
    // An end, or several lines through one point: along the normal, as far as fits them on average.
    const float cosine = place.along_normal / static_cast<float>(place.ends);
    const glm::vec2 push = place.ends == 1 ? first : place.normal * (1 / std::clamp(cosine, 1 / kMiterLimit, 1.0f));
    place.push[0] = place.push[1] = glm::mix(place.normal, push, hard);
    return;
  }
  const float agree = glm::dot(first, second);
  const float clear = bends_evenly(place) ? 1.0f : std::min(place.shortest_px / full_px, 1.0f);
  const float weight = hard * std::max(glm::smoothstep(0.7f, 0.9f, agree), clear);
  const glm::vec2 sum = first + second;
  if ((1 + agree) * kMiterLimit * kMiterLimit >= 2) {
    const glm::vec2 miter = sum / (1 + agree);
    place.push[0] = place.push[1] = glm::mix(place.normal, miter, weight);
    return;
  }
  // To where each edge's offset meets the cut, which is at right angles to the bisector.
  const glm::vec2 apart = first - second;
  glm::vec2 bisector = unit(glm::vec2(-apart.y, apart.x));
  const bool sum_is_clear = glm::dot(sum, sum) > 1e-6f;
  if (glm::dot(bisector, sum_is_clear ? sum : place.normal) < 0) bisector = -bisector;
  for (int k = 0; k < 2; ++k) {
    const glm::vec2 n = place.outwards[static_cast<std::size_t>(k)];
    const glm::vec2 onwards = bisector - n * glm::dot(n, bisector);
    const float rise = glm::dot(onwards, bisector);
    const glm::vec2 cut = n + onwards * ((kMiterLimit - glm::dot(n, bisector)) / std::max(rise, 1e-6f));
    place.push[static_cast<std::size_t>(k)] = glm::mix(place.normal, cut, weight);
  }
  place.cut = weight > 0;
}

// Notes that an edge ends here whose other end, `next`, lies that way; its outside is to the left of it or, with side
// 1, to the right. Says which end of a piece this is.
std::uint8_t LineStrips::meet(Place& place, std::uint32_t next, const glm::vec2& way, float side, float length_px) {
  const glm::vec2 onwards = unit(place.plate_from_pinhole * way);
  const glm::vec2 outwards = glm::vec2(onwards.y, -onwards.x) * side;
  const auto end = static_cast<std::size_t>(place.ends++);
  if (end < 2)
    place.outwards[end] = outwards, place.onwards[end] = onwards, place.next[end] = next,
    place.length_px[end] = length_px;
  place.shortest_px = std::min(place.shortest_px, length_px);
  place.along_normal += glm::dot(outwards, place.normal);
  return static_cast<std::uint8_t>(std::min<std::size_t>(end, 1));
}

void LineStrips::note_hidden(std::span<const ContourStrips::Piece> pieces, std::span<const ShapeVertex> vertices,
                             const glm::mat4& to_pixels, const CameraModel* lens) {
  for (const ContourStrips::Piece& piece : pieces) {
    const std::uint32_t ends[2] = {place_at(piece.from, vertices, to_pixels, lens),
                                   place_at(piece.to, vertices, to_pixels, lens)};
    const glm::vec3 a = places_[ends[0]].seen, b = places_[ends[1]].seen;
    const float length_px = glm::length(glm::vec2(b) * a.z - glm::vec2(a) * b.z) / std::abs(a.z * b.z);
    for (int k = 0; k < 2; ++k) {
      Place& place = places_[ends[k]];
      const auto end = static_cast<std::size_t>(place.hidden_ends++);
      if (end < 2) place.hidden_next[end] = ends[1 - k], place.hidden_length_px[end] = length_px;
    }
  }
}

// Where one edge of a contour, of less than a pixel, is hidden, two lines' ends meet, each pushed its own way: what
// closes them.
void LineStrips::bridge_hidden(std::span<const ContourStrips::Piece> pieces) {
  constexpr float longest_px = 1;
  for (const ContourStrips::Piece& piece : pieces) {
    const std::uint32_t from = place_of_[welded_[piece.from]], to = place_of_[welded_[piece.to]];
    if (from >= places_.size() || to >= places_.size()) continue;
    const Place &a = places_[from], &b = places_[to];
    if (a.point != welded_[piece.from] || b.point != welded_[piece.to] || a.ends == 0 || b.ends == 0) continue;
    const glm::vec2 way = glm::vec2(b.seen) * a.seen.z - glm::vec2(a.seen) * b.seen.z;
    if (glm::length(way) < longest_px * std::abs(a.seen.z * b.seen.z)) lines_.push_back({from, to, 0, 0});
  }
}

// How long the contour is hidden from the end of a line to the start of the next.
float LineStrips::hidden_px(std::uint32_t from) const {
  float way_px = 0;
  std::uint32_t before = from, here = from;
  do {
    const Place& place = places_[here];
    if (place.hidden_ends == 0) break;
    const std::size_t on = place.hidden_ends >= 2 && place.hidden_next[0] == before ? 1 : 0;
    way_px += place.hidden_length_px[on];
    before = here;
    here = place.hidden_next[on];
  } while (way_px < taper_px_ && places_[here].ends == 0 && places_[here].hidden_ends == 2);
  return way_px;
}

// Lines that end on a surface end thin.
void LineStrips::taper_ends() {
  constexpr float thinnest = 0.1f;
  for (std::uint32_t end = 0; end < places_.size(); ++end) {
    if (places_[end].ends != 1) continue;
    // Over small triangles a line may be hidden for a few of them in its middle.
    const float least = 1 - (1 - thinnest) * std::min(hidden_px(end) / taper_px_, 1.0f);
    float way_px = 0;
    std::uint32_t before = end, here = end;
    do {
      Place& place = places_[here];
      place.taper = std::min(place.taper, glm::mix(least, 1.0f, std::min(way_px / taper_px_, 1.0f)));
      const std::size_t on = place.ends == 2 && place.next[0] == before ? 1 : 0;
      way_px += place.length_px[on];
      before = here;
      here = place.next[on];
    } while (way_px < taper_px_ && places_[here].ends == 2);
  }
}

// Into how many pieces of the screen's way from end to end a line is cut, so that none is longer than longest_px_, as
// far as 64 do.
int LineStrips::pieces_of(const Place& from, const Place& to) const {
  constexpr int most = 64;
  if (longest_px_ <= 0 || !(from.seen.z > 0) || !(to.seen.z > 0)) return 1;
  const glm::vec2 a = glm::vec2(from.seen) / from.seen.z, b = glm::vec2(to.seen) / to.seen.z;
  // What lies wholly beside the plate stays whole; a lens may show a little more than it.
  const glm::vec2 around = 0.25f * plate_px_, least = glm::min(a, b), largest = glm::max(a, b);
  if (glm::any(glm::lessThan(largest, -around)) || glm::any(glm::greaterThan(least, plate_px_ + around))) return 1;
  const float length_px = glm::distance(a, b);
  return static_cast<int>(std::clamp(std::ceil(length_px / longest_px_), 1.0f, static_cast<float>(most)));
}

// A quad; several where a smooth line bends much from end to end, so that its rim is round, and where it is long.
void LineStrips::emit(const Line& line) {
  const Place &from = places_[line.from], &to = places_[line.to];
  const glm::vec2 &first = from.push[line.from_end], &last = to.push[line.to_end];
  float turn = 0;
  if (from.soft && to.soft) turn = std::atan2(first.x * last.y - first.y * last.x, glm::dot(first, last));
  constexpr float flat = 0.14f;  // 8 degrees: the rim of a line 15 px wide is off by a twentieth of a pixel
  const int bends = std::clamp(static_cast<int>(std::ceil(std::abs(turn) / flat)), 1, 8);
  const int count = std::max(bends, pieces_of(from, to));
  const float growth = bends > 1 ? glm::length(last) / glm::length(first) : 1.0f;
  std::uint32_t before = add(from, first, false);
  add(from, first, true);
  for (int i = 1; i <= count; ++i) {
    std::uint32_t here = 0;
    if (i == count) {
      here = add(to, last, false);
      add(to, last, true);
    } else {
      const float t = static_cast<float>(i) / static_cast<float>(count);
      glm::vec2 push = glm::mix(first, last, t);
      if (bends > 1) {
        const float length = glm::mix(1.0f, growth, t);
        const float cosine = length * std::cos(turn * t), sine = length * std::sin(turn * t);
        push = glm::vec2(cosine * first.x - sine * first.y, sine * first.x + cosine * first.y);
      }
      here = add_between(from, to, t, push, false);
      add_between(from, to, t, push, true);
    }
    for (std::uint32_t corner : {before, here, before + 1, before + 1, here, here + 1}) indices_.push_back(corner);
    before = here;
  }
}

// `t` counts along the screen's way.
std::uint32_t LineStrips::add_between(const Place& from, const Place& to, float t, const glm::vec2& push, bool rim) {
  Place place = from;
  const float there = t * from.seen.z, deep = there + (1 - t) * to.seen.z;
  place.position = glm::mix(from.position, to.position, from.seen.z > 0 && to.seen.z > 0 ? there / deep : t);
  place.factor = glm::mix(from.factor * from.taper, to.factor * to.taper, t);
  place.taper = 1;
  return add(place, push, rim);
}

std::uint32_t LineStrips::add(const Place& place, const glm::vec2& push, bool rim) {
  constexpr float scale = 1 / LineVertex::most_push;
  largest_push_squared_ = std::max(largest_push_squared_, glm::dot(push, push));
  line_vertices_.push_back(
      {place.position,
       {snorm(push.x * scale), snorm(push.y * scale), snorm(place.factor * place.taper / largest_factor_),
        static_cast<std::int16_t>(rim ? 32767 : 0)}});
  return static_cast<std::uint32_t>(line_vertices_.size() - 1);
}

void LineStrips::collect(const ContourStrips& contour, std::span<const ShapeVertex> vertices,
                         const glm::mat4& to_pixels, const CameraModel& camera) {
  places_.clear();
  lines_.clear();
  line_vertices_.clear();
  indices_.clear();
  largest_push_squared_ = 1;
  plate_px_ = {camera.width_px, camera.height_px};
  const CameraModel* lens = camera.has_distortion() ? &camera : nullptr;
  for (const ContourStrips::Piece& piece : contour.pieces()) {
    Line line{place_at(piece.from, vertices, to_pixels, lens), place_at(piece.to, vertices, to_pixels, lens), 0, 0};
    Place &from = places_[line.from], &to = places_[line.to];
    // The way on the screen from the one end to the other, also if one of them lies behind the eye.
    const glm::vec2 way = glm::vec2(to.seen) * from.seen.z - glm::vec2(from.seen) * to.seen.z;
    const float length_px = glm::length(way) / std::abs(from.seen.z * to.seen.z);
    constexpr float least_px = 1e-3f;  // shorter ones are mostly rounding
    if (length_px > least_px) {
      // Faces run anticlockwise as seen from outside, so their outside is to the right; rows run downwards.
      const float side = mirrored_ != piece.from_behind ? 1.0f : -1.0f;
      line.from_end = meet(from, line.to, way, side, length_px);
      line.to_end = meet(to, line.from, -way, -side, length_px);
    }
    lines_.push_back(line);
  }
  for (Place& place : places_) {
    place.factor = limited(place, static_cast<float>(camera.fx_px));
    find_push(place);
    if (lens == nullptr) continue;
    const glm::mat2 pinhole_from_plate = glm::inverse(place.plate_from_pinhole);
    for (glm::vec2& push : place.push) push = pinhole_from_plate * push;
  }
  if (taper_px_ > 0) {
    note_hidden(contour.hidden_pieces(), vertices, to_pixels, lens);
    taper_ends();
  }
  bridge_hidden(contour.hidden_pieces());
  for (const Line& line : lines_) emit(line);
  for (const Place& place : places_) {
    if (!place.cut) continue;
    indices_.push_back(add(place, (place.push[0] + place.push[1]) * 0.5f, false));
    for (const glm::vec2& push : place.push) indices_.push_back(add(place, push, true));
  }
}

}  // namespace rinkaku::passes

#include "water/painting.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "water/scatter.h"

namespace rinkaku::water {
namespace {

constexpr int keys_ahead = 2;
constexpr double looked_ahead_frames = 6;
constexpr std::uint32_t nobody = 0xffffffff;

enum Purpose : std::uint64_t { LookX = 100, LookY, Light, Variant, Length, Turn };

double signed_noise(const Drifter& d, std::uint64_t purpose) { return 2 * scattered(d.serial, purpose) - 1; }

PaintingOptions settled(const Surface& surface, const std::optional<Outlook>& outlook, PaintingOptions o) {
  if (!(o.size.length_m > 0)) o.size.length_m = covering_length_m(surface, outlook, o.size, o.strokes, o.layers);
  return o;
}

ParticleOptions particle_options(const PaintingOptions& o) {
  ParticleOptions p;
  p.seconds_per_frame = o.seconds_per_frame;
  // Whoever comes after at a place must not write its colours while they are still wanted.
  if (o.colours == PaintingOptions::Colours::Keys) p.rest_frames = 4 * o.key_frames;
  return p;
}

}  // namespace

Painting::Course::Course(const Painting& p)
    : flow(p.surface_, p.arrows_, p.options_.flow, p.bodies_),
      particles(p.surface_, *p.plots_, flow, particle_options(p.options_)) {}

Painting::Painting(const Surface& surface, std::vector<ArrowKey> arrows, std::vector<Segment> bodies,
                   const std::optional<Outlook>& outlook, const PaintingOptions& options)
    : surface_(surface),
      arrows_(std::move(arrows)),
      bodies_(std::move(bodies)),
      options_(settled(surface, outlook, options)) {
  plots_.emplace(surface, StrokeDensity(surface, outlook, options_.size), options_.strokes);
  restart();
}

void Painting::restart() {
  course_.reset(), moments_.reset(), keys_.reset(), followed_.reset();
  course_.emplace(*this);
  frame_ = 0;
  const std::size_t places = course_->particles.list().size();
  if (options_.colours == PaintingOptions::Colours::Keys) {
    moments_.emplace(keys_ahead * options_.key_frames + 1, places);
    keys_.emplace(places, options_.key_frames);
  } else {
    moments_.emplace(1, places);
    followed_.emplace(places);
  }
  serial_.assign(places, nobody);
  unordered_.reserve(places), strokes_.reserve(places), depths_m_.reserve(places);
  keep_moment();
}

void Painting::keep_moment() {
  const Particles& particles = course_->particles;
  std::vector<Drifter>& moment = moments_->begin(particles.frame());
  for (std::uint32_t i = 0; i < particles.list().size(); ++i) {
    const Particle& p = particles.list()[i];
    if (p.state == Particle::State::Free) continue;
    const auto opacity = static_cast<std::uint16_t>(std::lround(65535 * p.opacity));
    moment.push_back({glm::vec2(p.at), glm::vec2(p.velocity), p.serial, i, opacity, brush_of(p)});
  }
}

void Painting::advance() {
  course_->particles.advance();
  keep_moment();
}

bool Painting::place(const Drifter& d, Stroke& stroke) const {
  const glm::dvec3 c = seen_.at(d.at);
  if (!(c.z > 0.02)) return false;
  const CameraModel& camera = *seen_.camera;
  const double x = c.x / c.z, y = c.y / c.z;
  stroke.middle_px = to_pixels(camera, {x, y});
  stroke.depth_m = static_cast<float>(c.z);
  // The stroke points where the flow goes; in still water across the picture.
  const auto on_screen = [&](glm::dvec2 way) {
    const glm::dvec3 v = seen_.along_x * way.x + seen_.along_y * way.y;
    return glm::dvec2(v.x - x * v.z, v.y - y * v.z);
  };
  const glm::dvec2 velocity(d.velocity);
  const double speed = glm::length(velocity);
  const double length = stroke_length_px(options_.size, camera.fx_px, c.z) * (1 + 0.25 * signed_noise(d, Length));
  glm::dvec2 direction(1, 0);
  double shortened = 1;
  if (speed > 1e-9) {
    const glm::dvec2 screen = on_screen(velocity / speed);
    shortened = std::min(glm::length(screen), 1.0);
    if (shortened > 1e-6) direction = screen / glm::length(screen);
    shortened = 1 + options_.foreshortening * (shortened - 1);
  }
  const double turn = 0.12 * signed_noise(d, Turn);
  direction = {direction.x * std::cos(turn) - direction.y * std::sin(turn),
               direction.x * std::sin(turn) + direction.y * std::cos(turn)};
  const double width = stroke_width_px(options_.size, length);
  stroke.half_px = direction * (std::max(length * shortened, 1.2 * width) / 2);
  stroke.half_width_px = static_cast<float>(width / 2);
  const glm::vec2 room(length, length);
  return stroke.middle_px.x > -room.x && stroke.middle_px.y > -room.y &&
         stroke.middle_px.x < static_cast<float>(camera.width_px) + room.x &&
         stroke.middle_px.y < static_cast<float>(camera.height_px) + room.y;
}

glm::dvec2 Painting::screen_velocity(const Drifter& d) const {
  const glm::dvec3 c = seen_.at(d.at);
  const glm::dvec3 v = seen_.along_x * double(d.velocity.x) + seen_.along_y * double(d.velocity.y);
  return glm::dvec2(v.x - c.x / c.z * v.z, v.y - c.y / c.z * v.z) * (seen_.camera->fx_px / c.z);
}

glm::vec3 Painting::wave_colour(const Drifter& d, const ReferencePicture& reference) const {
  Stroke s;
  place(d, s);
  const double length = glm::length(s.half_px) * 2;
  // Waves throw the mirrored ray up and down more than aside, and every stroke its own way.
  const glm::dvec2 look = glm::dvec2(s.middle_px) +
                          glm::dvec2(0.3 * signed_noise(d, LookX), signed_noise(d, LookY)) * (options_.ripple * length);
  if (!options_.mean) return reference.at(look);
  // The stroke's own area; less of it along the stroke where colours are averaged along its way in time as well: over
  // the keys around, or by the filter, which is helped by looking some frames ahead and back.
  using Colours = PaintingOptions::Colours;
  const double along = options_.colours == Colours::Sampled ? 0.6 : 0.12;
  glm::dvec2 reach = glm::abs(glm::dvec2(s.half_px)) * along;
  if (options_.colours == Colours::Followed) {
    reach += glm::abs(screen_velocity(d)) * (options_.seconds_per_frame * looked_ahead_frames);
  }
  return neighbourhood_mean(reference, look, reach + double(s.half_width_px));
}

// Of the last frame that is known.
void Painting::advance_colours(const ReferencePicture& reference) {
  const std::int64_t frame = course_->particles.frame();
  const bool on_key = frame % options_.key_frames == 0;
  const std::int64_t key = frame / options_.key_frames;
  for (const Drifter& d : moments_->of(frame)) {
    const bool fresh = serial_[d.place] != d.serial;
    serial_[d.place] = d.serial;
    if (followed_) {
      const glm::vec3 colour = wave_colour(d, reference);
      const bool start = fresh || options_.colours == PaintingOptions::Colours::Sampled;
      start ? followed_->start(d.place, colour) : followed_->follow(d.place, colour);
    } else if (fresh || on_key) {
      const glm::vec3 colour = wave_colour(d, reference);
      // What comes after is filled in as well, should there be no later key.
      keys_->fill(d.place, fresh ? key - 2 : key, key + 3, colour);
    }
  }
}

void Painting::go_to(std::int64_t frame, const MakeReference& reference) {
  if (frame < frame_) restart();
  frame_ = frame;
  const Particles& particles = course_->particles;
  const std::int64_t last = keys_ ? frame + keys_ahead * options_.key_frames : frame;
  // What followed colours have forgotten isn't looked at.
  const std::int64_t first_seen = keys_ ? 0 : frame - memory_frames;
  const bool begins = particles.frame() == 0 && (serial_.empty() || serial_.front() == nobody);
  if (begins && first_seen <= 0) advance_colours(reference());
  while (particles.frame() < last) {
    advance();
    if (particles.frame() >= first_seen) advance_colours(reference());
  }
}

std::uint8_t Painting::brush_of(const Particle& p) const {
  // Where arrows crowd the flow changes: a sparse brush, whose strokes show its way. Far from them a dense one.
  const double crowd = course_->flow.crowding(p.at), noise = 2 * scattered(p.serial, Variant) - 1;
  const int density = std::clamp(static_cast<int>(brush_densities - 0.5 - crowd + noise * 0.5), 0, brush_densities - 1);
  return static_cast<std::uint8_t>(density * brush_variants +
                                   static_cast<int>(scattered(p.serial, Variant + 50) * brush_variants));
}

void Painting::add_stroke(const Drifter& d) {
  Stroke stroke;
  if (!place(d, stroke)) return;
  glm::vec3 colour = keys_ ? keys_->at(d.place, frame_) : followed_->at(d.place);
  colour = glm::clamp(colour + static_cast<float>(options_.variety * signed_noise(d, Light)), 0.0f, 1.0f);
  for (int c = 0; c < 3; ++c) stroke.colour[c] = static_cast<std::uint8_t>(std::lround(255 * colour[c]));
  stroke.colour[3] = static_cast<std::uint8_t>(std::lround(255 * options_.opacity * d.opacity / 65535));
  if (options_.brush_places.empty()) {
    stroke.brush = d.brush;
  } else {
    stroke.blend = brush_shares(options_.brush_places, d.at);
  }
  unordered_.push_back(stroke);
  depths_m_.push_back(stroke.depth_m);
}

const Strokes& Painting::paint(std::int64_t frame, const CameraModel& camera, const RigidTransform& camera_from_world,
                               const MakeReference& reference) {
  seen_.origin = camera_from_world * surface_.to_world({0, 0});
  seen_.along_x = camera_from_world * surface_.to_world({1, 0}) - seen_.origin;
  seen_.along_y = camera_from_world * surface_.to_world({0, 1}) - seen_.origin;
  seen_.camera = &camera;
  go_to(frame, reference);
  unordered_.clear(), depths_m_.clear(), strokes_.clear();
  for (const Drifter& d : moments_->of(frame)) add_stroke(d);
  for (const std::uint32_t i : order_.farthest_first(depths_m_)) strokes_.push_back(unordered_[i]);
  return strokes_;
}

}  // namespace rinkaku::water

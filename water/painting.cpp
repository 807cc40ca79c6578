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

double signed_noise(const Particle& p, std::uint64_t purpose) { return 2 * scattered(p.serial, purpose) - 1; }

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
  now_.reset(), ahead_.reset(), keys_.reset(), followed_.reset();
  now_.emplace(*this);
  const std::size_t places = now_->particles.list().size();
  if (options_.colours == PaintingOptions::Colours::Keys) {
    ahead_.emplace(*this);
    keys_.emplace(places, options_.key_frames);
  } else {
    followed_.emplace(places);
  }
  serial_.assign(places, nobody);
  unordered_.reserve(places), strokes_.reserve(places), depths_m_.reserve(places);
}

bool Painting::place(const Particle& p, Stroke& stroke) const {
  const glm::dvec3 c = seen_.origin + seen_.along_x * p.at.x + seen_.along_y * p.at.y;
  if (!(c.z > 0.02)) return false;
  const CameraModel& camera = *seen_.camera;
  const double x = c.x / c.z, y = c.y / c.z;
  stroke.middle_px = to_pixels(camera, {x, y});
  stroke.depth_m = static_cast<float>(c.z);
  // The stroke points where the flow goes; in still water across the picture.
  const auto on_screen = [&](glm::dvec2 d) {
    const glm::dvec3 v = seen_.along_x * d.x + seen_.along_y * d.y;
    return glm::dvec2(v.x - x * v.z, v.y - y * v.z);
  };
  const double speed = glm::length(p.velocity);
  const double length = stroke_length_px(options_.size, camera.fx_px, c.z) * (1 + 0.25 * signed_noise(p, Length));
  glm::dvec2 direction(1, 0);
  double shortened = 1;
  if (speed > 1e-9) {
    const glm::dvec2 screen = on_screen(p.velocity / speed);
    shortened = std::min(glm::length(screen), 1.0);
    if (shortened > 1e-6) direction = screen / glm::length(screen);
    shortened = 1 + options_.foreshortening * (shortened - 1);
  }
  const double turn = 0.12 * signed_noise(p, Turn);
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

glm::dvec2 Painting::screen_velocity(const Particle& p) const {
  const glm::dvec3 c = seen_.origin + seen_.along_x * p.at.x + seen_.along_y * p.at.y;
  const glm::dvec3 v = seen_.along_x * p.velocity.x + seen_.along_y * p.velocity.y;
  return glm::dvec2(v.x - c.x / c.z * v.z, v.y - c.y / c.z * v.z) * (seen_.camera->fx_px / c.z);
}

glm::vec3 Painting::wave_colour(const Particle& p, const ReferencePicture& reference) const {
  Stroke s;
  place(p, s);
  const double length = glm::length(s.half_px) * 2;
  // Waves throw the mirrored ray up and down more than aside, and every stroke its own way.
  const glm::dvec2 look = glm::dvec2(s.middle_px) +
                          glm::dvec2(0.3 * signed_noise(p, LookX), signed_noise(p, LookY)) * (options_.ripple * length);
  if (!options_.mean) return reference.at(look);
  // The stroke's own area; less of it along the stroke where colours are averaged along its way in time as well: over
  // the keys around, or by the filter, which is helped by looking some frames ahead and back.
  using Colours = PaintingOptions::Colours;
  const double along = options_.colours == Colours::Sampled ? 0.6 : 0.12;
  glm::dvec2 reach = glm::abs(glm::dvec2(s.half_px)) * along;
  if (options_.colours == Colours::Followed) {
    reach += glm::abs(screen_velocity(p)) * (options_.seconds_per_frame * looked_ahead_frames);
  }
  return neighbourhood_mean(reference, look, reach + double(s.half_width_px));
}

void Painting::advance_colours(const ReferencePicture& reference) {
  const Particles& particles = ahead_ ? ahead_->particles : now_->particles;
  const std::int64_t frame = particles.frame();
  const bool on_key = frame % options_.key_frames == 0;
  const std::int64_t key = frame / options_.key_frames;
  for (std::size_t i = 0; i < particles.list().size(); ++i) {
    const Particle& p = particles.list()[i];
    if (p.state == Particle::State::Free) continue;
    const bool fresh = serial_[i] != p.serial;
    serial_[i] = p.serial;
    if (followed_) {
      const glm::vec3 colour = wave_colour(p, reference);
      const bool start = fresh || options_.colours == PaintingOptions::Colours::Sampled;
      start ? followed_->start(i, colour) : followed_->follow(i, colour);
    } else if (fresh || on_key) {
      const glm::vec3 colour = wave_colour(p, reference);
      // What comes after is filled in as well, should there be no later key.
      keys_->fill(i, fresh ? key - 2 : key, key + 3, colour);
    }
  }
}

void Painting::go_to(std::int64_t frame, const MakeReference& reference) {
  if (frame < now_->particles.frame()) restart();
  const bool first = now_->particles.frame() == 0 && (serial_.empty() || serial_.front() == nobody);
  if (followed_) {
    if (first && frame - now_->particles.frame() <= memory_frames) advance_colours(reference());
    while (now_->particles.frame() < frame) {
      now_->particles.advance();
      if (frame - now_->particles.frame() <= memory_frames) advance_colours(reference());
    }
    return;
  }
  if (first) advance_colours(reference());
  while (now_->particles.frame() < frame) now_->particles.advance();
  while (ahead_->particles.frame() < frame + keys_ahead * options_.key_frames) {
    ahead_->particles.advance();
    advance_colours(reference());
  }
}

float Painting::brush_of(const Particle& p) const {
  // Where arrows crowd the flow changes: a sparse brush, whose strokes show its way. Far from them a dense one.
  const double crowd = now_->flow.crowding(p.at);
  const int density = std::clamp(static_cast<int>(brush_densities - 0.5 - crowd + signed_noise(p, Variant) * 0.5), 0,
                                 brush_densities - 1);
  return static_cast<float>(density * brush_variants +
                            static_cast<int>(scattered(p.serial, Variant + 50) * brush_variants));
}

void Painting::add_stroke(std::size_t i, const Particle& p) {
  Stroke stroke;
  if (!place(p, stroke)) return;
  glm::vec3 colour = keys_ ? keys_->at(i, now_->particles.frame()) : followed_->at(i);
  colour = glm::clamp(colour + static_cast<float>(options_.variety * signed_noise(p, Light)), 0.0f, 1.0f);
  for (int c = 0; c < 3; ++c) stroke.colour[c] = static_cast<std::uint8_t>(std::lround(255 * colour[c]));
  stroke.colour[3] = static_cast<std::uint8_t>(std::lround(255 * p.opacity * options_.opacity));
  if (options_.brush_places.empty()) {
    stroke.brush = brush_of(p);
  } else {
    stroke.blend = brush_shares(options_.brush_places, p.at);
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
  const auto list = now_->particles.list();
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].state != Particle::State::Free) add_stroke(i, list[i]);
  }
  for (const std::uint32_t i : order_.farthest_first(depths_m_)) strokes_.push_back(unordered_[i]);
  return strokes_;
}

}  // namespace rinkaku::water

#include "pipeline/stages/water_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>
#include <utility>

#include "pipeline/passes/layer_renderer.h"
#include "pipeline/stages/small_picture.h"
#include "pipeline/stages/water_set_up.h"
#include "water/pass/water_pass.h"
#include "water/waterline.h"

namespace rinkaku::pipeline {
namespace {

// Pixels of the recording that one of the reference picture, of the mirrored objects and of the filmed picture stands
// for: strokes are larger than that.
constexpr int reference_step_px = 4, mirrored_step_px = 2;
constexpr int plate_most_px = 320;
// Where colours follow the reference picture is made anew every so many frames.
constexpr std::int64_t reference_lasts = 3;
// Of its pictures so many are kept: a spline of third order runs between as many keys.
constexpr std::int64_t kept = 4;

}  // namespace

struct WaterStage::Parts {
  struct Piece {  // of water
    std::string where;
    water::Surface surface;
    water::MirrorOptions mirror;
    std::optional<water::Painting> painting;
    std::optional<water::Waterline> waterline;
    // A picture stands for a block of so many frames: only its first frame is looked at, so that no picture hangs on
    // where a render began.
    std::int64_t block_frames = 1;
    bool keys = false;  // strokes' colours, and so those of the first coat, lie on a spline between blocks
    struct Reference {
      water::ReferencePicture picture;
      std::optional<std::int64_t> block;
    };
    std::array<Reference, kept> references{};  // by block
    water::ReferencePicture ground{};          // between them

    std::int64_t block(std::int64_t frame) const { return frame / block_frames; }
    Reference& of_block(std::int64_t block) { return references[static_cast<std::size_t>(block % kept)]; }
  };

  Parts(const Scene& scene, const CameraModel& c, Drawing& d)
      : camera(c), drawing(d), has_objects(!scene.objects.empty()), plates(plate_most_px) {
    for (const ObjectScene& object : scene.objects) remembers = remembers || object.animation.has_value();
  }

  void add_surface(const WaterScene& water, const WaterSurfaceScene& surface, const KnownPoses& poses,
                   double frames_per_s, std::span<const water::Solid> solids, double share);
  const water::ReferencePicture& reference(Piece& piece, const Frame& frame, const RigidTransform& camera_from_world);
  const water::ReferencePicture& ground(Piece& piece, std::int64_t frame);
  void mirror_objects(const water::Surface& surface, const RigidTransform& camera_from_world);

  double time_s = 0;  // of the frame
  CameraModel camera;
  Drawing& drawing;  // whose renderer may be another one later
  bool has_objects;
  std::vector<std::unique_ptr<Piece>> pieces;
  water::WaterPass* pass = nullptr;  // the renderer's
  SmallPictures plates;
  water::Picture plate, mirrored;
  std::optional<std::int64_t> plate_frame;
  passes::Layer mirror_layer;
  std::vector<water::PaintedSurface> painted;
  std::vector<water::SprayOptions> sprays;
  water::Strokes over, drops;  // over everything
  float ground_opacity = 0;
  std::vector<std::string> notices;
  bool remembers = false;       // what is mirrored may change
  std::int64_t key_frames = 0;  // above 0: strokes take their colours at keys
  bool follows = false;         // their colours follow
};

void WaterStage::Parts::add_surface(const WaterScene& water, const WaterSurfaceScene& surface, const KnownPoses& poses,
                                    double frames_per_s, std::span<const water::Solid> solids, double share) {
  auto piece = std::make_unique<Piece>(
      Piece{surface.where, make_surface(surface, poses, frames_per_s), mirror_options(water), {}, {}});
  if (surface.colour) {
    const auto& c = *surface.colour;
    piece->mirror.water_colour = glm::vec3(c[0], c[1], c[2]);
  }
  const auto arrows = make_arrows(surface, piece->surface, camera, poses, frames_per_s);
  water::PaintingOptions options = painting_options(water, surface, poses.still(), frames_per_s);
  options.brush_places = brush_places(water, piece->surface, camera, poses, frames_per_s);
  options.strokes = std::max(1, static_cast<int>(std::lround(water.strokes * share)));
  using Colours = water::PaintingOptions::Colours;
  piece->keys = options.colours == Colours::Keys && poses.still();
  if (piece->keys) piece->block_frames = options.key_frames;
  if (options.colours == Colours::Followed) piece->block_frames = reference_lasts;
  remembers = remembers || water.mirror_plate || !poses.still();
  if (options.colours == Colours::Keys) key_frames = options.key_frames;
  if (options.colours == Colours::Followed) follows = true;
  std::optional<water::Outlook> outlook;
  if (poses.still()) outlook = {camera, *poses.at(0, frames_per_s)};
  std::vector<water::Segment> bodies;
  for (const water::Solid& solid : solids) {
    const auto cut = water::section(solid, piece->surface);
    bodies.insert(bodies.end(), cut.begin(), cut.end());
  }
  piece->painting.emplace(piece->surface, arrows, bodies, outlook, options);
  if (water.waterline) {
    piece->waterline.emplace(piece->surface, bodies,
                             water::WaterlineOptions{water.waterline_colour, piece->painting->size(), frames_per_s});
  }
  const water::Deviation d = piece->painting->deviation();
  if (d.largest_rad > std::numbers::pi / 4 && d.worst < surface.arrows.size()) {
    notices.push_back(surface.arrows[d.worst].where + ": the water flows " +
                      std::to_string(std::lround(d.largest_rad * 180 / std::numbers::pi)) +
                      " degrees from this arrow, as shores or other arrows are in its way");
  }
  pieces.push_back(std::move(piece));
}

void WaterStage::Parts::mirror_objects(const water::Surface& surface, const RigidTransform& camera_from_world) {
  mirrored.samples.clear();
  if (!has_objects) return;
  const water::MirroredEye eye =
      water::mirrored_eye(surface, water::smaller(camera, mirrored_step_px), camera_from_world);
  // A mirror that is seen from below shows what is below.
  const glm::dvec3 n = surface.normal();
  glm::dvec4 plane(n, -glm::dot(n, surface.to_world({0, 0})));
  if (surface.height_m(inverse(camera_from_world).translation_m) < 0) plane = -plane;
  const passes::PixelRect picture{0, 0, eye.camera.width_px, eye.camera.height_px};
  if (!drawing.renderer->draw_objects({eye.camera, eye.camera_from_world, time_s, plane}, picture, mirror_layer))
    return;
  mirrored.width_px = picture.width_px, mirrored.height_px = picture.height_px, mirrored.channels = 4;
  mirrored.samples.assign(static_cast<std::size_t>(picture.width_px) * picture.height_px * 4, 0);
  const passes::PixelRect& rect = mirror_layer.rect;
  for (int y = 0; y < rect.height_px; ++y) {
    std::memcpy(mirrored.samples.data() + (static_cast<std::size_t>(rect.y_px + y) * picture.width_px + rect.x_px) * 4,
                mirror_layer.rgba.data() + static_cast<std::size_t>(y) * rect.width_px * 4,
                static_cast<std::size_t>(rect.width_px) * 4);
  }
}

const water::ReferencePicture& WaterStage::Parts::reference(Piece& piece, const Frame& frame,
                                                            const RigidTransform& camera_from_world) {
  const std::int64_t block = piece.block(frame.number);
  Piece::Reference& kept_one = piece.of_block(block);
  if (kept_one.block == block) return kept_one.picture;
  kept_one.block = block;
  if (piece.mirror.plate && plate_frame != frame.number) {
    plates.make(frame, plate);
    plate_frame = frame.number;
  }
  mirror_objects(piece.surface, camera_from_world);
  kept_one.picture.paint(piece.surface, camera, camera_from_world, piece.mirror, piece.mirror.plate ? &plate : nullptr,
                         &mirrored, mirrored_step_px, reference_step_px);
  return kept_one.picture;
}

// As strokes' colours do it lies between the pictures of four blocks; those that a frame's keys were taken from.
const water::ReferencePicture& WaterStage::Parts::ground(Piece& piece, std::int64_t frame) {
  const std::int64_t last = piece.block(frame);
  const water::ReferencePicture& newest = piece.of_block(last).picture;
  if (!piece.keys || !(ground_opacity > 0)) return newest;
  std::array<const water::ReferencePicture*, kept> pictures;
  for (std::int64_t k = 0; k < kept; ++k) {
    const std::int64_t block = std::max<std::int64_t>(0, last - (kept - 1) + k);
    const Piece::Reference& one = piece.of_block(block);
    // A camera may have left the block's frames out.
    pictures[static_cast<std::size_t>(k)] = one.block == block ? &one.picture : &newest;
  }
  const std::int64_t since = frame - last * piece.block_frames;
  piece.ground.mix(pictures,
                   water::spline_weights(static_cast<double>(since) / static_cast<double>(piece.block_frames)));
  return piece.ground;
}

WaterStage::WaterStage(const Scene& scene, const CameraModel& camera, double frames_per_s, Drawing& drawing)
    : parts_(std::make_unique<Parts>(scene, camera, drawing)) {
  const WaterScene& water = *scene.water;
  const KnownPoses poses(scene);
  parts_->ground_opacity = static_cast<float>(water.ground);
  // Strokes are shared out by how much of the picture each surface takes, or how large it is.
  std::vector<double> sizes;
  double sum = 0;
  for (const WaterSurfaceScene& s : water.surfaces) {
    const water::Surface surface = make_surface(s, poses, frames_per_s);
    std::optional<water::Outlook> outlook;
    if (poses.still()) outlook = {camera, *poses.at(0, frames_per_s)};
    sizes.push_back(water::seen_size(surface, outlook));
    if (outlook && sizes.back() < 1) {  // of a pixel
      parts_->notices.push_back(s.where + ": nothing of this water is seen from where the camera stands");
    }
    sum += sizes.back();
  }
  for (std::size_t i = 0; i < water.surfaces.size(); ++i) {
    parts_->add_surface(water, water.surfaces[i], poses, frames_per_s, drawing.solids, sum > 0 ? sizes[i] / sum : 1);
  }
  for (const WaterSprayScene& s : water.sprays) {
    parts_->sprays.push_back({s.from_m, s.to_m, s.drops, s.height_m, s.size_m, s.colour, frames_per_s});
  }
  auto pass = std::make_unique<water::WaterPass>(water::line_brushes(), water::drop_brushes(), read_brushes(water));
  parts_->pass = pass.get();
  drawing.renderer->add(std::move(pass));
}

WaterStage::~WaterStage() = default;
WaterStage::WaterStage(WaterStage&&) noexcept = default;

void WaterStage::look(const Frame& frame, const RigidTransform& camera_from_world, double time_s) {
  parts_->time_s = time_s;
  parts_->painted.clear(), parts_->over.clear(), parts_->drops.clear();
  for (auto& piece : parts_->pieces) {
    const auto make = [&]() -> const water::ReferencePicture& {
      return parts_->reference(*piece, frame, camera_from_world);
    };
    const water::Strokes& strokes = piece->painting->paint(frame.number, parts_->camera, camera_from_world, make);
    parts_->painted.push_back(
        {&piece->surface, strokes, &parts_->ground(*piece, frame.number), parts_->ground_opacity});
    if (piece->waterline) piece->waterline->add(frame.number, parts_->camera, camera_from_world, parts_->over);
  }
  for (const water::SprayOptions& spray : parts_->sprays) {
    water::add_spray(spray, frame.number, parts_->camera, camera_from_world, parts_->drops);
  }
  parts_->pass->show(parts_->painted, parts_->over, parts_->drops);
}

std::int64_t WaterStage::first_remembered(std::int64_t frame) const {
  if (!parts_->remembers) return frame;
  std::int64_t first = frame;
  if (parts_->key_frames > 0) first = (frame / parts_->key_frames - (kept - 1)) * parts_->key_frames;
  if (parts_->follows) first = frame / reference_lasts * reference_lasts - (water::memory_frames + reference_lasts);
  return std::max<std::int64_t>(0, first);
}

const std::vector<std::string>& WaterStage::notices() const { return parts_->notices; }

}  // namespace rinkaku::pipeline

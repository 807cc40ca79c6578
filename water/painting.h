#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "mesh/depth_order.h"
#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"
#include "water/brushes.h"
#include "water/colours.h"
#include "water/flow.h"
#include "water/moments.h"
#include "water/particles.h"
#include "water/plots.h"
#include "water/reference_picture.h"
#include "water/stroke_size.h"
#include "water/strokes.h"
#include "water/surface.h"

namespace rinkaku::water {

struct PaintingOptions {
  int strokes = 7000;
  StrokeSize size;  ///< a length of 0 is chosen so that strokes lie `layers` deep
  double layers = 6.5;
  double foreshortening = 0.5;  ///< 0: length as equation 4 has it; 1: shorter where the stroke leads away from the eye
  double seconds_per_frame = 1.0 / 25;
  double opacity = 0.9;   ///< of a stroke
  double ripple = 0.4;    ///< how far from its place a stroke looks for its colour, in its own lengths
  double variety = 0.05;  ///< by how much a stroke may be lighter or darker than its colour
  enum class Colours {
    Keys,      ///< at key frames ahead and behind, with a B-spline between: for a camera that stands still
    Followed,  ///< from what was seen up to now
    Sampled    ///< of this frame alone: they flicker; to compare with
  } colours = Colours::Keys;
  int key_frames = 15;
  bool mean = true;  ///< of the neighbourhood (equation 2); else of the stroke's middle alone
  FlowOptions flow;
  std::vector<glm::dvec2> brush_places;  ///< of the user's own brushes, on the surface; none: brushes of lines
};

/// How the picture that a frame's strokes take their colours from comes about; called only when it is needed.
using MakeReference = std::function<const ReferencePicture&()>;

/// A surface painted with strokes that flow: particles, their sizes, directions, colours and order.
/// (Suzuki et al. 2004; after Meier 1996.) GL-free; one thread.
class Painting {
 public:
  /// `surface` must outlive it. `bodies`: what stands in it. `outlook`: where a camera stands that doesn't move;
  /// without one strokes are spread evenly over the surface.
  Painting(const Surface& surface, std::vector<ArrowKey> arrows, std::vector<Segment> bodies,
           const std::optional<Outlook>& outlook, const PaintingOptions& options);

  /// The strokes of a frame, farthest first. Frames may be left out: the water flows on through them. Going back starts
  /// anew from frame 0. No allocation once warm. Cost: some 2.5 ms for 7,000 strokes; memory with colours at keys: some
  /// 60 bytes a stroke for each of the frames from key to key.
  const Strokes& paint(std::int64_t frame, const CameraModel& camera, const RigidTransform& camera_from_world,
                       const MakeReference& reference);

  /// As far as they are known: with colours at keys two keys ahead of the strokes.
  const Particles& particles() const { return course_->particles; }
  const StrokeSize& size() const { return options_.size; }
  Deviation deviation() { return course_->flow.deviation(); }
  const Surface& surface() const { return surface_; }

 private:
  struct Course {
    Course(const Painting& painting);
    Flow flow;
    Particles particles;
  };
  struct Seen {  // the surface from this frame's camera
    glm::dvec3 origin, along_x, along_y;
    const CameraModel* camera;
    glm::dvec3 at(glm::vec2 p) const { return origin + along_x * double(p.x) + along_y * double(p.y); }
  };
  void restart();
  void go_to(std::int64_t frame, const MakeReference& reference);
  void advance();
  void keep_moment();
  void advance_colours(const ReferencePicture& reference);
  glm::dvec2 screen_velocity(const Drifter& d) const;  // pixels a second
  glm::vec3 wave_colour(const Drifter& d, const ReferencePicture& reference) const;
  bool place(const Drifter& d, Stroke& stroke) const;
  void add_stroke(const Drifter& d);
  std::uint8_t brush_of(const Particle& p) const;

  const Surface& surface_;
  std::vector<ArrowKey> arrows_;
  std::vector<Segment> bodies_;
  PaintingOptions options_;
  std::optional<Plots> plots_;
  std::optional<Course> course_;  // at the last frame that is known
  std::optional<Moments> moments_;
  std::int64_t frame_ = 0;  // whose strokes were asked for last
  std::optional<KeyColours> keys_;
  std::optional<FollowedColours> followed_;
  std::vector<std::uint32_t> serial_;  // whose colour is kept at a place
  Seen seen_{};
  mesh::DepthOrder order_;
  Strokes unordered_, strokes_;
  std::vector<float> depths_m_;
};

}  // namespace rinkaku::water

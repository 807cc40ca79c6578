#include "pipeline/plan.h"

#include <algorithm>
#include <set>

#include "pipeline/objects/region_use.h"

namespace rinkaku::pipeline {
namespace {

struct Facts {
  const Scene& scene;
  const CameraModel* camera;
  const Request& request;

  bool draws() const { return !scene.objects.empty(); }
  bool anything() const { return draws() || scene.water; }
  bool composites() const { return scene.output.content == OutputScene::Content::Composite; }
  bool replaces_plate() const { return composites() && scene.background.has_value(); }
  bool lines_around_things() const {
    return std::any_of(scene.foregrounds.begin(), scene.foregrounds.end(),
                       [](const ForegroundScene& each) { return each.options.line.has_value(); });
  }
  template <typename Wanted>
  std::size_t count(Wanted wanted) const {
    return static_cast<std::size_t>(std::count_if(scene.objects.begin(), scene.objects.end(), wanted));
  }
};

struct Verdict {
  bool runs;
  std::string why;
};

constexpr const char* no_object = "the scene has no [[object]]";

std::string objects(std::size_t n) { return std::to_string(n) + (n == 1 ? " object" : " objects"); }

Verdict decode(const Facts& f) { return {true, "frames come from " + f.scene.plate.input}; }

Verdict track(const Facts& f) {
  if (!f.scene.track) return {false, "the scene has no [track]"};
  struct Why {
    std::string operator()(const MarkerTrack& m) const {
      return "the camera's pose is found by marker " + std::to_string(m.id) + " of " + m.dictionary;
    }
    std::string operator()(const BoardTrack& b) const {
      return "the camera's pose is found by the board " + b.board.filename().string();
    }
    std::string operator()(const PoseFileTrack& p) const {
      return "the camera's poses are read from " + p.poses.filename().string();
    }
    std::string operator()(const LockedTrack&) const { return "the camera stays where the scene puts it"; }
  };
  return {true, std::visit(Why{}, f.scene.track->from)};
}

Verdict smooth(const Facts& f) {
  if (f.scene.track && std::holds_alternative<LockedTrack>(f.scene.track->from)) {
    return {false, "the camera stays where it is"};
  }
  if (!f.scene.track || !f.scene.track->smoothing.on) return {false, "smoothing is off"};
  return {true, "the measured poses are smoothed"};
}

Verdict import(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  return {true, "each object's mesh is read before the first frame"};
}

std::string names_of(const Facts& f, bool (*wanted)(const ObjectScene&)) {
  std::string names;
  for (const ObjectScene& object : f.scene.objects) {
    if (wanted(object)) names += (names.empty() ? "" : ", ") + object.name;
  }
  return names;
}

template <Skinning Where>
bool posed(const ObjectScene& o) {
  return o.animation && o.animation->skinning == Where;
}

Verdict animate(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  const std::size_t n = f.count([](const ObjectScene& o) { return o.animation.has_value(); });
  if (n == 0) return {false, "no object is animated"};
  const auto made = [&](const char* where, bool (*wanted)(const ObjectScene&)) {
    const std::string names = names_of(f, wanted);
    return names.empty() ? "" : "; " + names + ": vertices are made " + where;
  };
  return {true, objects(n) + " played in time with the video, contours found on the CPU" +
                    made("on the GPU, or on the CPU where OpenGL itself runs there and would be slower",
                         posed<Skinning::Auto>) +
                    made("by a compute shader, as the scene says", posed<Skinning::Gpu>) +
                    made("on the CPU, as the scene says", posed<Skinning::Cpu>)};
}

Verdict toon(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  const std::size_t n = f.count([](const ObjectScene& o) { return o.toon.has_value(); });
  if (n == 0) return {false, "no object is toon-shaded"};
  return {true, objects(n) + " toon-shaded"};
}

Verdict flat(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  const std::size_t n = f.count([](const ObjectScene& o) { return !o.toon.has_value() && !o.holdout; });
  if (n == 0) return {false, "no object has toon = false"};
  return {true, objects(n) + " drawn flat (toon = false)"};
}

Verdict shading_scale(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  const std::string coarse = names_of(f, has_coarse_colour);
  const std::string plain =
      names_of(f, [](const ObjectScene& o) { return o.shading_scale > 1 && !has_coarse_colour(o); });
  const std::string no_gain = plain.empty() ? "" : "nothing is gained for " + plain + ", of one colour";
  if (coarse.empty()) return {false, plain.empty() ? "no object has a shading_scale above 1" : no_gain};
  return {true, coarse +
                    ": coloured at a lower resolution; edges, lines and fluff are not. Saves work only where "
                    "colouring a pixel costs more than ten lookups" +
                    (plain.empty() ? "" : "; " + no_gain)};
}

Verdict regions(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  const std::size_t faces = f.count([](const ObjectScene& o) { return region_use(o) == RegionUse::Faces; });
  const std::size_t cover = f.count([](const ObjectScene& o) { return region_use(o) == RegionUse::Cover; });
  if (faces + cover == 0) return {false, "no object has regions"};
  std::string why;
  if (cover > 0)
    why = objects(cover) +
          " from few triangles, as nothing inside the shape shows: the matte product, or "
          "depth where CG may cut in";
  if (faces > 0) {
    why += (cover > 0 ? "; " : "") + objects(faces) +
           " without the back mesh, as shading or lines show: the colour product";
  }
  return {true, why};
}

Verdict holdout(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  const std::size_t n = f.count([](const ObjectScene& o) { return o.holdout; });
  if (n == 0) return {false, "no object is a holdout"};
  return {true, n == 1 ? "1 model of a filmed thing hides CG" : std::to_string(n) + " models of filmed things hide CG"};
}

Verdict outline(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  const std::size_t n = f.count([](const ObjectScene& o) { return o.outline.has_value(); });
  if (n == 0) return {false, "no object has an outline"};
  return {true, objects(n) + " outlined"};
}

Verdict curvature(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  const std::size_t n =
      f.count([](const ObjectScene& o) { return o.outline && o.outline->method == OutlineScene::Method::Curvature; });
  if (n == 0) return {false, "no line's width follows curvature"};
  return {true, "the line's width follows the curvature of " + objects(n)};
}

Verdict water(const Facts& f) {
  if (!f.scene.water) return {false, "the scene has no [water]"};
  const std::size_t n = f.scene.water->surfaces.size();
  return {true, (n == 1 ? "1 surface" : std::to_string(n) + " surfaces") + " painted with strokes"};
}

Verdict matte(const Facts& f) {
  if (f.scene.foregrounds.empty()) return {false, "the scene has no [[foreground]]"};
  std::string names;
  for (const ForegroundScene& each : f.scene.foregrounds) names += (names.empty() ? "" : ", ") + each.name;
  return {true, "mattes are found of " + names};
}

Verdict background(const Facts& f) {
  if (!f.scene.background) return {false, "the scene has no [background]"};
  if (!f.composites()) return {false, "the output is the CG alone"};
  return {true, f.scene.background->colour ? "a colour stands in the plate's place"
                                           : "the plate's place is taken by " + f.scene.background->input};
}

Verdict merge(const Facts& f) {
  if (f.scene.foregrounds.empty()) return {false, "the scene has no [[foreground]]"};
  if (!f.anything() && !f.replaces_plate() && !f.lines_around_things()) return {false, no_object};
  return {true, f.anything()         ? "CG goes before and behind what was filmed, by depth"
                : f.replaces_plate() ? "what was filmed goes before the background"
                                     : "lines are drawn around what was filmed"};
}

Verdict control_points(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  const std::size_t n =
      f.count([](const ObjectScene& o) { return o.outline && o.outline->method == OutlineScene::Method::Control; });
  if (n == 0) return {false, "no line's width follows control points"};
  return {true, "the line's width follows feature and control points of " + objects(n)};
}

Verdict fluffy(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  const std::size_t n = f.count([](const ObjectScene& o) { return o.fluffy.has_value(); });
  if (n == 0) return {false, "no object is fluffy"};
  return {true, objects(n) + " with fluff about the contour"};
}

Verdict line_targets(const Facts& f) {
  if (!f.draws()) return {false, no_object};
  const std::size_t n = f.count([](const ObjectScene& o) {
    return o.outline &&
           (needs_own_targets(o.outline->method) || o.outline->style.inner || !o.outline->style.drawn.empty());
  });
  if (n == 0) return {false, "no line is found in pictures of its object"};
  return {true, "lines of " + objects(n) + " need pictures of the object, in targets of their own"};
}

Verdict draw(const Facts& f) {
  if (!f.anything()) return {false, std::string(no_object) + ": no OpenGL context is made"};
  if (!f.draws()) return {true, "water to draw"};
  return {true, objects(f.scene.objects.size()) + (f.scene.water ? " and water to draw" : " to draw")};
}

Verdict lens(const Facts& f) {
  if (!f.anything()) return {false, no_object};
  if (f.camera == nullptr || !f.camera->has_distortion()) return {false, "the camera has no lens distortion"};
  return {true, "the camera's lens distortion is put on the CG"};
}

Verdict composite(const Facts& f) {
  if (!f.composites()) return {false, "the output is the CG alone"};
  if (f.replaces_plate()) return {true, "background and CG are laid over the plate's own planes"};
  if (f.lines_around_things() && !f.anything()) return {true, "lines are laid over the plate's own planes"};
  if (!f.anything()) return {false, "nothing is drawn: the plate goes to the sink untouched"};
  return {true, "CG is laid over the plate's own planes"};
}

Verdict unmultiply(const Facts& f) {
  if (f.composites()) return {false, "the output is the composite"};
  return {true, "the output is the CG alone, with straight alpha"};
}

Verdict layers(const Facts& f) {
  if (!f.request.layers) return {false, "no --layers was given"};
  return {true, "each layer of each frame is written as PNG"};
}

Verdict copy_streams(const Facts& f) {
  if (!f.request.no_streams_because.empty()) return {false, f.request.no_streams_because};
  return {true, "sound and other streams are copied from the input"};
}

Verdict show(const Facts& f) {
  if (!f.request.watched) return {false, "frames are shown by play and live only"};
  return {true, "frames are shown in a window"};
}

Verdict virtual_camera(const Facts& f) {
  if (!f.request.virtual_camera) return {false, "no --virtual-camera was given"};
  return {true, "other programs read the frames from a virtual camera"};
}

Verdict encode(const Facts& f) {
  if (f.request.watched && f.scene.output.path.empty()) return {false, "nothing is recorded"};
  return {true, "frames go to the output"};
}

// The table of stages, in the order a frame meets them. A new pass adds its line here.
struct Kind {
  const char* name;
  Verdict (*verdict)(const Facts&);
  std::vector<const char*> inputs;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"decode", decode, {}},
      {"track", track, {"decode"}},
      {"smooth", smooth, {"track"}},
      {"matte", matte, {"decode", "track"}},
      {"import", import, {}},
      {"animate", animate, {"decode", "import"}},
      {"toon", toon, {"import"}},
      {"flat", flat, {"import"}},
      {"shading-scale", shading_scale, {"toon", "flat"}},
      {"holdout", holdout, {"import"}},
      {"regions", regions, {"import"}},
      {"curvature", curvature, {"import", "animate"}},
      {"line-targets", line_targets, {"import"}},
      {"control-points", control_points, {"import", "animate"}},
      {"outline", outline, {"import", "curvature", "control-points", "line-targets"}},
      {"fluffy", fluffy, {"import"}},
      {"water", water, {"decode", "track", "smooth"}},
      {"draw",
       draw,
       {"decode", "track", "smooth", "matte", "animate", "toon", "flat", "shading-scale", "holdout", "regions",
        "outline", "fluffy", "water"}},
      {"lens", lens, {"draw"}},
      {"background", background, {}},
      {"merge", merge, {"matte", "draw", "lens", "background"}},
      {"composite", composite, {"decode", "draw", "lens", "merge"}},
      {"unmultiply", unmultiply, {"draw", "lens", "merge"}},
      {"layers", layers, {"draw", "lens", "matte", "merge"}},
      {"copy-streams", copy_streams, {}},
      {"show", show, {"decode", "composite", "unmultiply"}},
      {"virtual-camera", virtual_camera, {"decode", "composite", "unmultiply"}},
      {"encode", encode, {"decode", "composite", "unmultiply", "copy-streams"}},
  };
  return all;
}

}  // namespace

bool Plan::runs(std::string_view name) const {
  return std::any_of(stages.begin(), stages.end(), [name](const Stage& s) { return s.name == name && s.runs; });
}

Plan make_plan(const Scene& scene, const CameraModel* camera, const Request& request) {
  const Facts facts{scene, camera, request};
  std::set<std::string_view> asked_for = {"encode", "layers", "show", "virtual-camera"};  // the sinks
  Plan plan;
  for (auto kind = kinds().rbegin(); kind != kinds().rend(); ++kind) {
    Stage stage;
    stage.name = kind->name;
    const Verdict verdict = kind->verdict(facts);
    const bool asked = asked_for.contains(stage.name);
    stage.runs = asked && verdict.runs;
    stage.why = asked || !verdict.runs ? verdict.why : "nothing that runs reads it";
    for (const char* input : kind->inputs) {
      stage.inputs.emplace_back(input);
      if (stage.runs) asked_for.insert(input);
    }
    plan.stages.push_back(std::move(stage));
  }
  std::reverse(plan.stages.begin(), plan.stages.end());
  return plan;
}

std::string to_dot(const Plan& plan) {
  std::string text = "digraph plan {\n  rankdir=LR;\n  node [shape=box, fontname=\"sans-serif\"];\n";
  for (const Stage& stage : plan.stages) {
    std::string why;
    for (char c : stage.why) {
      if (c == '"' || c == '\\') why += '\\';
      why += c;
    }
    text += "  \"" + stage.name + "\" [tooltip=\"" + why + "\"" +
            (stage.runs ? "" : ", style=dashed, color=grey, fontcolor=grey") + "];\n";
  }
  for (const Stage& stage : plan.stages) {
    for (const std::string& input : stage.inputs) {
      const bool flows = stage.runs && plan.runs(input);
      text += "  \"" + input + "\" -> \"" + stage.name + "\"" + (flows ? "" : " [style=dashed, color=grey]") + ";\n";
    }
  }
  return text + "}\n";
}

}  // namespace rinkaku::pipeline

#include "pipeline/plan.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include <gtest/gtest.h>

#include "pipeline/objects/region_use.h"
#include "tests/support/test_data.h"

namespace rinkaku::pipeline {
namespace {

using Names = std::set<std::string>;

Scene empty_scene() {
  Scene scene;
  scene.plate.input = "/videos/desk.mp4";
  return scene;
}

ObjectScene toon_object() {
  ObjectScene object;
  object.toon.emplace();
  return object;
}

Scene drawn_scene() {
  Scene scene = empty_scene();
  scene.track.emplace();
  scene.track->from = MarkerTrack{"4X4_50", 7, 0.1};
  scene.track->smoothing.on = true;
  scene.objects.push_back(toon_object());
  return scene;
}

CameraModel pinhole() { return {640, 480, 500, 500, 320, 240, {}}; }
CameraModel bent() { return {640, 480, 500, 500, 320, 240, {-0.2, 0.05}}; }

Plan plan_of(const Scene& scene, const CameraModel& camera = pinhole(), const Request& request = {}) {
  return make_plan(scene, &camera, request);
}

Names running(const Plan& plan) {
  Names names;
  for (const Stage& stage : plan.stages) {
    if (stage.runs) names.insert(stage.name);
  }
  return names;
}

const Stage& stage(const Plan& plan, const std::string& name) {
  const auto found =
      std::find_if(plan.stages.begin(), plan.stages.end(), [&name](const Stage& s) { return s.name == name; });
  if (found == plan.stages.end()) throw std::runtime_error("the plan has no stage " + name);
  return *found;
}

TEST(Plan, EmptySceneOnlyPassesThePlateOn) {
  const Plan plan = make_plan(empty_scene(), nullptr, {});
  EXPECT_EQ(running(plan), (Names{"decode", "copy-streams", "encode"}));
}

TEST(Plan, OnlyAnimatedObjectsArePosed) {
  Scene scene = drawn_scene();
  const auto why = [&scene] { return stage(plan_of(scene), "animate").why; };
  EXPECT_EQ(why(), "no object is animated");
  EXPECT_FALSE(plan_of(scene).runs("animate"));
  scene.objects.back().animation.emplace();
  EXPECT_TRUE(plan_of(scene).runs("animate"));
  scene.objects.back().name = "fox";
  EXPECT_EQ(why(),
            "1 object played in time with the video, contours found on the CPU; fox: vertices are made on the GPU, "
            "or on the CPU where OpenGL itself runs there and would be slower");
  scene.objects.back().animation->skinning = Skinning::Gpu;
  EXPECT_TRUE(why().ends_with("fox: vertices are made by a compute shader, as the scene says")) << why();
  scene.objects.back().animation->skinning = Skinning::Cpu;
  EXPECT_TRUE(why().ends_with("fox: vertices are made on the CPU, as the scene says")) << why();
}

TEST(Plan, TrackWithoutObjectsIsReadByNothing) {
  Scene scene = drawn_scene();
  scene.objects.clear();
  const Plan plan = plan_of(scene, bent());
  EXPECT_EQ(running(plan), (Names{"decode", "copy-streams", "encode"}));
  EXPECT_EQ(stage(plan, "track").why, "nothing that runs reads it");
}

TEST(Plan, ToonObjectIsTrackedDrawnAndComposited) {
  EXPECT_EQ(running(plan_of(drawn_scene())),
            (Names{"decode", "track", "smooth", "import", "toon", "draw", "composite", "copy-streams", "encode"}));
}

TEST(Plan, FluffIsDrawnOnlyIfAnObjectHasIt) {
  Scene scene = drawn_scene();
  EXPECT_FALSE(plan_of(scene).runs("fluffy"));
  EXPECT_EQ(stage(plan_of(scene), "fluffy").why, "no object is fluffy");
  scene.objects[0].fluffy.emplace();
  EXPECT_TRUE(plan_of(scene).runs("fluffy"));
}

TEST(Plan, FluffyObjectKeepsItsOwnSurfaceAsFluffMeetsItsDepth) {
  Scene scene = drawn_scene();
  scene.objects[0].regions.emplace();
  scene.objects[0].colour = {1, 1, 1};
  scene.objects[0].toon.reset();
  EXPECT_EQ(region_use(scene.objects[0]), RegionUse::Cover);
  scene.objects[0].fluffy.emplace();
  EXPECT_EQ(region_use(scene.objects[0]), RegionUse::Faces);
}

TEST(Plan, EachLookRunsOnlyIfAnObjectHasIt) {
  Scene scene = drawn_scene();
  EXPECT_FALSE(plan_of(scene).runs("flat"));
  EXPECT_FALSE(plan_of(scene).runs("outline"));
  scene.objects.emplace_back();
  scene.objects.back().outline.emplace();
  const Plan both = plan_of(scene);
  EXPECT_EQ(stage(both, "toon").why, "1 object toon-shaded");
  EXPECT_EQ(stage(both, "flat").why, "1 object drawn flat (toon = false)");
  EXPECT_EQ(stage(both, "outline").why, "1 object outlined");
  EXPECT_EQ(stage(both, "draw").why, "2 objects to draw");
  scene.objects.erase(scene.objects.begin());
  EXPECT_FALSE(plan_of(scene).runs("toon"));
  EXPECT_TRUE(plan_of(scene).runs("outline"));
}

TEST(Plan, CurvatureIsComputedOnlyForLinesThatFollowIt) {
  Scene scene = drawn_scene();
  scene.objects.back().outline.emplace();
  EXPECT_EQ(stage(plan_of(scene), "curvature").why, "no line's width follows curvature");
  EXPECT_FALSE(plan_of(scene).runs("curvature"));
  scene.objects.back().outline->method = OutlineScene::Method::Curvature;
  EXPECT_EQ(stage(plan_of(scene), "curvature").why, "the line's width follows the curvature of 1 object");
  EXPECT_TRUE(plan_of(scene).runs("curvature"));
}

TEST(Plan, TargetsForLinesAreMadeOnlyForStylesThatNeedThem) {
  Scene scene = drawn_scene();
  EXPECT_FALSE(plan_of(scene).runs("line-targets"));
  OutlineScene& line = scene.objects[0].outline.emplace();
  for (const NamedMethod& named : line_methods()) {
    line.method = named.method;
    EXPECT_EQ(plan_of(scene).runs("line-targets"), needs_own_targets(named.method)) << named.word;
  }
  line.method = OutlineScene::Method::Uniform;
  line.style.inner.emplace();
  EXPECT_TRUE(plan_of(scene).runs("line-targets"));
}

TEST(Plan, HoldoutsAreCutOutAndNotShaded) {
  Scene scene = drawn_scene();
  EXPECT_FALSE(plan_of(scene).runs("holdout"));
  scene.objects.emplace_back();
  scene.objects.back().holdout = true;
  const Plan plan = plan_of(scene);
  EXPECT_EQ(stage(plan, "holdout").why, "1 model of a filmed thing hides CG");
  EXPECT_EQ(stage(plan, "toon").why, "1 object toon-shaded");
  EXPECT_FALSE(plan.runs("flat"));
}

TEST(Plan, RegionsProductFollowsFromWhatShowsOfAnObject) {
  Scene scene = drawn_scene();
  EXPECT_EQ(stage(plan_of(scene), "regions").why, "no object has regions");
  EXPECT_EQ(region_use(scene.objects[0]), RegionUse::None);
  scene.objects[0].regions.emplace();
  EXPECT_EQ(region_use(scene.objects[0]), RegionUse::Faces) << "shaded";
  EXPECT_EQ(stage(plan_of(scene), "regions").why,
            "1 object without the back mesh, as shading or lines show: the colour product");
  scene.objects.emplace_back();
  scene.objects[1].holdout = true;
  scene.objects[1].regions.emplace();
  EXPECT_EQ(region_use(scene.objects[1]), RegionUse::Cover);
  EXPECT_TRUE(plan_of(scene).runs("regions"));
  ObjectScene flat;
  flat.regions.emplace();
  EXPECT_EQ(region_use(flat), RegionUse::Faces) << "its materials may have many colours";
  flat.colour = {1, 0, 0};
  EXPECT_EQ(region_use(flat), RegionUse::Cover);
  flat.outline.emplace();
  EXPECT_EQ(region_use(flat), RegionUse::Faces) << "lines run inside its shape";
  flat.outline.reset();
  flat.fluffy.emplace();
  EXPECT_EQ(region_use(flat), RegionUse::Faces) << "as fluff does";
}

TEST(Plan, ColoursAreDrawnAtALowerResolutionWhereThatIsAskedForAndThereAreSeveral) {
  Scene scene = drawn_scene();
  EXPECT_EQ(stage(plan_of(scene), "shading-scale").why, "no object has a shading_scale above 1");
  EXPECT_FALSE(plan_of(scene).runs("shading-scale"));
  scene.objects[0].name = "cow";
  scene.objects[0].shading_scale = 2;
  EXPECT_TRUE(plan_of(scene).runs("shading-scale"));
  EXPECT_EQ(stage(plan_of(scene), "shading-scale").why,
            "cow: coloured at a lower resolution; edges, lines and fluff are not. Saves work only where colouring a "
            "pixel costs more than ten lookups");
  ObjectScene flat;
  flat.name = "sign";
  flat.shading_scale = 3;
  EXPECT_TRUE(has_coarse_colour(flat)) << "its materials may have many colours";
  flat.colour = {1, 0, 0};
  scene.objects = {flat};
  EXPECT_FALSE(plan_of(scene).runs("shading-scale"));
  EXPECT_EQ(stage(plan_of(scene), "shading-scale").why, "nothing is gained for sign, of one colour");
  EXPECT_TRUE(plan_of(scene).runs("flat")) << "drawn all the same";
}

TEST(Plan, LensRunsOnlyForADistortedCameraThatSeesCg) {
  EXPECT_FALSE(plan_of(drawn_scene(), pinhole()).runs("lens"));
  EXPECT_TRUE(plan_of(drawn_scene(), bent()).runs("lens"));
  EXPECT_FALSE(plan_of(empty_scene(), bent()).runs("lens"));
  Scene cg_of_nothing = empty_scene();
  cg_of_nothing.output.content = OutputScene::Content::Cg;
  Request layers;
  layers.layers = true;
  EXPECT_FALSE(plan_of(cg_of_nothing, bent(), layers).runs("lens"));
}

TEST(Plan, CgAloneIsUnmultipliedAndNotComposited) {
  Scene scene = drawn_scene();
  scene.output.content = OutputScene::Content::Cg;
  const Plan plan = plan_of(scene);
  EXPECT_TRUE(plan.runs("unmultiply"));
  EXPECT_TRUE(plan.runs("draw"));
  EXPECT_FALSE(plan.runs("composite"));
  EXPECT_FALSE(plan_of(drawn_scene()).runs("unmultiply"));
}

TEST(Plan, LayersRunOnRequest) {
  Request request;
  EXPECT_FALSE(plan_of(drawn_scene(), pinhole(), request).runs("layers"));
  request.layers = true;
  EXPECT_TRUE(plan_of(drawn_scene(), pinhole(), request).runs("layers"));
}

TEST(Plan, LockedCameraIsNotSmoothed) {
  Scene scene = drawn_scene();
  scene.track->from = LockedTrack{};
  const Plan plan = plan_of(scene);
  EXPECT_TRUE(plan.runs("track"));
  EXPECT_FALSE(plan.runs("smooth"));
  EXPECT_EQ(stage(plan, "smooth").why, "the camera stays where it is");
}

TEST(Plan, SmoothingRunsOnlyWhereItIsOn) {
  Scene scene = drawn_scene();
  scene.track->from = PoseFileTrack{"poses.csv"};
  EXPECT_TRUE(plan_of(scene).runs("smooth"));
  scene.track->smoothing.on = false;
  EXPECT_FALSE(plan_of(scene).runs("smooth"));
}

TEST(Plan, StreamsThatCantBeCopiedAreSaidWithTheReason) {
  Request request;
  request.no_streams_because = "standard output takes the pictures only";
  const Plan plan = plan_of(drawn_scene(), pinhole(), request);
  EXPECT_FALSE(plan.runs("copy-streams"));
  EXPECT_EQ(stage(plan, "copy-streams").why, request.no_streams_because);
}

TEST(Plan, WaterRunsOnlyIfTheSceneHasIt) {
  Scene scene = drawn_scene();
  EXPECT_FALSE(plan_of(scene).runs("water"));
  scene.water = WaterScene{};
  EXPECT_TRUE(plan_of(scene).runs("water"));
  scene.objects.clear();  // water alone is tracked, drawn and composited
  for (const char* stage : {"track", "water", "draw", "composite"}) EXPECT_TRUE(plan_of(scene).runs(stage)) << stage;
  EXPECT_FALSE(plan_of(scene).runs("toon"));
}

TEST(Plan, NoSuchStageDoesNotRun) { EXPECT_FALSE(plan_of(drawn_scene()).runs("teleport")); }

// Every combination of what a scene can have.
std::vector<Plan> many_plans() {
  std::vector<Plan> plans;
  for (int bits = 0; bits < 64; ++bits) {
    Scene scene = bits & 1 ? drawn_scene() : empty_scene();
    if (bits & 2) scene.output.content = OutputScene::Content::Cg;
    if (bits & 4 && bits & 1) scene.objects.front().toon.reset();
    if (bits & 8 && bits & 1) scene.track->from = LockedTrack{};
    Request request;
    request.layers = bits & 16;
    plans.push_back(plan_of(scene, bits & 32 ? bent() : pinhole(), request));
  }
  return plans;
}

TEST(Plan, EveryStageSaysWhy) {
  for (const Plan& plan : many_plans()) {
    for (const Stage& s : plan.stages) EXPECT_FALSE(s.why.empty()) << s.name;
  }
}

TEST(Plan, WhatRunsIsReadByWhatRuns) {
  const Names sinks{"encode", "layers"};
  for (const Plan& plan : many_plans()) {
    Names read = sinks;
    for (const Stage& s : plan.stages) {
      if (s.runs) read.insert(s.inputs.begin(), s.inputs.end());
    }
    for (const std::string& name : running(plan)) EXPECT_TRUE(read.contains(name)) << name;
  }
}

TEST(Plan, StagesComeAfterWhatTheyRead) {
  Names before;
  for (const Stage& s : plan_of(drawn_scene()).stages) {
    for (const std::string& input : s.inputs) EXPECT_TRUE(before.contains(input)) << input << " -> " << s.name;
    EXPECT_TRUE(before.insert(s.name).second) << s.name << " twice";
  }
}

// How often a mark stands outside quotes.
long outside_quotes(const std::string& text, char mark) {
  bool quoted = false;
  long count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quoted && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      quoted = !quoted;
    } else if (!quoted && text[i] == mark) {
      ++count;
    }
  }
  EXPECT_FALSE(quoted) << "a quote is not closed";
  return count;
}

Scene with_awkward_name() {
  Scene scene = drawn_scene();
  scene.plate.input = "/videos/\"my\" } desk\\.mp4";
  return scene;
}

TEST(PlanDot, IsWellFormedWhateverTheNames) {
  const std::string dot = to_dot(plan_of(with_awkward_name()));
  EXPECT_EQ(dot.rfind("digraph plan {", 0), 0u);
  EXPECT_EQ(outside_quotes(dot, '{'), 1);
  EXPECT_EQ(outside_quotes(dot, '}'), 1);
  EXPECT_EQ(outside_quotes(dot, '['), outside_quotes(dot, ']'));
}

TEST(PlanDot, DashesWhatDoesNotRun) {
  const std::string dot = to_dot(plan_of(drawn_scene()));
  const auto line = [&dot](const std::string& begins) {
    const std::size_t at = dot.find("  \"" + begins);
    return at == std::string::npos ? std::string() : dot.substr(at, dot.find('\n', at) - at);
  };
  EXPECT_EQ(line("composite\" [").find("dashed"), std::string::npos);
  EXPECT_NE(line("composite\" ["), "");
  EXPECT_NE(line("lens\" [").find("dashed"), std::string::npos);
  EXPECT_EQ(line("draw\" -> \"composite").find("dashed"), std::string::npos);
  EXPECT_NE(line("draw\" -> \"composite"), "");
  EXPECT_NE(line("draw\" -> \"lens").find("dashed"), std::string::npos);
}

TEST(PlanDot, IsTakenByGraphviz) {
  if (std::system("command -v dot >/dev/null 2>&1") != 0) GTEST_SKIP() << "Graphviz (dot) is not installed";
  const test::TemporaryFolder folder;
  FILE* pipe = ::popen(("dot -Tsvg -o '" + (folder / "plan.svg").string() + "'").c_str(), "w");
  ASSERT_NE(pipe, nullptr);
  std::fputs(to_dot(plan_of(with_awkward_name())).c_str(), pipe);
  EXPECT_EQ(::pclose(pipe), 0);
}

TEST(Plan, MattesAreFoundOnlyWhereSomethingReadsThem) {
  Scene scene = drawn_scene();
  for (const char* name : {"matte", "background", "merge"}) EXPECT_FALSE(plan_of(scene).runs(name)) << name;
  scene.foregrounds.emplace_back();
  scene.foregrounds[0].name = "man";
  EXPECT_TRUE(plan_of(scene).runs("matte"));
  EXPECT_TRUE(plan_of(scene).runs("merge"));
  EXPECT_EQ(stage(plan_of(scene), "matte").why, "mattes are found of man");
  scene.objects.clear();
  EXPECT_FALSE(plan_of(scene).runs("matte"));
  EXPECT_EQ(stage(plan_of(scene), "matte").why, "nothing that runs reads it");
  EXPECT_TRUE(plan_of(scene, pinhole(), {.layers = true, .no_streams_because = {}}).runs("matte"));
}

TEST(Plan, LinesAroundFilmedThingsNeedNoObjectAndNoOpenGl) {
  Scene scene = empty_scene();
  scene.foregrounds.emplace_back();
  EXPECT_FALSE(plan_of(scene).runs("matte"));
  scene.foregrounds[0].options.line.emplace();
  const Plan plan = plan_of(scene);
  for (const char* name : {"matte", "merge", "composite"}) EXPECT_TRUE(plan.runs(name)) << name;
  EXPECT_FALSE(plan.runs("draw"));
  EXPECT_EQ(stage(plan, "merge").why, "lines are drawn around what was filmed");
}

TEST(Plan, WorldInThePlatesPlaceNeedsNoObjectAndNoOpenGl) {
  Scene scene = empty_scene();
  scene.foregrounds.emplace_back();
  scene.background.emplace();
  scene.background->colour = {0, 0, 0};
  const Plan plan = plan_of(scene);
  for (const char* name : {"matte", "background", "merge", "composite"}) EXPECT_TRUE(plan.runs(name)) << name;
  EXPECT_FALSE(plan.runs("draw"));
}

}  // namespace
}  // namespace rinkaku::pipeline

// Flow arrows drawn by hand, without a window.
#include "apps/rinkaku/viewer/arrow_editor.h"

#include <gtest/gtest.h>

#include "pipeline/frame/error.h"
#include "tests/apps/cli_tools.h"

namespace rinkaku::app {
namespace {

using test::ShotFolder;

// Three metres above the water, straight down, x to the right and y up in the picture: pixel (u, v) sees the point
// ((u - 319.5) 3 / 640, (239.5 - v) 3 / 640).
const std::string above =
    "[track]\nlocked = { position_m = [0, 0, 3], look_at_m = [0, 0, 0], up = [0, 1, 0] }\n"
    "[water] # a pond\n"
    "[[water.surface]]\noutline_m = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]\n";
const std::string end = "# that is all\n[output]\nvideo = \"out.mkv\"\n";

glm::dvec2 pixel_of(double x, double y) { return {319.5 + x * 640 / 3, 239.5 - y * 640 / 3}; }

class Pond {
 public:
  explicit Pond(const std::string& arrows, const std::string& lens = "0, 0, 0, 0, 0") : folder(640, 480) {
    folder.write("camera.yml", ShotFolder::camera_text(640, 480, lens));
    folder.write("in.mkv", "");
    folder.write("scene.toml", test::plate + above + arrows + end);
    file.emplace(folder / "scene.toml", pipeline::SceneOptions{});
    look(0);
  }
  void look(std::int64_t at_frame) {
    // As OpenCV's camera sees it: x right, y down, z ahead.
    const RigidTransform camera_from_world{glm::dquat(0, 1, 0, 0), {0, 0, 3}};
    editor.look(*file, 25, at_frame, camera_from_world);
    frame = at_frame;
  }
  std::optional<std::string> drawn(glm::dvec2 from, glm::dvec2 to) {
    editor.press(from, 6);
    editor.drag(to);
    return editor.release();
  }
  void take(const std::optional<std::string>& text) {
    ASSERT_TRUE(text);
    EXPECT_EQ(file->set_text(*text), SceneFile::Effect::Redraw);
    look(frame);
  }
  const std::vector<pipeline::WaterArrowScene>& arrows() const { return file->scene().water->surfaces[0].arrows; }

  ShotFolder folder;
  std::optional<SceneFile> file;
  ArrowEditor editor;
  std::int64_t frame = 0;
};

// A millimetre of rounding is 0.2 pixels from three metres.
constexpr double half_mm = 0.00051, rounding_px = 0.11;

void expect_near(glm::dvec2 a, glm::dvec2 b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

const std::string one = "[[water.surface.arrow]] # its flow\nfrom_m = [0.2, 0.1, 0]\nto_m = [0.6, 0.1, 0]\n";

TEST(ArrowEditor, ADrawnArrowLiesOnTheWaterAndCommentsStay) {
  Pond pond("");
  pond.take(pond.drawn(pixel_of(0, 0), pixel_of(0.5, 0.25)));
  ASSERT_EQ(pond.arrows().size(), 1u);
  expect_near(glm::dvec2(pond.arrows()[0].from_m), {0, 0}, half_mm);
  expect_near(glm::dvec2(pond.arrows()[0].to_m), {0.5, 0.25}, half_mm);
  EXPECT_EQ(pond.arrows()[0].to_m.z, 0);
  EXPECT_TRUE(pond.editor.selected());
  for (const char* comment : {"# a pond", "# that is all"}) {
    EXPECT_NE(pond.file->text().find(comment), std::string::npos) << comment;
  }
  // And is written as it was drawn.
  pond.file->save();
  EXPECT_EQ(test::text_of(pond.folder / "scene.toml"), pond.file->text());
}

TEST(ArrowEditor, ShowsArrowsWhereThePictureShowsThem) {
  Pond pond(one);
  const auto sketches = pond.editor.sketches();
  ASSERT_EQ(sketches.size(), 1u);
  expect_near(sketches[0].from_px, pixel_of(0.2, 0.1), 1e-6);
  expect_near(sketches[0].to_px, pixel_of(0.6, 0.1), 1e-6);
}

TEST(ArrowEditor, ThroughALensTheArrowIsShownWhereItWasDrawn) {
  Pond pond("", "-0.2, 0.05, 0.001, -0.002, 0");
  pond.take(pond.drawn({150, 120}, {230, 160}));
  ASSERT_EQ(pond.editor.sketches().size(), 1u);
  expect_near(pond.editor.sketches()[0].from_px, {150, 120}, rounding_px);
  expect_near(pond.editor.sketches()[0].to_px, {230, 160}, rounding_px);
  // The lens draws what is off the middle nearer to it: without it the point would lie elsewhere.
  EXPECT_GT(glm::length(glm::dvec2(pond.arrows()[0].from_m)), glm::length(glm::dvec2(169.5, 119.5)) * 3 / 640 + 0.01);
}

TEST(ArrowEditor, EndsAndMiddlesAreMoved) {
  Pond pond(one);
  pond.take(pond.drawn(pixel_of(0.6, 0.1), pixel_of(0.6, 0.5)));
  expect_near(glm::dvec2(pond.arrows()[0].from_m), {0.2, 0.1}, half_mm);
  expect_near(glm::dvec2(pond.arrows()[0].to_m), {0.6, 0.5}, half_mm);
  pond.take(pond.drawn(pixel_of(0.2, 0.1), pixel_of(0.2, 0.5)));
  expect_near(glm::dvec2(pond.arrows()[0].from_m), {0.2, 0.5}, half_mm);
  pond.take(pond.drawn(pixel_of(0.4, 0.5), pixel_of(0.4, -0.5)));
  expect_near(glm::dvec2(pond.arrows()[0].from_m), {0.2, -0.5}, half_mm);
  expect_near(glm::dvec2(pond.arrows()[0].to_m), {0.6, -0.5}, half_mm);
  EXPECT_NE(pond.file->text().find("# its flow"), std::string::npos);
}

TEST(ArrowEditor, ArrowsOnTheScreenStayThere) {
  Pond pond("[[water.surface.arrow]]\nfrom_px = [300, 200]\nto_px = [360, 200]\n");
  pond.take(pond.drawn({360, 200}, {360, 260}));
  EXPECT_TRUE(pond.arrows()[0].on_screen);
  expect_near(pond.arrows()[0].from_px, {300, 200}, 0.051);  // written to the tenth of a pixel
  expect_near(pond.arrows()[0].to_px, {360, 260}, 0.051);
}

TEST(ArrowEditor, EveryKeyFrameGetsAndLosesTheArrow) {
  Pond pond(one + "[[water.surface.arrow]]\nframe = 40\nfrom_m = [0.2, 0.1, 0]\nto_m = [0.2, 0.5, 0]\n");
  pond.take(pond.drawn(pixel_of(-0.5, -0.5), pixel_of(-0.5, 0)));
  ASSERT_EQ(pond.arrows().size(), 4u);
  EXPECT_EQ(pond.arrows()[1].from_m, pond.arrows()[3].from_m);
  EXPECT_EQ(pond.arrows()[3].frame, 40);
  // At frame 50 the second key's arrows are shown, and what is moved is that key's.
  pond.look(50);
  EXPECT_EQ(pond.editor.key_frame(), 40);
  pond.take(pond.drawn(pixel_of(0.2, 0.5), pixel_of(0.6, 0.5)));
  expect_near(glm::dvec2(pond.arrows()[2].to_m), {0.6, 0.5}, half_mm);
  expect_near(glm::dvec2(pond.arrows()[0].to_m), {0.6, 0.1}, half_mm);
  // The arrow that is in the file first, in both keys.
  pond.take(pond.editor.without_selected());
  ASSERT_EQ(pond.arrows().size(), 2u);
  expect_near(glm::dvec2(pond.arrows()[0].from_m), {-0.5, -0.5}, half_mm);
  expect_near(glm::dvec2(pond.arrows()[1].from_m), {-0.5, -0.5}, half_mm);
  EXPECT_FALSE(pond.editor.without_selected());
}

TEST(ArrowEditor, AKeyFrameBeginsWithTheArrowsThatThereAre) {
  Pond pond(one);
  EXPECT_FALSE(pond.editor.with_key_here());  // there is one
  pond.look(25);
  pond.take(pond.editor.with_key_here());
  ASSERT_EQ(pond.arrows().size(), 2u);
  EXPECT_EQ(pond.arrows()[1].frame, 25);
  EXPECT_EQ(pond.arrows()[1].from_m, pond.arrows()[0].from_m);
  EXPECT_EQ(pond.arrows()[1].to_m, pond.arrows()[0].to_m);
}

TEST(ArrowEditor, NothingIsDrawnBesideTheWaterNorByAClick) {
  Pond pond("");
  pond.editor.press(pixel_of(1.2, 0), 6);
  pond.editor.drag(pixel_of(0.5, 0));
  ASSERT_EQ(pond.editor.sketches().size(), 1u);
  EXPECT_FALSE(pond.editor.sketches()[0].fits);
  EXPECT_FALSE(pond.editor.release());
  EXPECT_FALSE(pond.drawn(pixel_of(0, 0), pixel_of(0.01, 0)));
  EXPECT_FALSE(pond.editor.selected());
}

TEST(ArrowEditor, WithoutAPoseThereIsNothingToDrawOn) {
  Pond pond(one);
  pond.editor.look(*pond.file, 25, 3, std::nullopt);
  EXPECT_TRUE(pond.editor.sketches().empty());
  EXPECT_FALSE(pond.drawn(pixel_of(0, 0), pixel_of(0.5, 0)));
}

}  // namespace
}  // namespace rinkaku::app

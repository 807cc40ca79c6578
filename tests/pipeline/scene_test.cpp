#include "pipeline/scene/scene.h"

#include "tests/pipeline/scene_folder.h"

namespace rinkaku::pipeline {
namespace {

using namespace test_scenes;

TEST(Scene, TakesAPlateAlone) {
  const SceneFolder folder;
  const Scene scene = folder.read("[plate]\nvideo = \"a.mp4\"\n");
  EXPECT_EQ(scene.file, folder / "scene.toml");
  EXPECT_EQ(scene.plate.input, (folder / "a.mp4").string());
  EXPECT_TRUE(scene.plate.camera.empty());
  EXPECT_FALSE(scene.track);
  EXPECT_TRUE(scene.objects.empty());
  EXPECT_TRUE(scene.output.path.empty());
}

TEST(Scene, TakesACamera) {
  const SceneFolder folder;
  const Scene scene = folder.read(
      "[plate]\ndevice = \"/dev/video3\"\nsize_px = [640, 360]\nfps = 29.97\nformat = \"YUYV\"\n"
      "controls = { zoom = 2, auto_exposure = \"Manual Mode\", autofocus = false }\n");
  ASSERT_TRUE(scene.plate.device);
  const CameraDevice& camera = *scene.plate.device;
  EXPECT_EQ(camera.device, "/dev/video3");
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.height_px, 360);
  EXPECT_EQ(camera.fps, (Rational{30000, 1001}));
  EXPECT_EQ(camera.format, "YUYV");
  // In the file's order: one may wake the next.
  ASSERT_EQ(camera.controls.size(), 3u);
  EXPECT_EQ(camera.controls[0].name, "zoom");
  EXPECT_EQ(std::get<std::int64_t>(camera.controls[0].value), 2);
  EXPECT_EQ(std::get<std::string>(camera.controls[1].value), "Manual Mode");
  EXPECT_EQ(std::get<std::int64_t>(camera.controls[2].value), 0);
}

TEST(Scene, CameraOrRecordingOfTheCallReplacesTheFiles) {
  const SceneFolder folder;
  const std::string video = "[plate]\nvideo = \"a.mp4\"\n", device = "[plate]\ndevice = \"/dev/video3\"\nfps = 15\n";
  folder.read(video);
  const Scene live = read_scene(folder / "scene.toml", {.device = "/dev/video1"});
  ASSERT_TRUE(live.plate.device);
  EXPECT_EQ(live.plate.device->device, "/dev/video1");
  folder.read(device);
  const Scene other = read_scene(folder / "scene.toml", {.device = "/dev/video1"});
  EXPECT_EQ(other.plate.device->device, "/dev/video1");
  EXPECT_EQ(other.plate.device->fps, (Rational{15, 1}));
  const Scene recorded = read_scene(folder / "scene.toml", {.input = "take.mkv"});
  EXPECT_FALSE(recorded.plate.device);
  EXPECT_FALSE(recorded.plate.fps);
}

TEST(Scene, TakesPicturesPerSecond) {
  const SceneFolder folder;
  const std::string images = "[plate]\nimages = \"frames/%04d.png\"\n";
  EXPECT_FALSE(folder.read(images).plate.fps);
  const std::pair<const char*, Rational> rates[] = {
      {"24", {24, 1}},          {"23.976", {24000, 1001}}, {"23.98", {24000, 1001}},    {"29.97", {30000, 1001}},
      {"59.94", {60000, 1001}}, {"12.5", {25, 2}},         {"23.97602", {24000, 1001}}, {"0.5", {1, 2}},
      {"0.001", {1, 1000}},     {"23.9", {239, 10}},       {"119.88", {120000, 1001}}};
  for (const auto& [text, rate] : rates) {
    EXPECT_EQ(folder.read(images + "fps = " + text + "\n").plate.fps, rate) << text;
  }
}

TEST(Scene, FillsInDefaults) {
  const SceneFolder folder;
  const Scene scene = folder.read(object);
  ASSERT_EQ(scene.objects.size(), 1u);
  const ObjectScene& cow = scene.objects[0];
  EXPECT_EQ(cow.name, "cow.obj");
  EXPECT_EQ(cow.mesh, folder / "cow.obj");
  EXPECT_EQ(cow.scale, glm::dvec3(1));
  EXPECT_FALSE(cow.height_m);
  EXPECT_FALSE(cow.up);
  EXPECT_EQ(cow.anchor, ObjectScene::Anchor::Base);
  EXPECT_FALSE(cow.colour);
  ASSERT_TRUE(cow.toon);
  EXPECT_EQ(cow.toon->bands, 3);
  EXPECT_FALSE(cow.outline);
  EXPECT_FALSE(scene.track->smoothing.on);
  EXPECT_EQ(scene.track->hold_s, 0.3);
  EXPECT_EQ(scene.output.content, OutputScene::Content::Composite);
}

TEST(Scene, RegionsAreAFileOrTheCache) {
  const SceneFolder folder;
  EXPECT_FALSE(folder.read(object).objects[0].regions);
  EXPECT_FALSE(folder.read(object + "regions = false\n").objects[0].regions);
  EXPECT_EQ(folder.read(object + "regions = true\n").objects[0].regions.value().file, "");
  const Scene named = folder.read(object + "regions = \"baked/cow.rgn\"\n");
  EXPECT_EQ(named.objects[0].regions.value().file, folder / "baked/cow.rgn") << "it needn't be there yet";
  EXPECT_EQ(folder.message(object + "regions = 3\n"),
            "DIR/scene.toml:8:11: 'regions' in [[object]] must be true, false or a path, found 3");
}

TEST(Scene, ReadsEveryKeyOfAnObject) {
  const SceneFolder folder;
  const Scene scene = folder.read(
      object +
      "name = \"Spot\"\nposition_m = [1, -2.5, 0.25]\nrotation_deg = [0, 0, 90]\n"
      "height_m = 0.15\nup = \"z\"\ncrease_deg = 30\ncolour = \"#ff8000\"\n"
      "toon = { bands = 5, shade_colour = [0.25, 0.5, 1] }\n"
      "outline = { width_px = 2.5, colour = \"#000000\" }\n"
      "[[object]]\nmesh = \"cow.obj\"\nscale = [-1, 2, 3]\ntoon = false\noutline = true\nanchor = \"origin\"\n");
  ASSERT_EQ(scene.objects.size(), 2u);
  const ObjectScene& first = scene.objects[0];
  EXPECT_EQ(first.name, "Spot");
  EXPECT_EQ(first.position_m, glm::dvec3(1, -2.5, 0.25));
  EXPECT_EQ(first.rotation_deg, glm::dvec3(0, 0, 90));
  EXPECT_EQ(first.height_m, 0.15);
  EXPECT_EQ(first.up, 'z');
  EXPECT_EQ(first.crease_deg, 30);
  EXPECT_EQ(first.colour, (std::array{1.0, 128 / 255.0, 0.0}));
  EXPECT_EQ(first.toon->bands, 5);
  EXPECT_EQ(first.toon->shade_colour, (std::array{0.25, 0.5, 1.0}));
  EXPECT_EQ(first.outline->width_px, 2.5);
  EXPECT_EQ(first.outline->colour, (std::array{0.0, 0.0, 0.0}));
  const ObjectScene& second = scene.objects[1];
  EXPECT_EQ(second.scale, glm::dvec3(-1, 2, 3));
  EXPECT_EQ(second.anchor, ObjectScene::Anchor::Origin);
  EXPECT_FALSE(second.toon);
  EXPECT_EQ(second.outline->width_px, OutlineScene{}.width_px);
}

TEST(Scene, TakesLinesThatFollowCurvature) {
  const SceneFolder folder;
  const OutlineScene line =
      *folder
           .read(object +
                 "outline = { width_px = 2, method = \"curvature\", curvature = \"largest\", "
                 "sign = \"concave\", exaggeration = 4, saturation = 0.5, curve = 2, "
                 "min_factor = 0.1, smoothing = 0, lean = 1.5, taper_px = 7, thickness_part = 0.75 }\n")
           .objects[0]
           .outline;
  EXPECT_EQ(line.method, OutlineScene::Method::Curvature);
  EXPECT_EQ(line.curvature, OutlineScene::Curvature::Largest);
  EXPECT_EQ(line.sign, OutlineScene::Sign::Concave);
  EXPECT_EQ(line.exaggeration, 4);
  EXPECT_EQ(line.saturation, 0.5);
  EXPECT_EQ(line.curve, 2);
  EXPECT_EQ(line.min_factor, 0.1);
  EXPECT_EQ(line.smoothing, 0);
  EXPECT_EQ(line.thickness_part, 0.75);
  EXPECT_EQ(line.lean, 1.5);
  EXPECT_EQ(line.taper_px, 7);
}

TEST(Scene, TakesEveryStyleOfLine) {
  const SceneFolder folder;
  for (const NamedMethod& named : line_methods()) {
    const std::string key = std::string("outline = { method = \"") + named.word + "\" }\n";
    const OutlineScene line = *folder.read(object + key).objects[0].outline;
    EXPECT_EQ(line.method, named.method);
    EXPECT_EQ(line.taper_px, usual_taper_px(named.method)) << named.word;
    EXPECT_EQ(line.style.inner.has_value(), brings_inner_lines(named.method)) << named.word;
  }
}

TEST(Scene, TakesStrokes) {
  const SceneFolder folder;
  const LineStyleScene style =
      folder
          .read(object +
                "outline = { method = \"strokes\", brush = \"a.mp4\", brush_px = 80, stroke_px = 30, gap = 0.2, "
                "pressure = 1, dryness = 0.5 }\n")
          .objects[0]
          .outline->style;
  EXPECT_EQ(style.brush, folder / "a.mp4");  // whether it is a picture is seen when it is read
  EXPECT_EQ(style.brush_px, 80);
  EXPECT_EQ(style.stroke_px, 30);
  EXPECT_EQ(style.gap, 0.2);
  EXPECT_EQ(style.pressure, 1);
  EXPECT_EQ(style.dryness, 0.5);
}

TEST(Scene, TakesInnerLinesOfAnyMethod) {
  const SceneFolder folder;
  const OutlineScene line = *folder
                                 .read(object +
                                       "outline = { inner = { creases = false, crease_deg = 20, materials = false, "
                                       "cuts = false, width_px = 1.5, colour = \"#ff0000\" } }\n")
                                 .objects[0]
                                 .outline;
  ASSERT_TRUE(line.style.inner);
  EXPECT_FALSE(line.style.inner->creases);
  EXPECT_EQ(line.style.inner->crease_deg, 20);
  EXPECT_FALSE(line.style.inner->materials);
  EXPECT_FALSE(line.style.inner->cuts);
  EXPECT_EQ(line.style.inner->width_px, 1.5);
  EXPECT_EQ(line.style.inner->colour, (std::array{1.0, 0.0, 0.0}));
  EXPECT_FALSE(
      folder.read(object + "outline = { method = \"z_lines\", inner = false }\n").objects[0].outline->style.inner);
}

TEST(Scene, TakesLinesInMetres) {
  const SceneFolder folder;
  const OutlineScene line =
      *folder.read(object + "outline = { width_m = 0.002, min_px = 0.5, max_px = 9 }\n").objects[0].outline;
  EXPECT_EQ(line.width_m, 0.002);
  EXPECT_EQ(line.min_px, 0.5);
  EXPECT_EQ(line.max_px, 9);
  EXPECT_EQ(line.method, OutlineScene::Method::Uniform);
}

TEST(Scene, TakesControlPoints) {
  const SceneFolder folder;
  const auto line = [&](const std::string& control) {
    return *folder.read(object + "outline = { method = \"control\"" + control + " }\n").objects[0].outline;
  };
  using By = outline::FeaturePointOptions::By;
  const OutlineScene defaults = line("");
  EXPECT_EQ(defaults.method, OutlineScene::Method::Control);
  EXPECT_EQ(defaults.taper_px, 15);
  EXPECT_EQ(defaults.control.along, 60);
  EXPECT_EQ(defaults.control.features.by, By::K95);
  const OutlineScene sphere =
      line(", exaggeration = 3, control = { sphere = 40, distance = 0.5, convex = 0.25, comparison = 2 }");
  EXPECT_EQ(sphere.exaggeration, 3);
  EXPECT_EQ(sphere.control.on_sphere, 40);
  EXPECT_EQ(sphere.control.distance, 0.5);
  EXPECT_EQ(sphere.control.features.convex, 0.25);
  EXPECT_EQ(sphere.control.features.comparison, 2);
  const OutlineScene printed =
      line(", control = { points_m = [[0, 0.5, 1], [2, 0, 0]], reach_m = 0.1, lengths = true, concave_deg = 170 }");
  ASSERT_EQ(printed.control.points_m.size(), 2u);
  EXPECT_EQ(printed.control.points_m[0], glm::dvec3(0, 0.5, 1));
  EXPECT_EQ(printed.control.reach_m, 0.1);
  EXPECT_TRUE(printed.control.lengths);
  EXPECT_EQ(printed.control.features.by, By::Degrees);
  EXPECT_EQ(printed.control.features.concave, 170);
  EXPECT_EQ(printed.control.features.convex, 360) << "no convex features unless asked for";
}

TEST(Scene, TakesWhatLinesWeigh) {
  const SceneFolder folder;
  EXPECT_FALSE(folder.read(object + "outline = true\n").objects[0].outline->weight.any());
  std::ofstream(folder / "thick.png") << "not looked into yet";
  const LineWeightScene weight =
      folder
          .read(object +
                "outline = { weight = { shade = 1.5, paint = \"alpha\", map = \"thick.png\", "
                "material = [{ name = \"skin\", factor = 0.5 }, { name = \"hair\", factor = 2 }] } }\n")
          .objects[0]
          .outline->weight;
  EXPECT_EQ(weight.shade, 1.5);
  EXPECT_EQ(weight.paint, 3);
  EXPECT_EQ(weight.map.filename(), "thick.png");
  ASSERT_EQ(weight.materials.size(), 2u);
  EXPECT_EQ(weight.materials[1].name, "hair");
  EXPECT_EQ(weight.materials[1].factor, 2);
}

TEST(Scene, PlaysAnimations) {
  const SceneFolder folder;
  EXPECT_FALSE(folder.read(object).objects[0].animation);
  EXPECT_FALSE(folder.read(object + "animation = false\n").objects[0].animation);
  const AnimationScene first = *folder.read(object + "animation = true\n").objects[0].animation;
  EXPECT_EQ(first.clip_name, "");
  EXPECT_EQ(first.clip_index, 0);
  EXPECT_TRUE(first.loop);
  EXPECT_EQ(first.speed, 1);
  const AnimationScene named =
      *folder.read(object + "animation = { clip = \"Walk\", loop = false, start_s = 1.5, speed = -0.5 }\n")
           .objects[0]
           .animation;
  EXPECT_EQ(named.clip_name, "Walk");
  EXPECT_FALSE(named.loop);
  EXPECT_EQ(named.start_s, 1.5);
  EXPECT_EQ(named.speed, -0.5);
  EXPECT_EQ(folder.read(object + "animation = { clip = 2 }\n").objects[0].animation->clip_index, 2);
  EXPECT_EQ(first.skinning, Skinning::Auto);
  const auto skinning = [&](const std::string& where) {
    return folder.read(object + "animation = { skinning = \"" + where + "\" }\n").objects[0].animation->skinning;
  };
  EXPECT_EQ(skinning("gpu"), Skinning::Gpu);
  EXPECT_EQ(skinning("cpu"), Skinning::Cpu);
  EXPECT_EQ(skinning("auto"), Skinning::Auto);
  EXPECT_TRUE(folder.read(object + "holdout = true\nanimation = true\n").objects[0].animation);
  EXPECT_TRUE(folder.read(object + "animation = true\nfluffy = { cut = \"gpu\" }\n").objects[0].fluffy);
}

TEST(Scene, TakesOneScaleForAllAxes) {
  const SceneFolder folder;
  EXPECT_EQ(folder.read(object + "scale = -2\n").objects[0].scale, glm::dvec3(-2));
}

TEST(Scene, ReadsAMarkerAndSmoothsIt) {
  const SceneFolder folder;
  const std::string marker = "[track]\nmarker = { dictionary = \"DICT_APRILTAG_36h11\", id = 586, size_m = 0.1 }\n";
  const Scene scene = folder.read(plate + marker + "hold_s = 0\nfade_s = 1.5\n");
  const auto& track = std::get<MarkerTrack>(scene.track->from);
  EXPECT_EQ(track.dictionary, "APRILTAG_36h11");
  EXPECT_EQ(track.id, 586);
  EXPECT_EQ(track.size_m, 0.1);
  EXPECT_TRUE(scene.track->smoothing.on);
  EXPECT_EQ(scene.track->hold_s, 0);
  EXPECT_EQ(scene.track->fade_s, 1.5);
  EXPECT_FALSE(folder.read(plate + marker + "smoothing = false\n").track->smoothing.on);
}

TEST(Scene, ReadsBoardPosesAndLocked) {
  const SceneFolder folder;
  const Scene board = folder.read(plate + "[track]\nboard = \"board.toml\"\n");
  EXPECT_EQ(std::get<BoardTrack>(board.track->from).board, folder / "board.toml");
  EXPECT_TRUE(board.track->smoothing.on);
  const Scene poses = folder.read(tracked + "smoothing = { beta = 2 }\n");
  EXPECT_EQ(std::get<PoseFileTrack>(poses.track->from).poses, folder / "poses.csv");
  EXPECT_TRUE(poses.track->smoothing.on);
  EXPECT_EQ(poses.track->smoothing.beta, 2);
  EXPECT_EQ(poses.track->smoothing.min_cutoff_hz, Smoothing{}.min_cutoff_hz);
  const Scene locked =
      folder.read(plate + "[track]\nlocked = { position_m = [0, -2, 1], look_at_m = [0, 0, 0.5], up = [0, 1, 0] }\n");
  const auto& camera = std::get<LockedTrack>(locked.track->from);
  EXPECT_EQ(camera.position_m, glm::dvec3(0, -2, 1));
  EXPECT_EQ(camera.look_at_m, glm::dvec3(0, 0, 0.5));
  EXPECT_EQ(camera.up, glm::dvec3(0, 1, 0));
  EXPECT_FALSE(locked.track->smoothing.on);
}

TEST(Scene, ReadsLightAndOutput) {
  const SceneFolder folder;
  const Scene scene = folder.read(plate +
                                  "[light]\ndirection = [0, 0, 2]\n[output]\nvideo = \"../out.mkv\"\n"
                                  "codec = \"ffv1\"\nbit_rate = 4_000_000\ncontent = \"cg\"\n");
  EXPECT_EQ(scene.light.direction, glm::dvec3(0, 0, 2));
  EXPECT_EQ(scene.output.path, (folder.path().parent_path() / "out.mkv").string());
  EXPECT_EQ(scene.output.codec, "ffv1");
  EXPECT_EQ(scene.output.bit_rate, 4'000'000);
  EXPECT_EQ(scene.output.content, OutputScene::Content::Cg);
  EXPECT_EQ(folder.read(plate + "[output]\nvideo = \"-\"\n").output.path, "-");
  EXPECT_EQ(folder.read(plate + "[output]\nimages = \"out/%04d.png\"\n").output.path,
            (folder / "out/%04d.png").string());
}

TEST(Scene, TakesImagesAndOddSpelling) {
  const SceneFolder folder;
  EXPECT_EQ(folder.read("[plate]\nimages = \"frames/%04d.png\"\n").plate.input, (folder / "frames/%04d.png").string());
  EXPECT_EQ(folder.read("[plate]\nimages = \"frames/*.png\"\n").plate.input, (folder / "frames/*.png").string());
  // A byte order mark, Windows line ends, an absolute path, dotted keys.
  const std::string video = (folder / "a.mp4").string();
  EXPECT_EQ(folder.read("\xef\xbb\xbfplate.video = \"" + video + "\"\r\n").plate.input, video);
}

TEST(Scene, TheCallsInputReplacesThePlates) {
  const SceneFolder folder;
  const auto file = folder.write("[plate]\nvideo = \"not there.mp4\"\ncamera = \"camera.yml\"\n");
  EXPECT_EQ(read_scene(file, {.input = (folder / "b.mp4").string()}).plate.input, (folder / "b.mp4").string());
  const auto relative = read_scene(file, {.input = "b.mp4"}).plate.input;
  EXPECT_EQ(relative, (std::filesystem::current_path() / "b.mp4").string());
}

TEST(SceneFile, ForegroundSaysHowItsMatteIsFoundAndHowFarAwayItIs) {
  const SceneFolder folder;
  const Scene scene = folder.read(
      tracked +
      "[background]\ncolour = \"#ff8000\"\n"
      "[[foreground]]\nname = \"man\"\nmethod = [\"chroma\", \"difference\"]\n"
      "combine = \"minimum\"\nchroma = { key = \"#00ff00\", hue_deg = 40 }\n"
      "difference = { clean = \"a.mp4\", threshold = 4 }\ndistance_m = 2.5\n"
      "within_px = [1, 2, 30, 40]\noutline = { width_px = 2, colour = \"#0000ff\" }\n"
      "[[foreground]]\nmethod = \"file\"\nfile = { images = \"m/%d.png\" }\non_ground = true\noutline = true\n"
      "[[foreground]]\nmethod = \"segmentation\"\nsegmentation = { model = \"a.mp4\" }\ndistance_m = 1\n"
      "[[foreground]]\nmethod = [\"chroma\", \"segmentation\"]\nrefine = false\ndistance_m = 1\n");
  ASSERT_EQ(scene.foregrounds.size(), 4u);
  EXPECT_EQ(std::get<SegmentationScene>(scene.foregrounds[2].methods[0]).model, (folder / "a.mp4").string());
  EXPECT_TRUE(scene.foregrounds[2].options.refine);  // a network's are not
  EXPECT_EQ(std::get<SegmentationScene>(scene.foregrounds[3].methods[1]).model, "");
  EXPECT_FALSE(scene.foregrounds[3].options.refine);
  const ForegroundScene& man = scene.foregrounds[0];
  EXPECT_EQ(man.name, "man");
  ASSERT_EQ(man.methods.size(), 2u);
  EXPECT_EQ(std::get<matte::ChromaOptions>(man.methods[0]).hue_deg, 40);
  EXPECT_EQ((*std::get<matte::ChromaOptions>(man.methods[0]).key)[1], 1);
  EXPECT_EQ(std::get<DifferenceMatteScene>(man.methods[1]).options.threshold, 4);
  EXPECT_EQ(std::get<DifferenceMatteScene>(man.methods[1]).clean, (folder / "a.mp4").string());
  EXPECT_EQ(man.options.combine, matte::ForegroundOptions::Combine::Minimum);
  EXPECT_EQ(man.options.within, (PixelRect{1, 2, 30, 40}));
  ASSERT_TRUE(man.options.line);
  EXPECT_EQ(man.options.line->width_px, 2);
  EXPECT_EQ(man.options.line->colour[2], 1);
  EXPECT_EQ(scene.foregrounds[1].options.line->width_px, 3);
  EXPECT_FALSE(scene.foregrounds[2].options.line);
  EXPECT_EQ(man.distance_m, 2.5);
  EXPECT_FALSE(man.options.refine);  // their borders are the plate's already
  EXPECT_TRUE(scene.foregrounds[1].on_ground);
  EXPECT_EQ(std::get<FileMatteScene>(scene.foregrounds[1].methods[0]).input, (folder / "m/%d.png").string());
  EXPECT_EQ((*scene.background->colour)[0], 1);
}

}  // namespace
}  // namespace rinkaku::pipeline

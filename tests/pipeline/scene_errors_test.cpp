#include "pipeline/toml/schema.h"
#include "tests/pipeline/scene_folder.h"

namespace rinkaku::pipeline {
namespace {

using namespace test_scenes;

struct BadScene {
  std::string name;
  std::string text;
  std::string message;
};

class BadSceneTest : public testing::TestWithParam<BadScene> {};

TEST_P(BadSceneTest, IsRefusedInOneLine) {
  const SceneFolder folder;
  EXPECT_EQ(folder.message(GetParam().text), GetParam().message);
}

std::string test_name(const testing::TestParamInfo<BadScene>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Syntax, BadSceneTest,
    testing::Values(
        BadScene{"EmptyFile", "",
                 "DIR/scene.toml: the scene is empty; it needs at least [plate] with 'video', 'images' or 'device'"},
        BadScene{"OnlyAComment", "# nothing\n",
                 "DIR/scene.toml: the scene is empty; it needs at least [plate] with 'video', 'images' or 'device'"},
        BadScene{"Garbage", "\001\002\003 = \n",
                 "DIR/scene.toml:1:1: not valid TOML: Error while parsing root table: expected keys, "
                 "tables, whitespace or comments, saw '\\u0001'"},
        BadScene{"UnclosedArray", "video = [1,\n",
                 "DIR/scene.toml:1:13: not valid TOML: Error while parsing array: encountered end-of-file"},
        BadScene{"UnclosedText", "[plate]\nvideo = \"a.mp4\n",
                 "DIR/scene.toml:2:15: not valid TOML: Error while parsing string: unescaped control "
                 "characters other than TAB (U+0009) are explicitly prohibited"},
        BadScene{"KeyTwice", "[plate]\nvideo = \"a.mp4\"\nvideo = \"b.mp4\"\n",
                 "DIR/scene.toml:3:9: not valid TOML: Error while parsing key-value pair: cannot redefine "
                 "existing string 'video'"}),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    Keys, BadSceneTest,
    testing::Values(
        BadScene{"NoPlate", "[light]\n",
                 "DIR/scene.toml: [plate] is missing; add it, with 'video', 'images' or 'device'"},
        BadScene{"MisspeltTable", "[plat]\nvideo = \"a.mp4\"\n",
                 "DIR/scene.toml:1:2: unknown key 'plat'; did you mean 'plate'?"},
        BadScene{"MisspeltKey", object + "  outlin = true\n",
                 "DIR/scene.toml:8:3: unknown key 'outlin' in [[object]]; did you mean 'outline'?"},
        BadScene{"SwappedLetters", object + "mehs = \"b.obj\"\n",
                 "DIR/scene.toml:8:1: unknown key 'mehs' in [[object]]; did you mean 'mesh'?"},
        BadScene{"OtherCase", object + "Toon = true\n",
                 "DIR/scene.toml:8:1: unknown key 'Toon' in [[object]]; did you mean 'toon'?"},
        BadScene{
            "LookOfAHoldout", object + "holdout = true\noutline = true\n",
            "DIR/scene.toml:9:11: 'outline' in [[object]] has no meaning for a holdout, which is not drawn; leave it "
            "out"},
        BadScene{"UnitLeftOut", object + "height = 1\n",
                 "DIR/scene.toml:8:1: unknown key 'height' in [[object]]; did you mean 'height_m'?"},
        BadScene{"KeyOfAnotherTable", object + "camera = \"camera.yml\"\n",
                 "DIR/scene.toml:8:1: unknown key 'camera' in [[object]]; it belongs in [plate]"},
        BadScene{"KeyOfTwoOtherTables", plate + "position_m = [0, 0, 0]\n",
                 "DIR/scene.toml:4:1: unknown key 'position_m' in [plate]; it belongs in locked of [track] or in "
                 "[[object]]"},
        BadScene{"KeyOfAnotherInnerTable", object + "outline = { width_px = 2, bands = 3 }\n",
                 "DIR/scene.toml:8:27: unknown key 'bands' in outline of [[object]]; it belongs in toon of [[object]]"},
        BadScene{"MisspeltInnerKey", object + "toon = { band = 3 }\n",
                 "DIR/scene.toml:8:10: unknown key 'band' in toon of [[object]]; did you mean 'bands'?"},
        BadScene{"InnerHeader", object + "[object.outline]\nwidth = 3\n",
                 "DIR/scene.toml:9:1: unknown key 'width' in outline of [[object]]; did you mean 'width_px'?"},
        BadScene{"NothingNear", object + "velocity = \"cow.rgn\"\n",
                 "DIR/scene.toml:8:1: unknown key 'velocity' in [[object]]; known keys are anchor, animation, colour, "
                 "crease_deg, "
                 "fluffy, height_m, holdout, mesh, name, outline, position_m, regions, rotation_deg, scale, "
                 "shading_scale, toon "
                 "and up"},
        BadScene{"TableOfALaterVersion", object + "[fog]\n",
                 "DIR/scene.toml:8:2: unknown key 'fog'; known keys are background, foreground, light, object, output, "
                 "plate, track and water"},
        BadScene{"TablesOfALaterVersion", object + "[[crowd]]\nname = \"x\"\n",
                 "DIR/scene.toml:8:3: unknown key 'crowd'; known keys are background, foreground, light, object, "
                 "output, plate, track and water"},
        BadScene{"CameraAndRecording", "[plate]\ndevice = \"/dev/video0\"\nvideo = \"a.mp4\"\n",
                 "DIR/scene.toml:3:9: 'video' in [plate] can't stand beside 'device'; keep one of them"},
        BadScene{"CameraKeyOfARecording", "[plate]\nvideo = \"a.mp4\"\nsize_px = [640, 480]\n",
                 "DIR/scene.toml:3:11: 'size_px' in [plate] goes with 'device'; leave it out"},
        BadScene{"CameraSize", "[plate]\ndevice = \"/dev/video0\"\nsize_px = [640]\n",
                 "DIR/scene.toml:3:11: 'size_px' in [plate] must be width and height in whole pixels, e.g. [1280, "
                 "720], found an array of 1"},
        BadScene{"CameraControl", "[plate]\ndevice = \"/dev/video0\"\ncontrols = { focus = 1.5 }\n",
                 "DIR/scene.toml:3:22: 'focus' in controls of [plate] must be a whole number, true, false, or a "
                 "menu's entry as text, found 1.5"},
        BadScene{"SingleBrackets", tracked + "[object]\nmesh = \"cow.obj\"\n",
                 "DIR/scene.toml:6:1: 'object' must be tables, each headed [[object]] in two brackets, found a table"},
        BadScene{"DoubleBrackets", "[[plate]]\nvideo = \"a.mp4\"\n",
                 "DIR/scene.toml:1:1: 'plate' must be one table, [plate], found an array of 1"},
        BadScene{"ControlCharacterInKey", "[\"pla\\nte\"]\n",
                 "DIR/scene.toml:1:2: unknown key 'pla?te'; did you mean 'plate'?"}),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    Plate, BadSceneTest,
    testing::Values(
        BadScene{"NoPicture", "[plate]\ncamera = \"camera.yml\"\n",
                 "DIR/scene.toml:1:1: [plate] needs one of 'video', 'images' or 'device'"},
        BadScene{"TwoPictures", "[plate]\nvideo = \"a.mp4\"\nimages = \"frames/%04d.png\"\n",
                 "DIR/scene.toml:3:10: 'images' in [plate] can't stand beside 'video'; keep one of them"},
        BadScene{"VideoMissing", "[plate]\nvideo = \"b.mp4\"\n",
                 "DIR/scene.toml:2:9: 'video' in [plate] names a file that doesn't exist: DIR/b.mp4"},
        BadScene{"VideoIsFolder", "[plate]\nvideo = \"frames\"\n",
                 "DIR/scene.toml:2:9: 'video' in [plate] names a folder, not a file: DIR/frames"},
        BadScene{"VideoIsDevice", "[plate]\nvideo = \"/dev/null\"\n",
                 "DIR/scene.toml:2:9: 'video' in [plate] names a device: /dev/null; give a recorded file"},
        BadScene{"VideoEmpty", "[plate]\nvideo = \"\"\n", "DIR/scene.toml:2:9: 'video' in [plate] must not be empty"},
        BadScene{"VideoNumber", "[plate]\nvideo = 3\n",
                 "DIR/scene.toml:2:9: 'video' in [plate] must be a text in quotes, found 3"},
        BadScene{"VideoDate", "[plate]\nvideo = 1979-05-27\n",
                 "DIR/scene.toml:2:9: 'video' in [plate] must be a text in quotes, found a date or time"},
        BadScene{"VideoWithNul", "[plate]\nvideo = \"a.mp4\\u0000\"\n",
                 "DIR/scene.toml:2:9: 'video' in [plate] must be a text without control characters, found the text "
                 "\"a.mp4?\""},
        BadScene{"CameraMissing", "[plate]\nvideo = \"a.mp4\"\ncamera = \"sub/../camera2.yml\"\n",
                 "DIR/scene.toml:3:10: 'camera' in [plate] names a file that doesn't exist: DIR/camera2.yml"},
        BadScene{"ImagesWithoutPattern", "[plate]\nimages = \"a.png\"\n",
                 "DIR/scene.toml:2:10: 'images' in [plate] must be a pattern of image files such as "
                 "\"frames/%04d.png\", found the text \"a.png\""},
        BadScene{"ImagesFolderMissing", "[plate]\nimages = \"nowhere/%04d.png\"\n",
                 "DIR/scene.toml:2:10: 'images' in [plate] names a folder that doesn't exist: DIR/nowhere"},
        BadScene{"FpsOfAVideo", "[plate]\nvideo = \"a.mp4\"\nfps = 24\n",
                 "DIR/scene.toml:3:7: 'fps' in [plate] goes with 'images' or 'device': a video has times of its own; "
                 "leave it out"},
        BadScene{"FpsZero", "[plate]\nimages = \"frames/%04d.png\"\nfps = 0\n",
                 "DIR/scene.toml:3:7: 'fps' in [plate] must be a number from 0.001 to 1000, found 0"},
        BadScene{"FpsText", "[plate]\nimages = \"frames/%04d.png\"\nfps = \"24p\"\n",
                 "DIR/scene.toml:3:7: 'fps' in [plate] must be a number from 0.001 to 1000, found the text \"24p\""},
        BadScene{"PlateIsNumber", "plate = 3\n", "DIR/scene.toml:1:9: 'plate' must be one table, [plate], found 3"}),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    Track, BadSceneTest,
    testing::Values(
        BadScene{
            "ObjectWithoutTrack", plate + "[[object]]\nmesh = \"cow.obj\"\n",
            "DIR/scene.toml:4:1: [[object]] needs a camera pose; add [track] with one of marker, board, poses, locked"},
        BadScene{"ObjectWithoutCamera",
                 "[plate]\nvideo = \"a.mp4\"\n[track]\nposes = \"poses.csv\"\n[[object]]\nmesh = \"cow.obj\"\n",
                 "DIR/scene.toml:5:1: [[object]] needs the camera's intrinsics; add 'camera' to [plate], e.g. "
                 "\"camera.yml\""},
        BadScene{"NoWay", plate + "[track]\n",
                 "DIR/scene.toml:4:1: [track] needs one of 'marker', 'board', 'poses' or 'locked'"},
        BadScene{"TwoWays", tracked + "board = \"board.toml\"\n",
                 "DIR/scene.toml:6:9: 'board' in [track] can't stand beside 'poses'; keep one of them"},
        BadScene{"PosesMissing", plate + "[track]\nposes = \"p.csv\"\n",
                 "DIR/scene.toml:5:9: 'poses' in [track] names a file that doesn't exist: DIR/p.csv"},
        BadScene{"BoardMissing", plate + "[track]\nboard = \"b.toml\"\n",
                 "DIR/scene.toml:5:9: 'board' in [track] names a file that doesn't exist: DIR/b.toml"},
        BadScene{"DictionaryMisspelt", plate + "[track]\nmarker = { dictionary = \"4X4_55\", id = 1, size_m = 0.1 }\n",
                 "DIR/scene.toml:5:25: there is no marker dictionary \"4X4_55\"; did you mean \"4X4_50\"?"},
        BadScene{"IdBeyondDictionary", plate + "[track]\nmarker = { dictionary = \"4X4_50\", id = 50, size_m = 0.1 }\n",
                 "DIR/scene.toml:5:40: 'id' in marker of [track] must be a whole number from 0 to 49, found 50"},
        BadScene{"IdMissing", plate + "[track]\nmarker = { dictionary = \"4X4_50\", size_m = 0.1 }\n",
                 "DIR/scene.toml:5:10: 'id' in marker of [track] is missing"},
        BadScene{
            "SizeZero", plate + "[track]\nmarker = { dictionary = \"4X4_50\", id = 1, size_m = 0.0 }\n",
            "DIR/scene.toml:5:52: 'size_m' in marker of [track] must be a number above 0 and at most 100, found 0"},
        BadScene{"MarkerNumber", plate + "[track]\nmarker = 7\n",
                 "DIR/scene.toml:5:10: 'marker' in [track] must be a table { ... }, found 7"},
        BadScene{"LookAtMissing", plate + "[track]\nlocked = { position_m = [0, 0, 2] }\n",
                 "DIR/scene.toml:5:10: 'look_at_m' in locked of [track] is missing"},
        BadScene{"LooksAtItself", plate + "[track]\nlocked = { position_m = [0, 0, 2], look_at_m = [0, 0, 2] }\n",
                 "DIR/scene.toml:5:48: 'look_at_m' in locked of [track] must differ from 'position_m'"},
        BadScene{"LooksAlongUp", plate + "[track]\nlocked = { position_m = [0, 0, 2], look_at_m = [0, 0, 0] }\n",
                 "DIR/scene.toml:5:10: the camera looks along 'up' in locked of [track]; give 'up' another direction, "
                 "e.g. [0, 1, 0]"},
        BadScene{"UpZero",
                 plate + "[track]\nlocked = { position_m = [0, 0, 2], look_at_m = [0, 1, 0], up = [0, 0, 0] }\n",
                 "DIR/scene.toml:5:64: 'up' in locked of [track] must be a direction of some length; give one such as "
                 "[0, 0, 1]"},
        BadScene{"HoldWhileLocked",
                 plate + "[track]\nlocked = { position_m = [0, 0, 2], look_at_m = [0, 1, 0] }\nhold_s = 1\n",
                 "DIR/scene.toml:6:10: 'hold_s' in [track] has no meaning beside 'locked'; leave it out"},
        BadScene{"SmoothingWhileLocked",
                 plate + "[track]\nlocked = { position_m = [0, 0, 2], look_at_m = [0, 1, 0] }\nsmoothing = true\n",
                 "DIR/scene.toml:6:13: 'smoothing' in [track] has no meaning beside 'locked'; leave it out"},
        BadScene{"HoldOfPoses", tracked + "hold_s = 1\n",
                 "DIR/scene.toml:6:10: 'hold_s' in [track] has no meaning beside 'poses'; leave it out"},
        BadScene{"FadeOfPoses", tracked + "fade_s = 1\n",
                 "DIR/scene.toml:6:10: 'fade_s' in [track] has no meaning beside 'poses'; leave it out"},
        BadScene{"SmoothingNumber", tracked + "smoothing = 1\n",
                 "DIR/scene.toml:6:13: 'smoothing' in [track] must be true, false or a table { ... }, found 1"},
        BadScene{"BetaNegative", tracked + "smoothing = { beta = -1 }\n",
                 "DIR/scene.toml:6:22: 'beta' in smoothing of [track] must be a number from 0 to 1000000, found -1"},
        BadScene{"CutoffZero", tracked + "smoothing = { min_cutoff_hz = 0 }\n",
                 "DIR/scene.toml:6:31: 'min_cutoff_hz' in smoothing of [track] must be a number above 0 and at most "
                 "1000, found 0"},
        BadScene{"HoldNegative", plate + "[track]\nboard = \"board.toml\"\nhold_s = -1\n",
                 "DIR/scene.toml:6:10: 'hold_s' in [track] must be a number from 0 to 3600, found -1"},
        BadScene{"FadeNan", plate + "[track]\nboard = \"board.toml\"\nfade_s = nan\n",
                 "DIR/scene.toml:6:10: 'fade_s' in [track] must be a number from 0 to 3600, found nan"}),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    Object, BadSceneTest,
    testing::Values(
        BadScene{"MeshLeftOut", tracked + "[[object]]\nname = \"cow\"\n",
                 "DIR/scene.toml:6:1: 'mesh' in [[object]] is missing"},
        BadScene{"MeshMissing", tracked + "[[object]]\nmesh = \"spot.obj\"\n",
                 "DIR/scene.toml:7:8: 'mesh' in [[object]] names a file that doesn't exist: DIR/spot.obj"},
        BadScene{"HeightZero", object + "height_m = 0\n",
                 "DIR/scene.toml:8:12: 'height_m' in [[object]] must be a number above 0 and at most 1000000, found 0"},
        BadScene{
            "HeightNegative", object + "height_m = -0.2\n",
            "DIR/scene.toml:8:12: 'height_m' in [[object]] must be a number above 0 and at most 1000000, found -0.2"},
        BadScene{
            "HeightNan", object + "height_m = nan\n",
            "DIR/scene.toml:8:12: 'height_m' in [[object]] must be a number above 0 and at most 1000000, found nan"},
        BadScene{"HeightInfinite", object + "height_m = inf\n",
                 "DIR/scene.toml:8:12: 'height_m' in [[object]] must be a number above 0 and at most 1000000, found "
                 "infinity"},
        BadScene{"HeightText", object + "height_m = \"15 cm\"\n",
                 "DIR/scene.toml:8:12: 'height_m' in [[object]] must be a number above 0 and at most 1000000, found "
                 "the text \"15 cm\""},
        BadScene{"HeightAndScale", object + "height_m = 1\nscale = 2\n",
                 "DIR/scene.toml:9:9: 'scale' in [[object]] can't stand beside 'height_m'; keep one of them"},
        BadScene{"ScaleZero", object + "scale = 0\n",
                 "DIR/scene.toml:8:9: 'scale' in [[object]] must not be 0 or nearly 0"},
        BadScene{"ScaleZeroOnce", object + "scale = [1, 0, 1]\n",
                 "DIR/scene.toml:8:9: 'scale' in [[object]] must not be 0 or nearly 0"},
        BadScene{"ScaleText", object + "scale = \"2\"\n",
                 "DIR/scene.toml:8:9: 'scale' in [[object]] must be a number or three numbers [x, y, z], found the "
                 "text \"2\""},
        BadScene{"ScaleTwoNumbers", object + "scale = [1, 2]\n",
                 "DIR/scene.toml:8:9: 'scale' in [[object]] must be three numbers [x, y, z], found an array of 2"},
        BadScene{
            "ScaleInfinite", object + "scale = -inf\n",
            "DIR/scene.toml:8:9: 'scale' in [[object]] must be a number from -1000000 to 1000000, found -infinity"},
        BadScene{
            "PositionTwoNumbers", object + "position_m = [0, 0]\n",
            "DIR/scene.toml:8:14: 'position_m' in [[object]] must be three numbers [x, y, z], found an array of 2"},
        BadScene{"PositionNan", object + "position_m = [0, 0, nan]\n",
                 "DIR/scene.toml:8:21: 'position_m' in [[object]] must be three numbers from -1000000 to 1000000, "
                 "found nan"},
        BadScene{"PositionNumber", object + "position_m = 1\n",
                 "DIR/scene.toml:8:14: 'position_m' in [[object]] must be three numbers [x, y, z], found 1"},
        BadScene{"PositionText", object + "position_m = [0, \"a\", 0]\n",
                 "DIR/scene.toml:8:18: 'position_m' in [[object]] must be three numbers from -1000000 to 1000000, "
                 "found the text \"a\""},
        BadScene{"PositionFar", object + "position_m = [0, 0, 1e9]\n",
                 "DIR/scene.toml:8:21: 'position_m' in [[object]] must be three numbers from -1000000 to 1000000, "
                 "found 1000000000"},
        BadScene{"UpUnknown", object + "up = \"w\"\n",
                 "DIR/scene.toml:8:6: 'up' in [[object]] must be \"x\", \"y\" or \"z\", found the text \"w\""},
        BadScene{"UpArray", object + "up = [0, 0, 1]\n",
                 "DIR/scene.toml:8:6: 'up' in [[object]] must be a text in quotes, found an array of 3"},
        BadScene{"AnchorUnknown", object + "anchor = \"top\"\n",
                 "DIR/scene.toml:8:10: 'anchor' in [[object]] must be \"base\" or \"origin\", found the text \"top\""},
        BadScene{"CreaseTooWide", object + "crease_deg = 181\n",
                 "DIR/scene.toml:8:14: 'crease_deg' in [[object]] must be a number from 0 to 180, found 181"},
        BadScene{"ColourByName", object + "colour = \"red\"\n",
                 "DIR/scene.toml:8:10: 'colour' in [[object]] must be a colour, \"#rrggbb\" or [r, g, b] from 0 to 1, "
                 "found the text \"red\""},
        BadScene{"ColourShort", object + "colour = \"#fff\"\n",
                 "DIR/scene.toml:8:10: 'colour' in [[object]] must be a colour, \"#rrggbb\" or [r, g, b] from 0 to 1, "
                 "found the text \"#fff\""},
        BadScene{"ColourTooBright", object + "colour = [1, 2, 0]\n",
                 "DIR/scene.toml:8:14: 'colour' in [[object]] must be three numbers from 0 to 1, found 2"},
        BadScene{"NameWithEscape", object + "name = \"a\\u001bb\"\n",
                 "DIR/scene.toml:8:8: 'name' in [[object]] must be a text without control characters, found the text "
                 "\"a?b\""},
        BadScene{"ShadingScaleTooCoarse", object + "shading_scale = 5\n",
                 "DIR/scene.toml:8:17: 'shading_scale' in [[object]] must be a whole number from 1 to 4, found 5"},
        BadScene{"ShadingScaleBetween", object + "shading_scale = 1.5\n",
                 "DIR/scene.toml:8:17: 'shading_scale' in [[object]] must be a whole number from 1 to 4, found 1.5"},
        BadScene{"ShadingScaleOfAHoldout", object + "holdout = true\nshading_scale = 2\n",
                 "DIR/scene.toml:9:17: 'shading_scale' in [[object]] has no meaning for a holdout, which is not drawn; "
                 "leave it out"},
        BadScene{"ToonNumber", object + "toon = 3\n",
                 "DIR/scene.toml:8:8: 'toon' in [[object]] must be true, false or a table { ... }, found 3"},
        BadScene{"OneBand", object + "toon = { bands = 1 }\n",
                 "DIR/scene.toml:8:18: 'bands' in toon of [[object]] must be a whole number from 2 to 16, found 1"},
        BadScene{"HalfABand", object + "toon = { bands = 2.5 }\n",
                 "DIR/scene.toml:8:18: 'bands' in toon of [[object]] must be a whole number from 2 to 16, found 2.5"},
        BadScene{
            "ShadeNegative", object + "toon = { shade_colour = [0, 0, -0.1] }\n",
            "DIR/scene.toml:8:32: 'shade_colour' in toon of [[object]] must be three numbers from 0 to 1, found -0.1"},
        BadScene{"ControlOfAnotherMethod", object + "outline = { control = { along = 20 } }\n",
                 "DIR/scene.toml:8:23: 'control' in outline of [[object]] goes with method = \"control\"; add that, or "
                 "leave it out"},
        BadScene{
            "ControlPointsTwice",
            object + "outline = { method = \"control\", control = { along = 20, sphere = 20 } }\n",
            "DIR/scene.toml:8:66: 'sphere' in control of outline of [[object]] can't stand beside 'along'; keep one "
            "of them"},
        BadScene{"ControlPointOfTwoNumbers",
                 object + "outline = { method = \"control\", control = { points_m = [[1, 2]] } }\n",
                 "DIR/scene.toml:8:56: 'points_m' in control of outline of [[object]] must be a list of points [[x, y, "
                 "z], ...] in metres, at most 10000, found an array of 1"},
        BadScene{"ThresholdsOfBothKinds",
                 object + "outline = { method = \"control\", control = { convex = 1, concave_deg = 170 } }\n",
                 "DIR/scene.toml:8:54: 'convex' in control of outline of [[object]] can't stand beside thresholds in "
                 "degrees; give both as _deg, or none"},
        BadScene{"AnimatedRegions", object + "animation = true\nregions = true\n",
                 "DIR/scene.toml:9:11: 'regions' in [[object]] needs a mesh that stands still, but the object has "
                 "'animation'; leave one of them out"},
        BadScene{
            "AnimatedFluffLists", object + "animation = true\nfluffy = { cut = \"regions\" }\n",
            "DIR/scene.toml:9:10: 'fluffy' in [[object]] is cut by lists made of a mesh that stands still, but the "
            "object has 'animation'; give cut = \"exact\" or \"gpu\""},
        BadScene{"ClipFlag", object + "animation = { clip = true }\n",
                 "DIR/scene.toml:8:22: 'clip' in animation of [[object]] must be a clip's name or its number, counted "
                 "from 0, found true"},
        BadScene{"ClipBelowZero", object + "animation = { clip = -1 }\n",
                 "DIR/scene.toml:8:22: 'clip' in animation of [[object]] must be a whole number from 0 to 1000000, "
                 "found -1"},
        BadScene{"AnimationText", object + "animation = \"Walk\"\n",
                 "DIR/scene.toml:8:13: 'animation' in [[object]] must be true, false or a table { ... }, found the "
                 "text \"Walk\""},
        BadScene{"OutlineText", object + "outline = \"yes\"\n",
                 "DIR/scene.toml:8:11: 'outline' in [[object]] must be true, false or a table { ... }, found the text "
                 "\"yes\""},
        BadScene{
            "OutlineArray", object + "outline = [1]\n",
            "DIR/scene.toml:8:11: 'outline' in [[object]] must be true, false or a table { ... }, found an array of 1"},
        BadScene{"WidthZero", object + "outline = { width_px = 0 }\n",
                 "DIR/scene.toml:8:24: 'width_px' in outline of [[object]] must be a number above 0 and at most 100, "
                 "found 0"},
        BadScene{
            "WidthTwice", object + "outline = { width_px = 2, width_m = 0.01 }\n",
            "DIR/scene.toml:8:37: 'width_m' in outline of [[object]] can't stand beside 'width_px'; keep one of them"},
        BadScene{"LimitOfAFixedWidth", object + "outline = { width_px = 2, min_px = 1 }\n",
                 "DIR/scene.toml:8:36: 'min_px' in outline of [[object]] goes with 'width_m'; leave it out, or give "
                 "'width_m' in place of 'width_px'"},
        BadScene{"LimitsCrossed", object + "outline = { width_m = 0.01, min_px = 5, max_px = 4 }\n",
                 "DIR/scene.toml:8:50: 'max_px' in outline of [[object]] must not be below 'min_px'"},
        BadScene{
            "UnknownMethod", object + "outline = { method = \"curved\" }\n",
            "DIR/scene.toml:8:22: 'method' in outline of [[object]] must be one of \"uniform\", \"curvature\", "
            "\"hull\", \"depth_normals\", \"silhouette\", \"laplacian\", \"z_lines\", \"hidden_lines\", \"facing\", "
            "\"isophote\", \"wobble\", \"strokes\", \"control\", found the text \"curved\""},
        BadScene{"KeyOfAnotherMethod", object + "outline = { method = \"hull\", wobble = 1 }\n",
                 "DIR/scene.toml:8:39: 'wobble' in outline of [[object]] goes with method = \"wobble\"; add that, or "
                 "leave it out"},
        BadScene{"ThresholdOfNoMethod", object + "outline = { threshold = 0.2 }\n",
                 "DIR/scene.toml:8:25: 'threshold' in outline of [[object]] goes with method = \"facing\" or "
                 "\"isophote\"; add that, or leave it out"},
        BadScene{"WidthOfFacing", object + "outline = { method = \"facing\", width_px = 2 }\n",
                 "DIR/scene.toml:8:43: 'width_px' in outline of [[object]] has no meaning with method = \"facing\"; "
                 "give 'threshold' in its place"},
        BadScene{"TaperOfAPicture", object + "outline = { method = \"silhouette\", taper_px = 2 }\n",
                 "DIR/scene.toml:8:47: 'taper_px' in outline of [[object]] goes with methods whose lines follow edges "
                 "of the mesh; leave it out, or choose another 'method'"},
        BadScene{
            "MisspeltInnerKey", object + "outline = { inner = { crease = false } }\n",
            "DIR/scene.toml:8:23: unknown key 'crease' in inner of outline of [[object]]; did you mean 'crease_deg'?"},
        BadScene{"BrushThatIsNotThere", object + "outline = { method = \"strokes\", brush = \"gone.png\" }\n",
                 "DIR/scene.toml:8:41: 'brush' in outline of [[object]] names a file that doesn't exist: "
                 "DIR/gone.png"},
        BadScene{"ExaggeratedUniform", object + "outline = { exaggeration = 2 }\n",
                 "DIR/scene.toml:8:28: 'exaggeration' in outline of [[object]] goes with method = \"curvature\" or "
                 "\"control\"; add "
                 "that, or leave it out"},
        BadScene{"ThicknessOfUniform", object + "outline = { thickness_part = 1 }\n",
                 "DIR/scene.toml:8:30: 'thickness_part' in outline of [[object]] goes with method = \"curvature\" or "
                 "\"control\"; add that, or leave it out"},
        BadScene{"NegativeThickness", object + "outline = { method = \"curvature\", thickness_part = -0.5 }\n",
                 "DIR/scene.toml:8:52: 'thickness_part' in outline of [[object]] must be a number from 0 to 100, found "
                 "-0.5"},
        BadScene{"WeightOfAPicture", object + "outline = { method = \"silhouette\", weight = { shade = 1 } }\n",
                 "DIR/scene.toml:8:45: 'weight' in outline of [[object]] goes with method = \"uniform\", "
                 "\"curvature\", \"control\", \"z_lines\" or \"hidden_lines\"; choose one of these, or leave it out"},
        BadScene{
            "WeightOfAMaterialTwice",
            object + "outline = { weight = { material = [{ name = \"a\", factor = 1 }, { name = \"a\", factor = "
                     "2 }] } }\n",
            "DIR/scene.toml:8:73: 'name' in material of weight of outline of [[object]] is given twice; leave one out"},
        BadScene{"UnknownSign", object + "outline = { method = \"curvature\", sign = \"thick\" }\n",
                 "DIR/scene.toml:8:42: 'sign' in outline of [[object]] must be \"magnitude\", \"convex\" or "
                 "\"concave\", found the text \"thick\""}),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    LightAndOutput, BadSceneTest,
    testing::Values(
        BadScene{"LightZero", plate + "[light]\ndirection = [0, 0, 0]\n",
                 "DIR/scene.toml:5:13: 'direction' in [light] must not be [0, 0, 0]; give the way towards the light"},
        BadScene{
            "LightNan", plate + "[light]\ndirection = [0, nan, 1]\n",
            "DIR/scene.toml:5:17: 'direction' in [light] must be three numbers from -1000000 to 1000000, found nan"},
        BadScene{"OutputIsInput", plate + "[output]\nvideo = \"a.mp4\"\n",
                 "DIR/scene.toml:5:9: 'video' in [output] is the filmed input itself; name another file"},
        BadScene{"ImagesWithoutNumber", plate + "[output]\nimages = \"b.png\"\n",
                 "DIR/scene.toml:5:10: 'images' in [output] must be a pattern of image files such as "
                 "\"frames/%04d.png\", found the text \"b.png\""},
        BadScene{"CodecForImages", plate + "[output]\nimages = \"%d.png\"\ncodec = \"ffv1\"\n",
                 "DIR/scene.toml:6:9: 'codec' in [output] goes with 'video', not with 'images'; leave it out"},
        BadScene{
            "BitRateTiny", plate + "[output]\nvideo = \"b.mp4\"\nbit_rate = 4\n",
            "DIR/scene.toml:6:12: 'bit_rate' in [output] must be a whole number from 1000 to 10000000000, found 4"},
        BadScene{
            "ContentUnknown", plate + "[output]\ncontent = \"matte\"\n",
            "DIR/scene.toml:5:11: 'content' in [output] must be \"composite\" or \"cg\", found the text \"matte\""},
        BadScene{"TwoOutputs", plate + "[output]\nvideo = \"b.mp4\"\nimages = \"%d.png\"\n",
                 "DIR/scene.toml:6:10: 'images' in [output] can't stand beside 'video'; keep one of them"}),
    test_name);

TEST(SceneErrors, NamesAFileThatIsNone) {
  const SceneFolder folder;
  std::filesystem::create_directories(folder / "sub");
  std::ofstream(folder / "binary.toml", std::ios::binary) << std::string("\x7f\x01\0\0", 4);
  std::ofstream(folder / "huge.toml") << std::string(5u << 20, '#');
  EXPECT_EQ(folder.message_for("none.toml"), "DIR/none.toml: no such file");
  EXPECT_EQ(folder.message_for("sub"), "DIR/sub: is a folder; name a file in it");
  EXPECT_EQ(folder.message_for("binary.toml"), "DIR/binary.toml: isn't a text file, so it can't be TOML");
  EXPECT_EQ(folder.message_for("huge.toml"),
            "DIR/huge.toml: is too large to be what it should be; at most 4 MiB are read");
}

TEST(SceneErrors, ReportsTheFirstUnknownKeyInTheFile) {
  const SceneFolder folder;
  EXPECT_EQ(folder.message("[plate]\nvidio = 1\nabc = 2\n[zzz]\n[aaa]\n"),
            "DIR/scene.toml:2:1: unknown key 'vidio' in [plate]; did you mean 'video'?");
}

TEST(SceneErrors, SurvivesEveryCutOfAScene) {
  const SceneFolder folder;
  const std::string whole = object + "toon = { bands = 4 }\noutline = { width_px = 2.5, colour = \"#102030\" }\n";
  for (std::size_t length = 0; length < whole.size(); ++length) folder.message(whole.substr(0, length));
  EXPECT_EQ(folder.message(whole), "");
}

TEST(Nearest, CountsEditsAndSwaps) {
  const std::vector<std::string_view> words{"outline", "toon", "height_m", "up"};
  EXPECT_EQ(toml::nearest("outlnie", words), "outline");
  EXPECT_EQ(toml::nearest("TOON", words), "toon");
  EXPECT_EQ(toml::nearest("hight", words), "height_m");
  EXPECT_EQ(toml::nearest("ups", words), "up");
  EXPECT_EQ(toml::nearest("water", words), "");
  EXPECT_EQ(toml::nearest("", words), "");
}

INSTANTIATE_TEST_SUITE_P(
    Foreground, BadSceneTest,
    testing::Values(
        BadScene{"ForegroundWithoutMethod", plate + "[[foreground]]\nname = \"x\"\n",
                 "DIR/scene.toml:4:1: 'method' in [[foreground]] is missing"},
        BadScene{"UnknownMethod", plate + "[[foreground]]\nmethod = \"magic\"\n",
                 "DIR/scene.toml:5:10: 'method' in [[foreground]] must be \"chroma\", \"difference\", \"file\" or "
                 "\"segmentation\", found the text \"magic\""},
        BadScene{"MethodTwice", plate + "[[foreground]]\nmethod = [\"chroma\", \"chroma\"]\n",
                 "DIR/scene.toml:5:10: 'method' in [[foreground]] names 'chroma' twice; leave one out"},
        BadScene{
            "TableOfAnotherMethod", plate + "[[foreground]]\nmethod = \"chroma\"\ndifference = { threshold = 3 }\n",
            "DIR/scene.toml:6:14: 'difference' in [[foreground]] isn't among the methods; leave it out, or add it to "
            "'method'"},
        BadScene{"ModelThatIsMissing",
                 plate + "[[foreground]]\nmethod = \"segmentation\"\nsegmentation = { model = \"no.onnx\" }\n",
                 "DIR/scene.toml:6:26: 'model' in segmentation of [[foreground]] names a file that doesn't exist: "
                 "DIR/no.onnx"},
        BadScene{"CombineOfOne", plate + "[[foreground]]\nmethod = \"chroma\"\ncombine = \"minimum\"\n",
                 "DIR/scene.toml:6:11: 'combine' in [[foreground]] needs several methods; leave it out"},
        BadScene{
            "NoDistanceBesideAnObject",
            tracked + "[[foreground]]\nmethod = \"chroma\"\n[[object]]\nmesh = \"cow.obj\"\n",
            "DIR/scene.toml:6:1: [[foreground]] must say how far away it is, so that CG goes before or behind it; add "
            "distance_m = METRES, or on_ground = true if it stands on the world's z = 0"},
        BadScene{
            "OnGroundWithoutCamera", plate + "[[foreground]]\nmethod = \"chroma\"\non_ground = true\n",
            "DIR/scene.toml:6:13: 'on_ground' in [[foreground]] needs to know where the camera is; add [track], and "
            "'camera' to [plate]"},
        BadScene{"RectangleOfThree", plate + "[[foreground]]\nmethod = \"chroma\"\nwithin_px = [1, 2, 3]\n",
                 "DIR/scene.toml:6:13: 'within_px' in [[foreground]] must be a rectangle [left, top, width, height] in "
                 "whole pixels, found an array of 3"},
        BadScene{"BackgroundAlone", plate + "[background]\ncolour = \"#ffffff\"\n",
                 "DIR/scene.toml:4:1: [background] needs a [[foreground]]: nothing of the plate would be left; add one "
                 "with the matte of what is to be kept"}),
    test_name);

}  // namespace
}  // namespace rinkaku::pipeline

#include "tests/pipeline/bad_scene.h"
#include "tests/pipeline/scene_folder.h"

namespace rinkaku::pipeline {
namespace {

using namespace test_scenes;

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
        BadScene{"SkinningElsewhere", object + "animation = { skinning = \"moon\" }\n",
                 "DIR/scene.toml:8:26: 'skinning' in animation of [[object]] must be \"auto\", \"cpu\" or \"gpu\", "
                 "found the text \"moon\""},
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
        BadScene{"LeanOfStrokes", object + "outline = { method = \"strokes\", lean = 1 }\n",
                 "DIR/scene.toml:8:40: 'lean' in outline of [[object]] goes with method = \"uniform\", \"curvature\", "
                 "\"control\", \"z_lines\" or \"hidden_lines\"; choose one of these, or leave it out"},
        BadScene{"NegativeLean", object + "outline = { lean = -1 }\n",
                 "DIR/scene.toml:8:20: 'lean' in outline of [[object]] must be a number from 0 to 1000, found -1"},
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

}  // namespace
}  // namespace rinkaku::pipeline

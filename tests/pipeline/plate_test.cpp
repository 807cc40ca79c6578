// The plate is sacred: what no CG touches comes out as it went in.
#include <algorithm>

#include "tests/pipeline/shot_folder.h"

namespace rinkaku::pipeline {
namespace {

using test::ShotFolder;

constexpr int clip_frames = 12;

struct PlateCase {
  const char* pixels;
  int width, height;
  ColourTags colour;
};

std::ostream& operator<<(std::ostream& out, const PlateCase& c) {
  return out << c.pixels << "_" << c.width << "x" << c.height << "_matrix" << c.colour.matrix
             << (c.colour.range == ColourTags::Range::Full ? "_full" : "_limited");
}

class PlateFormats : public testing::TestWithParam<PlateCase> {};

std::vector<PlateCase> every_format() {
  std::vector<PlateCase> cases;
  for (const char* pixels : {"yuv420p", "yuv422p", "yuv444p", "yuv420p10le"}) {
    for (const ColourTags& colour : {test::bt709_limited, test::bt709_full, test::bt601_limited, test::bt601_full}) {
      cases.push_back({pixels, 64, 48, colour});
      cases.push_back({pixels, 35, 29, colour});
    }
  }
  return cases;
}

std::string name_of(const testing::TestParamInfo<PlateCase>& info) { return testing::PrintToString(info.param); }

void expect_same_description(const source::Description& got, const source::Description& expected) {
  EXPECT_EQ(got.format, expected.format);
  EXPECT_EQ(got.time_base, expected.time_base);
  EXPECT_EQ(got.frame_rate, expected.frame_rate);
}

void expect_same_times(const std::vector<Frame>& got, const std::vector<Frame>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_EQ(got[i].number, expected[i].number);
    EXPECT_EQ(got[i].pts, expected[i].pts) << "frame " << i;
  }
}

TEST_P(PlateFormats, EmptySceneIsBitIdenticalAsAWhole) {
  const PlateCase& c = GetParam();
  const ShotFolder folder;
  folder.noise_clip("in.mkv", test::picture(c.pixels, c.width, c.height, c.colour), clip_frames);
  const RenderReport report = folder.render("[plate]\nvideo = \"in.mkv\"\n", {.output = "out.mkv", .codec = "ffv1"});
  EXPECT_EQ(report.frames, clip_frames);
  EXPECT_EQ(report.notices, std::vector<std::string>());
  const auto in = source::open(folder.file("in.mkv")), out = source::open(folder.file("out.mkv"));
  ASSERT_EQ(in->description().format.colour.matrix, c.colour.matrix);  // else the case would test another one
  ASSERT_EQ(in->description().format.colour.range, c.colour.range);
  expect_same_description(out->description(), in->description());
  const auto before = test::all_frames(*in), after = test::all_frames(*out);
  expect_same_times(after, before);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_TRUE(test::samples(after[i]) == test::samples(before[i])) << "frame " << i;
  }
}

// The least and greatest alpha of the pixels that a component's sample stands for.
std::pair<int, int> alpha_under(const Frame& layer, const PictureFormat& plate, int component, int x, int y) {
  const int across = plate.is_chroma(component) ? plate.pixels.log2_chroma_width : 0;
  const int down = plate.is_chroma(component) ? plate.pixels.log2_chroma_height : 0;
  std::pair<int, int> range{255, 0};
  for (int v = y << down; v < std::min((y + 1) << down, plate.height_px); ++v) {
    for (int u = x << across; u < std::min((x + 1) << across, plate.width_px); ++u) {
      const int alpha = test::sample(layer, 3, u, v);
      range = {std::min(range.first, alpha), std::max(range.second, alpha)};
    }
  }
  return range;
}

struct Differences {
  int outside = 0, outside_changed = 0, inside = 0, inside_changed = 0;
};

Differences differences(const Frame& before, const Frame& after, const Frame& layer) {
  Differences d;
  for (int component = 0; component < before.format.pixels.components; ++component) {
    for (int y = 0; y < before.format.component_height_px(component); ++y) {
      for (int x = 0; x < before.format.component_width_px(component); ++x) {
        const auto [least, most] = alpha_under(layer, before.format, component, x, y);
        const bool changed = test::sample(before, component, x, y) != test::sample(after, component, x, y);
        if (most == 0) {
          ++d.outside;
          d.outside_changed += changed;
        } else if (least == 255) {
          ++d.inside;
          d.inside_changed += changed;
        }
      }
    }
  }
  return d;
}

TEST_P(PlateFormats, OnlyWhatCgCoversChanges) {
  const PlateCase& c = GetParam();
  const ShotFolder folder(c.width, c.height);
  folder.noise_clip("in.mkv", test::picture(c.pixels, c.width, c.height, c.colour), clip_frames);
  const RenderReport report =
      folder.render(test::drawn_scene + "outline = true\n",
                    {.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("layers")});
  EXPECT_EQ(report.notices, std::vector<std::string>());
  const auto in = source::open(folder.file("in.mkv")), out = source::open(folder.file("out.mkv"));
  expect_same_description(out->description(), in->description());
  const auto before = test::all_frames(*in), after = test::all_frames(*out);
  const auto layers = folder.frames("layers/cg_%06d.png");
  expect_same_times(after, before);
  ASSERT_EQ(layers.size(), before.size());
  ASSERT_TRUE(layers.front().format.pixels.has_alpha);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Differences d = differences(before[i], after[i], layers[i]);
    EXPECT_EQ(d.outside_changed, 0) << "frame " << i;
    EXPECT_GT(d.outside, c.width * c.height / 2);
    EXPECT_GT(d.inside, c.width * c.height / 50);
    // By chance one sample of noise in 256 already has the CG's value; 5 % is ten times that.
    EXPECT_GT(d.inside_changed, d.inside * 0.95) << "frame " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(All, PlateFormats, testing::ValuesIn(every_format()), name_of);

// Through the lens's map as well.
TEST(Plate, IsNotResampledByALens) {
  const ShotFolder folder;
  folder.write("camera.yml", ShotFolder::camera_text(64, 48, "-0.3, 0.1, 0.001, -0.002, 0"));
  folder.noise_clip("in.mkv", test::picture("yuv420p", 64, 48, test::bt709_limited), 3);
  const std::string scene = test::drawn_scene;
  folder.render(scene, {.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("layers")});
  const auto before = folder.frames("in.mkv"), after = folder.frames("out.mkv");
  const auto layers = folder.frames("layers/cg_%06d.png");
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Differences d = differences(before[i], after[i], layers[i]);
    EXPECT_EQ(d.outside_changed, 0);
    EXPECT_GT(d.inside_changed, 0);
  }
}

TEST(Plate, KeepsUnevenTimesAndNumbers) {
  const ShotFolder folder;
  const PictureFormat format = test::picture("yuv420p", 64, 48, test::bt709_limited);
  sink::Incoming coming = test::incoming(format);
  coming.time_base = {1, 1000};
  coming.variable_frame_rate = true;
  auto frames = test::noise_frames(format, 6);
  const std::int64_t times_ms[] = {0, 33, 40, 250, 251, 1900};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].time_base = {1, 1000};
    frames[i].pts = times_ms[i];
    frames[i].duration = 0;
  }
  test::write_all({.path = folder.file("in.mkv"), .codec = "ffv1"}, coming, frames);
  folder.render(test::drawn_scene, {.output = "out.mkv", .codec = "ffv1"});
  const auto after = folder.frames("out.mkv");
  expect_same_times(after, folder.frames("in.mkv"));
  ASSERT_EQ(after.size(), 6u);
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_NEAR(after[i].time_s(), static_cast<double>(times_ms[i]) / 1000, 1e-9);
  }
}

TEST(Plate, SoundIsCopiedBitForBit) {
  const ShotFolder folder;
  test::ffmpeg("-f lavfi -i testsrc2=s=64x48:r=25 -f lavfi -i sine=f=300 -t 2 -pix_fmt yuv420p -c:v ffv1 -c:a aac '" +
               folder.file("in.mkv") + "'");
  const auto sound = [&folder](const char* name) {
    return test::shell("ffmpeg -nostdin -v error -i '" + folder.file(name) + "' -map 0:a -c copy -f framehash -");
  };
  folder.render(test::drawn_scene, {.output = "out.mkv", .codec = "ffv1"});
  EXPECT_GT(sound("in.mkv").size(), 1000u);
  EXPECT_EQ(sound("out.mkv"), sound("in.mkv"));
}

TEST(Plate, PartOfTheFramesGetsItsPartOfTheSound) {
  const ShotFolder folder;
  test::ffmpeg(
      "-f lavfi -i testsrc2=s=64x48:r=25 -f lavfi -i sine=f=300 -t 2 -pix_fmt yuv420p -c:v ffv1 "
      "-c:a pcm_s16le '" +
      folder.file("in.mkv") + "'");
  folder.render(test::plate, {.output = "out.mkv", .codec = "ffv1", .first_frame = 10, .end_frame = 20});
  const auto in = folder.frames("in.mkv"), out = folder.frames("out.mkv");
  ASSERT_EQ(out.size(), 10u);
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_TRUE(test::samples(out[i]) == test::samples(in[i + 10]));
  EXPECT_EQ(out.front().pts, 0);
  const double seconds =
      std::stod(test::ffprobe("-select_streams a -show_entries format=duration", folder.file("out.mkv")));
  EXPECT_NEAR(seconds, 0.4, 0.03);  // sound is cut between its packets, which last 23 ms here
}

}  // namespace
}  // namespace rinkaku::pipeline

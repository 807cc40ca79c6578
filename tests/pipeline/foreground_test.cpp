// CG before and behind what was filmed: the whole way of a frame, with mattes.
#include <algorithm>
#include <set>

#include "pipeline/matte/count.h"
#include "tests/pipeline/shot_folder.h"

namespace rinkaku::pipeline {
namespace {

using test::ShotFolder;

const PictureFormat small = test::picture("yuv420p", 64, 48, test::bt709_limited);
const PictureFormat grey = test::picture("gray", 64, 48, test::bt709_full);

// Mattes of a bar 16 pixels wide in the middle of the picture, `alpha` everywhere in it.
std::vector<Frame> bars(int count, int alpha, int bottom = 48) {
  std::vector<Frame> frames = test::noise_frames(grey, count);
  for (Frame& frame : frames) {
    for (int y = 0; y < 48; ++y) {
      std::uint8_t* row = frame.planes[0].data + y * frame.planes[0].stride_bytes;
      std::fill_n(row, 64, std::uint8_t{0});
      if (y < bottom) std::fill_n(row + 24, 16, static_cast<std::uint8_t>(alpha));
    }
  }
  return frames;
}

void write_mattes(const ShotFolder& folder, const std::vector<Frame>& frames) {
  test::write_all({.path = folder.file("mattes.mkv"), .codec = "ffv1"}, test::incoming(grey), frames);
}

std::string filmed(const std::string& where) {
  return "[[foreground]]\nname = \"bar\"\nmethod = \"file\"\nfile = { video = \"mattes.mkv\" }\n" + where + "\n";
}

// A cube of 0.5 m, 1.5 m before the camera and filling most of the picture, seen along the world's y.
const std::string camera = "[track]\nlocked = { position_m = [0, -1.5, 0.25], look_at_m = [0, 0, 0.25] }\n";

// Which luma samples two frames differ in.
std::set<std::pair<int, int>> changed(const Frame& a, const Frame& b) {
  std::set<std::pair<int, int>> pixels;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (test::sample(a, 0, x, y) != test::sample(b, 0, x, y)) pixels.insert({x, y});
    }
  }
  return pixels;
}

bool in_bar(int x) { return x >= 24 && x < 40; }

TEST(FilmedThings, CgGoesBehindWhatIsNearerAndBeforeWhatIsFarther) {
  const ShotFolder folder;
  const auto plate = folder.noise_clip("in.mkv", small, 3);
  write_mattes(folder, bars(3, 255));
  const auto rendered = [&](const std::string& foreground) {
    folder.render(test::plate + camera + foreground + test::cube,
                  {.output = "out.mkv", .codec = "ffv1", .overwrite = true});
    return folder.frames("out.mkv");
  };
  const auto without = rendered(""), before = rendered(filmed("distance_m = 1")),
             behind = rendered(filmed("distance_m = 3"));
  int in_it = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(test::samples(behind[i]), test::samples(without[i]));
    // The bar's own samples are the plate's to the last bit, chroma too; the rest is as without it.
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const Frame& wish = in_bar(x) ? plate[i] : without[i];
        ASSERT_EQ(test::sample(before[i], 0, x, y), test::sample(wish, 0, x, y)) << x << "," << y;
        ASSERT_EQ(test::sample(before[i], 1, x / 2, y / 2), test::sample(wish, 1, x / 2, y / 2)) << x << "," << y;
        in_it += in_bar(x) && test::sample(without[i], 0, x, y) != test::sample(plate[i], 0, x, y) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(in_it, 500);  // the cube does go behind the bar
}

// Plate and matte of one frame travel together: a bar that jumps every frame.
TEST(FilmedThings, MatteIsThatOfItsVeryFrame) {
  const ShotFolder folder;
  const auto plate = folder.noise_clip("in.mkv", small, 12);
  std::vector<Frame> mattes = bars(12, 0);
  for (std::size_t i = 0; i < mattes.size(); ++i) {
    std::uint8_t* data = mattes[i].planes[0].data;
    for (int y = 0; y < 48; ++y) {
      std::fill_n(data + y * mattes[i].planes[0].stride_bytes + 4 * static_cast<int>(i), 16, std::uint8_t{255});
    }
  }
  write_mattes(folder, mattes);
  folder.render(test::plate + camera + filmed("distance_m = 1") + test::cube,
                {.output = "out.mkv", .codec = "ffv1", .first_frame = 3});
  const auto out = folder.frames("out.mkv");
  ASSERT_EQ(out.size(), 9u);
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (const auto& [x, y] : changed(out[i], plate[i + 3])) {
      const int left = 4 * (static_cast<int>(i) + 3);
      ASSERT_FALSE(x >= left && x < left + 16) << "frame " << i + 3 << " " << x << "," << y;
    }
    EXPECT_GT(changed(out[i], plate[i + 3]).size(), 200u);
  }
}

// Somebody walks towards the camera past a thin card of CG, standing on the ground: behind it until the feet pass it.
TEST(FilmedThings, OrderFlipsOnceWhenSomebodyWalksFromBehindToBefore) {
  const ShotFolder folder;
  constexpr int frames = 24;
  const auto plate = folder.noise_clip("in.mkv", small, frames);
  // The camera is 0.25 m above the ground and looks straight ahead: a foot at depth d is seen 64 * 0.25 / d below the
  // picture's middle. The lower edge of the bar moves from row 30 down to 41.5: from 2.46 m to 0.89 m.
  std::vector<Frame> mattes = bars(frames, 0);
  std::vector<double> depth_m;
  for (int i = 0; i < frames; ++i) {
    const int bottom = 30 + i / 2;
    mattes[static_cast<std::size_t>(i)] = std::move(bars(1, 255, bottom)[0]);
    mattes[static_cast<std::size_t>(i)].number = mattes[static_cast<std::size_t>(i)].pts = i;
    depth_m.push_back(64 * 0.25 / (bottom - 0.5 - 23.5));
  }
  write_mattes(folder, mattes);
  // A card 1.5 m before the camera.
  folder.write("card.obj", "v -1 0 0\nv 1 0 0\nv 1 0 1\nv -1 0 1\nf 1 2 3 4\n");
  const std::string card = "[[object]]\nmesh = \"card.obj\"\nup = \"z\"\nscale = 1\n";
  folder.render(test::plate + camera + filmed("on_ground = true") + card, {.output = "out.mkv", .codec = "ffv1"});
  const auto out = folder.frames("out.mkv");
  int flips = 0;
  bool was_before = false;
  for (int i = 0; i < frames; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const bool is_before = test::sample(out[index], 0, 32, 24) == test::sample(plate[index], 0, 32, 24) &&
                           test::sample(out[index], 0, 33, 25) == test::sample(plate[index], 0, 33, 25);
    if (i > 0 && is_before != was_before) ++flips;
    was_before = is_before;
    // Rows are whole, so the distance is known to a row only: in its two frames either order is right.
    if (std::abs(depth_m[index] - 1.5) < 0.2) continue;
    EXPECT_EQ(is_before, depth_m[index] < 1.5) << "frame " << i << " at " << depth_m[index];
  }
  EXPECT_EQ(flips, 1);
}

// Where the matte is 0 the world is seen, where it is 255 the plate's own samples, untouched.
// Nothing of the water may show where a thing before it is opaque, and the rest of the water stays as it is.
TEST(FilmedThings, WaterBehindThemLeavesThemUntouched) {
  const ShotFolder folder;
  const auto plate = folder.noise_clip("in.mkv", small, 4);
  write_mattes(folder, bars(4, 255));
  const std::string water =
      "[water]\nstrokes = 800\n[[water.surface]]\noutline_m = [[-3, -1, 0], [3, -1, 0], [3, 3, 0], [-3, 3, 0]]\n"
      "[[water.surface.arrow]]\nfrom_m = [0, 0, 0]\nto_m = [0.5, 0, 0]\n"
      "[[water.spray]]\nfrom_m = [-1, 0, 0]\nto_m = [1, 0, 0]\nheight_m = 0.2\n";
  const auto rendered = [&](const std::string& foreground) {
    folder.render(test::plate + camera + foreground + water, {.output = "out.mkv", .codec = "ffv1", .overwrite = true});
    return folder.frames("out.mkv");
  };
  const auto without = rendered(""), before = rendered(filmed("distance_m = 0.2"));
  int in_it = 0;
  for (std::size_t i = 0; i < plate.size(); ++i) {
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const Frame& wish = in_bar(x) ? plate[i] : without[i];
        ASSERT_EQ(test::sample(before[i], 0, x, y), test::sample(wish, 0, x, y)) << x << "," << y;
        ASSERT_EQ(test::sample(before[i], 1, x / 2, y / 2), test::sample(wish, 1, x / 2, y / 2)) << x << "," << y;
        in_it += in_bar(x) && test::sample(without[i], 0, x, y) != test::sample(plate[i], 0, x, y) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(in_it, 4 * 16 * 10);  // there is water behind the bar, in half its height
}

// Fluff behind a soft edge is mixed by the matte: no line along the edge that is neither the plate nor the fluff.
TEST(FilmedThings, CutFluffSoftly) {
  const ShotFolder folder;
  // Grey all over, so that what is filmed in the soft edge has the background's colour and nothing need be guessed.
  std::vector<Frame> plate = test::noise_frames(small, 2);
  for (Frame& frame : plate) {
    for (int p = 0; p < 3; ++p) {
      for (int y = 0; y < (p == 0 ? 48 : 24); ++y) {
        std::fill_n(frame.planes[p].data + y * frame.planes[p].stride_bytes, p == 0 ? 64 : 32,
                    static_cast<std::uint8_t>(p == 0 ? 140 : 128));
      }
    }
  }
  test::write_all({.path = folder.file("in.mkv"), .codec = "ffv1"}, test::incoming(small), plate);
  std::vector<Frame> mattes = bars(2, 255);
  const auto alpha_of = [](int x) { return std::clamp((40 - x) * 16, 0, 255); };  // to nothing over 16 pixels
  for (Frame& frame : mattes) {
    for (int y = 0; y < 48; ++y) {
      std::uint8_t* row = frame.planes[0].data + y * frame.planes[0].stride_bytes;
      for (int x = 0; x < 64; ++x) row[x] = static_cast<std::uint8_t>(alpha_of(x));
    }
  }
  write_mattes(folder, mattes);
  const auto rendered = [&](const std::string& foreground, const std::string& look) {
    folder.render(test::plate + camera + foreground + test::cube + look,
                  {.output = "out.mkv", .codec = "ffv1", .overwrite = true});
    return folder.frames("out.mkv");
  };
  const std::string fluff = "outline = true\nfluffy = { scale = 1.5 }\n";
  const auto bare = rendered("", ""), without = rendered("", fluff), cut = rendered(filmed("distance_m = 1"), fluff),
             far = rendered(filmed("distance_m = 3"), fluff);
  int soft = 0;
  for (std::size_t i = 0; i < plate.size(); ++i) {
    EXPECT_EQ(test::samples(far[i]), test::samples(without[i]));  // fluff before them is not cut at all
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const double alpha = alpha_of(x) / 255.0;
        const int in = test::sample(plate[i], 0, x, y), covered = test::sample(without[i], 0, x, y);
        // The layer, cut, and the sum are each rounded to 8 bits: a step for both and one for their way to luma.
        ASSERT_NEAR(test::sample(cut[i], 0, x, y), alpha * in + (1 - alpha) * covered, 2) << x << "," << y;
        soft += alpha > 0 && alpha < 1 && covered != test::sample(bare[i], 0, x, y) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(soft, 100);  // there is fluff in the soft edge
}

TEST(FilmedThings, StandInAWorldInThePlatesPlace) {
  const ShotFolder folder;
  const auto plate = folder.noise_clip("in.mkv", small, 2);
  write_mattes(folder, bars(2, 255));
  folder.render("[plate]\nvideo = \"in.mkv\"\n[background]\ncolour = \"#808080\"\n" + filmed(""),
                {.output = "out.mkv", .codec = "ffv1"});
  const auto out = folder.frames("out.mkv");
  for (std::size_t i = 0; i < 2; ++i) {
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        // Grey of 128 in limited range: 16 + 219 * 128 / 255.
        ASSERT_EQ(test::sample(out[i], 0, x, y), in_bar(x) ? test::sample(plate[i], 0, x, y) : 126) << x << "," << y;
        ASSERT_EQ(test::sample(out[i], 1, x / 2, y / 2), in_bar(x) ? test::sample(plate[i], 1, x / 2, y / 2) : 128);
      }
    }
  }
}

TEST(FilmedThings, LayersAreWrittenEachByItself) {
  const ShotFolder folder;
  const auto plate = folder.noise_clip("in.mkv", small, 2);
  write_mattes(folder, bars(2, 200));
  folder.render(test::plate + camera + filmed("distance_m = 1") + test::cube,
                {.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("layers")});
  const auto mattes = folder.frames("layers/matte_bar_%06d.png");
  ASSERT_EQ(mattes.size(), 2u);
  EXPECT_EQ(test::sample(mattes[1], 0, 30, 20), 200);
  EXPECT_EQ(test::sample(mattes[1], 0, 10, 20), 0);
  EXPECT_EQ(folder.frames("layers/plate_%06d.png").size(), 2u);
  // The whole cube lies behind the bar and is not cut.
  EXPECT_EQ(test::sample(folder.frames("layers/cg-0_%06d.png")[0], 3, 32, 24), 0);
  EXPECT_EQ(test::sample(folder.frames("layers/cg-1_%06d.png")[0], 3, 32, 24), 255);
}

TEST(FilmedThings, NothingRunsInASceneWithoutThem) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 2);
  const RenderReport report = folder.render(test::plate + camera + test::cube, {.output = "out.mkv", .codec = "ffv1"});
  for (const StageReport& stage : report.stages) {
    EXPECT_NE(stage.name, "matte");
    EXPECT_NE(stage.name, "merge");
  }
}

TEST(FilmedThings, NothingOfThemIsMadeInASceneWithoutThem) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 2);
  write_mattes(folder, bars(2, 255));
  const auto made_by = [&](const std::string& scene) {
    const matte::Made before = matte::made();
    folder.render(scene, {.output = "out.mkv", .codec = "ffv1", .overwrite = true});
    const matte::Made after = matte::made();
    return matte::Made{after.things - before.things, after.networks - before.networks, after.mattes - before.mattes};
  };
  EXPECT_EQ(made_by(test::plate + camera + test::cube), matte::Made{});
  EXPECT_EQ(made_by(test::plate), matte::Made{});
  // Nor where nothing would read their mattes.
  EXPECT_EQ(made_by(test::plate + filmed("distance_m = 1")), matte::Made{});
  EXPECT_EQ(made_by(test::plate + camera + filmed("distance_m = 1") + test::cube), (matte::Made{1, 0, 2}));
}

// Red, 3 pixels wide, about the bar.
const std::string red_line = "outline = { width_px = 3, colour = \"#ff0000\" }\n";

TEST(FilmedThings, LineAroundThemNeedsNoCgAndLeavesTheRestOfThePlate) {
  const ShotFolder folder;
  const auto plate = folder.noise_clip("in.mkv", small, 2);
  write_mattes(folder, bars(2, 255));
  folder.render(test::plate + filmed(red_line), {.output = "out.mkv", .codec = "ffv1"});
  const auto out = folder.frames("out.mkv");
  for (std::size_t i = 0; i < 2; ++i) {
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const int luma = test::sample(out[i], 0, x, y);
        // Red by BT.709 in limited range: 16 + 219 * 0.2126.
        if (x == 22 || x == 41) {
          ASSERT_NEAR(luma, 63, 1) << x << "," << y;
        }
        if (in_bar(x) || x < 20 || x >= 44) {
          ASSERT_EQ(luma, test::sample(plate[i], 0, x, y)) << x << "," << y;
        }
      }
    }
  }
}

TEST(FilmedThings, LineAroundThemLiesAtTheirDepth) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 1);
  write_mattes(folder, bars(1, 255));
  const auto rendered = [&](const std::string& foreground) {
    folder.render(test::plate + camera + foreground + test::cube,
                  {.output = "out.mkv", .codec = "ffv1", .overwrite = true});
    return std::move(folder.frames("out.mkv").at(0));
  };
  // The cube fills the middle of the picture.
  const Frame without = rendered(""), before = rendered(filmed("distance_m = 1\n" + red_line)),
              behind = rendered(filmed("distance_m = 3\n" + red_line));
  EXPECT_NEAR(test::sample(before, 0, 22, 24), 63, 1);
  EXPECT_EQ(test::sample(behind, 0, 22, 24), test::sample(without, 0, 22, 24));
}

TEST(FilmedThings, MattesThatEndTooSoonEndTheRun) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 5);
  write_mattes(folder, bars(3, 255));
  const std::string line = test::error_of(Error::Kind::Input, [&] {
    folder.render(test::plate + camera + filmed("distance_m = 1") + test::cube, {.output = "out.mkv", .codec = "ffv1"});
  });
  EXPECT_NE(line.find("end before frame 3"), std::string::npos) << line;
  EXPECT_FALSE(std::filesystem::exists(folder.file("out.mkv")));
}

}  // namespace
}  // namespace rinkaku::pipeline

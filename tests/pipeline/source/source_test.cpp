#include "pipeline/source/source.h"

#include <cstring>
#include <sstream>

#include "tests/pipeline/source/media_tools.h"
#include "tests/support/test_data.h"

namespace rinkaku {
namespace {

struct Clip {
  const char* file;
  Rational rate;
};

class RealClip : public testing::TestWithParam<Clip> {};

// Frames, times and samples are those that the ffmpeg programs find.
TEST_P(RealClip, DecodesAsFfmpegDoes) {
  RINKAKU_NEEDS_DATA();
  const std::string path = test::data(GetParam().file).string();
  auto source = source::open(path);
  EXPECT_EQ(source->description().frame_rate, GetParam().rate);
  const auto frames = test::all_frames(*source);
  const std::string count = test::ffprobe("-select_streams v -count_frames -show_entries stream=nb_read_frames", path);
  EXPECT_EQ(frames.size(), std::stoul(count));
  // Side data leaves empty fields and lines.
  std::istringstream times(test::ffprobe("-select_streams v -show_entries frame=best_effort_timestamp", path));
  std::size_t i = 0;
  for (std::string line; std::getline(times, line);) {
    if (line.empty()) continue;
    ASSERT_LT(i, frames.size());
    EXPECT_EQ(frames[i].pts, std::stoll(line)) << i;
    ++i;
  }
  EXPECT_EQ(i, frames.size());
  std::string got;
  for (std::size_t k = 0; k < 30; ++k) got += test::samples(frames[k]);
  EXPECT_TRUE(test::decoded_by_ffmpeg(path, "-frames:v 30") == got);
  EXPECT_EQ(source->damage(), "");
  EXPECT_FALSE(source->next().has_value());
}
INSTANTIATE_TEST_SUITE_P(Clips, RealClip,
                         testing::Values(Clip{"recordings/clips/bgslibrary_video.avi", {30, 1}},
                                         Clip{"recordings/clips/mdn_chromakey_person.mp4", {60000, 1001}},
                                         Clip{"recordings/clips/opencv_cup.mp4", {26777, 1000}},
                                         Clip{"recordings/clips/opencv_tree.avi", {1000000, 66667}},
                                         Clip{"recordings/aruco_single/video.avi", {2966, 595}}));

TEST(VideoSource, FrameIsTheDecodersOwnMemory) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "a.mp4";
  test::ffmpeg("-f lavfi -i testsrc2=size=64x48:rate=25 -t 1 -c:v mpeg4 " + path);
  std::optional<Frame> kept;
  std::string before;
  {
    auto source = source::open(path);
    kept = source->next();
    before = test::samples(*kept);
    test::all_frames(*source);
  }
  // A frame outlives its source and is not drawn over by later ones.
  EXPECT_EQ(test::samples(*kept), before);
}

// Every codec, odd sizes and layouts that differ, as ffmpeg decodes them.
TEST(VideoSource, LargePicturesAreWhatFfmpegDecodes) {
  const test::TemporaryFolder folder;
  const std::pair<const char*, const char*> kinds[] = {{"mpeg4 -bf 2", "yuv420p"},
                                                       {"libx264 -preset ultrafast -bf 2", "yuv420p10le"},
                                                       {"libx264 -preset ultrafast", "yuv444p"},
                                                       {"ffv1", "yuv422p"},
                                                       {"mjpeg", "yuvj422p"},
                                                       {"ffvhuff", "rgb24"},
                                                       {"rawvideo", "uyvy422"},
                                                       {"png", "rgba"}};
  for (const auto& [codec, pixels] : kinds) {
    for (const char* size : {"1920x1080", "1283x919"}) {
      const std::string path = folder / "a.nut";
      test::ffmpeg(std::string("-f lavfi -i testsrc2=size=") + size + ":rate=25 -frames:v 6 -pix_fmt " + pixels +
                   " -strict -1 -c:v " + codec + " '" + path + "'");
      const auto source = source::open(path);
      std::string got;
      std::vector<Frame> kept;  // none is written over by a later one
      while (std::optional<Frame> frame = source->next()) kept.push_back(std::move(*frame));
      for (const Frame& frame : kept) got += test::samples(frame);
      EXPECT_TRUE(test::decoded_by_ffmpeg(path) == got) << codec << " " << pixels << " " << size;
      EXPECT_EQ(source->damage(), "");
    }
  }
}

// Writing into frames at once must not reach what the decoder predicts from, whether or not it still holds them.
TEST(VideoSource, FramesMadeWritableAreNotWhatLaterOnesArePredictedFrom) {
  const test::TemporaryFolder folder;
  for (const std::string codec : {"mpeg4 -g 250", "mpeg4 -bf 2", "libx264 -bf 3", "ffv1", "mjpeg", "rawvideo", "gif"}) {
    const std::string path = folder / (codec == "gif" ? "a.gif" : codec == "rawvideo" ? "a.avi" : "a.mkv");
    std::filesystem::remove(path);
    test::ffmpeg("-f lavfi -i testsrc2=size=64x48:rate=25 -t 1 -c:v " + codec + " " + path);
    for (const int threads : {1, 3}) {
      const auto untouched = source::open(path, {.threads = threads}),
                 written = source::open(path, {.threads = threads});
      FramePool pool;
      int frames = 0;
      while (std::optional<Frame> expected = untouched->next()) {
        std::optional<Frame> frame = written->next();
        ASSERT_TRUE(frame);
        ASSERT_EQ(test::samples(*frame), test::samples(*expected)) << codec << ", frame " << frames;
        pool.make_writable(*frame);
        for (const Plane& plane : frame->planes) {
          for (int y = 0; y < plane.rows; ++y) std::memset(plane.data + y * plane.stride_bytes, 77, plane.row_bytes);
        }
        ++frames;
      }
      EXPECT_EQ(frames, 25) << codec;
    }
  }
}

TEST(VideoSource, FrameThatTheDecoderLetGoIsWrittenWithoutACopy) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "a.mp4";
  test::ffmpeg("-f lavfi -i testsrc2=size=64x48:rate=25 -t 1 -c:v mpeg4 " + path);
  auto source = source::open(path, {.threads = 1});
  std::optional<Frame> first = source->next();
  std::optional<Frame> second = source->next();
  FramePool pool;
  const std::uint8_t* stored = second->planes[0].data;
  pool.make_writable(*second);
  EXPECT_NE(second->planes[0].data, stored) << "the third picture is predicted from it";
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(source->next());
  stored = first->planes[0].data;
  pool.make_writable(*first);
  EXPECT_EQ(first->planes[0].data, stored);
  // But never one that a copy shares.
  const Frame copy = *first;
  pool.make_writable(*first);
  EXPECT_NE(first->planes[0].data, copy.planes[0].data);
}

// Sizes that change within a stream while earlier frames are held.
TEST(VideoSource, SizesMayChangeWhileFramesAreHeld) {
  const test::TemporaryFolder folder;
  std::string parts;
  for (const char* size : {"1280x960", "64x48", "1920x1080", "1280x960"}) {
    const std::string part = folder / (std::string(size) + ".m4v");
    test::ffmpeg(std::string("-f lavfi -i testsrc2=size=") + size + ":rate=25 -frames:v 5 -c:v mpeg4 -f m4v '" + part +
                 "'");
    parts += " '" + part + "'";
  }
  test::shell("cat" + parts + " >'" + (folder / "a.m4v").string() + "'");
  const auto source = source::open(folder / "a.m4v");
  const auto frames = test::all_frames(*source);
  EXPECT_EQ(frames.size(), 20u);
  for (const Frame& frame : frames) EXPECT_EQ(frame.format.width_px, 1280);
  EXPECT_EQ(test::samples(frames[1]), test::samples(frames[16])) << "the same second picture";
}

TEST(VideoSource, TellsColourAspectAndInterlacing) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "a.mkv";
  test::ffmpeg(
      "-f lavfi -i testsrc2=size=64x48:rate=25 -t 0.2 -vf setsar=16/11,setfield=tff -c:v ffv1 -pix_fmt yuv420p "
      "-color_primaries smpte170m -color_trc bt709 -colorspace bt709 -color_range pc "
      "-chroma_sample_location topleft -field_order tt " +
      path);
  auto source = source::open(path);
  const PictureFormat& format = source->description().format;
  EXPECT_EQ(format.colour.primaries, 6);
  EXPECT_EQ(format.colour.transfer, 1);
  EXPECT_EQ(format.colour.matrix, 1);
  EXPECT_EQ(format.colour.range, ColourTags::Range::Full);
  EXPECT_EQ(format.sample_aspect, (Rational{16, 11}));
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->interlaced);
  EXPECT_TRUE(frame->top_field_first);
  EXPECT_EQ(frame->format, format);
}

TEST(VideoSource, JpegRangeIsFull) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "a.avi";
  test::ffmpeg("-f lavfi -i testsrc2=size=64x48:rate=25 -t 0.2 -c:v mjpeg -pix_fmt yuvj420p " + path);
  auto source = source::open(path);
  EXPECT_EQ(source->description().format.pixels.name, "yuv420p");
  EXPECT_EQ(source->description().format.colour.range, ColourTags::Range::Full);
  EXPECT_EQ(test::samples(*source->next()), test::decoded_by_ffmpeg(path, "-frames:v 1 -pix_fmt yuvj420p"));
}

TEST(VideoSource, TellsVariableRates) {
  const test::TemporaryFolder folder;
  const std::string even = "-f lavfi -i testsrc2=size=64x48:rate=30000/1001 -t 2 -c:v mpeg4 ";
  // Every third frame is dropped after the first second.
  const std::string uneven =
      "-f lavfi -i testsrc2=size=64x48:rate=30 -t 3 -vf \"select='lt(t,1)+mod(n,3)'\" "
      "-vsync vfr -c:v mpeg4 ";
  for (const char* ending : {"mp4", "mkv"}) {
    const std::string a = folder / (std::string("even.") + ending), b = folder / (std::string("uneven.") + ending);
    test::ffmpeg(even + a);
    test::ffmpeg(uneven + b);
    EXPECT_FALSE(source::open(a)->description().variable_frame_rate) << a;
    // Matroska has no index of all frames and claims the rate of its beginning.
    if (std::string(ending) == "mkv") continue;
    EXPECT_TRUE(source::open(b)->description().variable_frame_rate) << b;
  }
}

TEST(VideoSource, StreamWithoutTimesGetsRisingOnes) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "a.m4v";
  test::ffmpeg("-f lavfi -i testsrc2=size=64x48:rate=25 -t 1 -c:v mpeg4 -bf 2 -f m4v " + path);
  auto source = source::open(path);
  const auto frames = test::all_frames(*source);
  ASSERT_EQ(frames.size(), 25u);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_NEAR(frames[i].time_s() - frames[i - 1].time_s(), 0.04, 1e-3) << i;
  }
}

TEST(VideoSource, ChangeOfSizeInTheStreamIsConvertedAndSaid) {
  const test::TemporaryFolder folder;
  const std::string a = folder / "a.ts", b = folder / "b.ts", both = folder / "both.ts";
  test::ffmpeg("-f lavfi -i testsrc2=size=64x48:rate=25 -t 0.4 -c:v mpeg2video " + a);
  test::ffmpeg("-f lavfi -i testsrc2=size=96x80:rate=25 -t 0.4 -c:v mpeg2video " + b);
  test::shell("cat " + a + " " + b + " > " + both);
  auto source = source::open(both);
  const auto frames = test::all_frames(*source);
  EXPECT_GT(frames.size(), 17u);
  for (const Frame& frame : frames) {
    EXPECT_EQ(frame.format.width_px, 64);
    EXPECT_EQ(frame.planes[0].rows, 48);
  }
  EXPECT_NE(source->damage().find("another size"), std::string::npos);
}

TEST(Source, TellsTheFirstFramesTime) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "a.ts";
  test::ffmpeg("-f lavfi -i testsrc2=s=64x48:r=25 -frames:v 3 -c:v mpeg2video '" + path + "'");
  auto source = source::open(path);
  EXPECT_GT(source->description().first_pts, 0);
  EXPECT_EQ(source->description().first_pts, source->next()->pts);
}

}  // namespace
}  // namespace rinkaku

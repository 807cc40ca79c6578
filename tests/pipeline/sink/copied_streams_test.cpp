#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <sstream>

#include "tests/pipeline/sink/sink_tools.h"

namespace rinkaku {
namespace {

// The md5 of a kind of packets, untouched.
std::string packets_md5(const std::string& path, const std::string& kind) {
  return test::shell("ffmpeg -nostdin -v error -i '" + path + "' -map 0:" + kind + " -c copy -f md5 -");
}

// The hash of each packet of sound.
std::vector<std::string> packet_hashes(const std::string& path) {
  std::istringstream list(test::shell("ffmpeg -nostdin -v error -i '" + path +
                                      "' -map 0:a -c copy -f framemd5 - | grep -v '^#' | cut -d, -f6"));
  std::vector<std::string> hashes;
  for (std::string line; std::getline(list, line);) hashes.push_back(line);
  return hashes;
}

// Two seconds of pictures, sound from 0.3 s on, subtitles, chapters and tags.
std::string make_rich(const test::TemporaryFolder& folder, const std::string& sound = "flac") {
  const std::string subtitles = folder / "s.srt", chapters = folder / "c.txt", out = folder / "rich.mkv";
  test::shell("printf '1\\n00:00:00,500 --> 00:00:01,500\\nhello\\n\\n' > " + subtitles);
  test::shell(
      "printf ';FFMETADATA1\\ntitle=A walk\\n[CHAPTER]\\nTIMEBASE=1/1000\\nSTART=0\\nEND=1000\\ntitle=one\\n"
      "[CHAPTER]\\nTIMEBASE=1/1000\\nSTART=1000\\nEND=2000\\ntitle=two\\n' > " +
      chapters);
  test::ffmpeg("-f lavfi -i testsrc2=size=64x48:rate=25 -itsoffset 0.3 -f lavfi -i sine=440 -i " + subtitles + " -i " +
               chapters + " -map 0 -map 1 -map 2 -map_metadata 3 -map_chapters 3 -t 2 -c:v mpeg4 -c:s srt -c:a " +
               sound +
               " "
               "-metadata:s:a language=fra " +
               out);
  return out;
}

TEST(CopiedStreams, SoundSubtitlesChaptersAndTagsArrive) {
  const test::TemporaryFolder folder;
  const std::string from = make_rich(folder), to = folder / "out.mkv";
  EXPECT_EQ(test::transcode(from, {.path = to, .codec = "ffv1"}), "");
  EXPECT_EQ(packets_md5(to, "a"), packets_md5(from, "a"));
  EXPECT_EQ(packets_md5(to, "s"), packets_md5(from, "s"));
  for (const char* what :
       {"-show_entries chapter=start,end:chapter_tags=title -show_chapters", "-show_entries stream_tags=language",
        "-show_entries format_tags=title", "-select_streams a -show_entries packet=pts",
        "-select_streams s -show_entries packet=pts", "-select_streams v -show_entries packet=pts"}) {
    EXPECT_EQ(test::ffprobe(what, to), test::ffprobe(what, from)) << what;
  }
}

TEST(CopiedStreams, WhatTheContainerRefusesIsLeftOutAndSaid) {
  const test::TemporaryFolder folder;
  const std::string from = make_rich(folder, "aac"), to = folder / "out.mp4";
  const std::string notice = test::transcode(from, {.path = to, .codec = "mpeg4"});
  EXPECT_NE(notice.find("stream 2 (subtitle, subrip) is not copied"), std::string::npos) << notice;
  EXPECT_EQ(packets_md5(to, "a"), packets_md5(from, "a"));
}

class RealSound : public testing::TestWithParam<const char*> {};

TEST_P(RealSound, IsBitIdenticalAndInStep) {
  RINKAKU_NEEDS_DATA();
  for (const char* clip : {"bgslibrary_video.avi", "mdn_chromakey_person.mp4", "opencv_cup.mp4"}) {
    const test::TemporaryFolder folder;
    const std::string from = test::data(std::string("recordings/clips/") + clip).string(), to = folder / GetParam();
    test::transcode(from, {.path = to, .codec = "mpeg4"});
    const auto before = packet_hashes(from), after = packet_hashes(to);
    const std::size_t dropped = before.size() - after.size();
    // AVI can't hold the two packets of priming that this one has before 0.
    const bool primed = std::string(clip) == "mdn_chromakey_person.mp4" && std::string(GetParam()) == "a.avi";
    ASSERT_EQ(dropped, primed ? 2u : 0u) << clip;
    EXPECT_TRUE(std::equal(after.begin(), after.end(), before.begin() + static_cast<std::ptrdiff_t>(dropped))) << clip;
    const auto start = [](const std::string& file, const char* kind, std::size_t packet) {
      std::istringstream times(
          test::ffprobe(std::string("-select_streams ") + kind + " -show_entries packet=pts_time", file));
      double time = 0;
      for (std::size_t i = 0; i <= packet; ++i) {
        std::string line;
        times >> line;
        time = std::stod(line);
      }
      return time;
    };
    // The unit of a container rounds by up to a millisecond each.
    EXPECT_NEAR(start(to, "a", 0) - start(to, "v", 0), start(from, "a", dropped) - start(from, "v", 0), 2e-3) << clip;
  }
}
INSTANTIATE_TEST_SUITE_P(Containers, RealSound, testing::Values("a.mkv", "a.mp4", "a.avi", "a.mov"));

// Frames 25 to 34 of 50: sound of just that time, in step with them.
TEST(CopiedStreams, PartOfAVideoGetsItsPartOfTheSound) {
  const test::TemporaryFolder folder;
  const std::string from = make_rich(folder), to = folder / "out.mkv";
  auto source = source::open(from);
  sink::Incoming coming = test::incoming(*source);
  coming.copy_streams_from = from;
  auto sink = sink::open({.path = to, .codec = "ffv1"}, coming);
  while (auto frame = source->next()) {
    if (frame->number >= 25 && frame->number < 35) sink->write(*frame);
  }
  sink->finish();
  const std::string packets = test::ffprobe("-select_streams a -show_entries packet=pts_time", to);
  EXPECT_LT(std::stod(packets), 0.2);  // a FLAC packet takes 0.1 s
  const double last = std::stod(packets.substr(packets.rfind('\n', packets.size() - 2) + 1));
  EXPECT_GT(last, 0.25);
  EXPECT_LT(last, 0.4);
}

TEST(CopiedStreams, TransportStreamStartsAtZeroInStep) {
  const test::TemporaryFolder folder;
  const std::string from = folder / "in.ts", to = folder / "out.mp4";
  test::ffmpeg(
      "-f lavfi -i testsrc2=size=64x48:rate=25 -f lavfi -i sine=440 -t 1 -c:v mpeg2video -c:a aac "
      "-output_ts_offset 3600 " +
      from);
  test::transcode(from, {.path = to, .codec = "mpeg4"});
  const double video = std::stod(test::ffprobe("-select_streams v -show_entries stream=start_time", to));
  EXPECT_LT(video, 0.2);
  const auto offset = [](const std::string& file) {
    return std::stod(test::ffprobe("-select_streams a -show_entries packet=pts_time", file)) -
           std::stod(test::ffprobe("-select_streams v -show_entries packet=pts_time", file));
  };
  EXPECT_NEAR(offset(to), offset(from), 1e-3);
}

TEST(Rotation, IsTheOneThatPlayersShow) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("yuv420p", 64, 48);
  for (const int degrees : {90, 180, 270}) {
    sink::Incoming coming = test::incoming(format);
    coming.rotation_deg = degrees;
    std::string path = folder / "a", again = folder / "b";
    path.append(std::to_string(degrees)).append(".mp4");
    again.append(std::to_string(degrees)).append(".mov");
    test::write_all({.path = path, .codec = "mpeg4"}, coming, test::noise_frames(format, 3));
    EXPECT_EQ(source::open(path)->description().rotation_deg, degrees);
    const int told = std::stoi(test::ffprobe("-show_entries stream_side_data=rotation", path));
    EXPECT_EQ((told + 360) % 360, degrees);
    // Through source and sink once more, now copied from the file.
    EXPECT_EQ(test::transcode(path, {.path = again, .codec = "mpeg4"}), "");
    EXPECT_EQ(source::open(again)->description().rotation_deg, degrees);
  }
  sink::Incoming coming = test::incoming(format);
  coming.rotation_deg = 90;
  const std::string notice =
      test::write_all({.path = folder / "a.mkv", .codec = "ffv1"}, coming, test::noise_frames(format, 3));
  EXPECT_NE(notice.find("rotation"), std::string::npos);
}

// Sets the display matrix of an MP4's only track (ISO 14496-12, 8.3.2: version 0), in 16.16 and 2.30 fixed point.
void set_display_matrix(const std::string& path, const std::array<std::int32_t, 9>& matrix) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const std::size_t header = bytes.find("tkhd");
  ASSERT_NE(header, std::string::npos);
  file.clear();
  file.seekp(static_cast<std::streamoff>(header) + 44);
  for (const std::int32_t entry : matrix) {
    for (int shift = 24; shift >= 0; shift -= 8) {
      file.put(static_cast<char>(static_cast<std::uint32_t>(entry) >> shift & 255));
    }
  }
}

TEST(Rotation, MirroringIsKept) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("yuv420p", 64, 48);
  constexpr std::int32_t one = 1 << 16, unit = 1 << 30;
  const std::array<std::int32_t, 9> across{-one, 0, 0, 0, one, 0, 64 * one, 0, unit};
  const std::array<std::int32_t, 9> upside_down{one, 0, 0, 0, -one, 0, 0, 48 * one, unit};
  const std::array<std::int32_t, 9> turned{0, one, 0, one, 0, 0, 0, 0, unit};
  for (const auto& matrix : {across, upside_down, turned}) {
    const std::string from = folder / "a.mp4", to = folder / "b.mov";
    test::write_all({.path = from, .codec = "mpeg4", .overwrite = true}, test::incoming(format),
                    test::noise_frames(format, 3));
    set_display_matrix(from, matrix);
    const std::string told = test::ffprobe("-show_entries stream_side_data=displaymatrix", from);
    ASSERT_NE(told.find("65536"), std::string::npos) << told;
    EXPECT_EQ(test::transcode(from, {.path = to, .codec = "mpeg4", .overwrite = true}), "");
    EXPECT_EQ(test::ffprobe("-show_entries stream_side_data=displaymatrix", to), told);
    const std::string notice = test::transcode(from, {.path = folder / "c.mkv", .codec = "ffv1", .overwrite = true});
    EXPECT_NE(notice.find("keeps no mirroring"), std::string::npos) << notice;
  }
}

TEST(Interlacing, IsKept) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("yuv420p", 64, 48);
  auto frames = test::noise_frames(format, 3);
  for (Frame& frame : frames) frame.interlaced = true;
  const std::string path = folder / "a.mkv";
  test::write_all({.path = path, .codec = "ffv1"}, test::incoming(format), frames);
  const auto back = source::open(path)->next();
  EXPECT_TRUE(back->interlaced);
  EXPECT_FALSE(back->top_field_first);
}

}  // namespace
}  // namespace rinkaku

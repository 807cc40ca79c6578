#include <fstream>

#include <sys/stat.h>

#include "tests/pipeline/source/media_tools.h"
#include "tests/support/test_data.h"

namespace rinkaku {
namespace {

namespace fs = std::filesystem;

std::string refusal(const fs::path& path) {
  return test::error_of(Error::Kind::Input, [&] { source::open(path.string()); });
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(BadInput, IsOneLineThatSaysWhatToDo) {
  const test::TemporaryFolder folder;
  write(folder / "empty.mp4", "");
  write(folder / "text.mp4", "this is not a video\n");
  std::string text;
  for (int i = 0; i < 500; ++i) text += "neither is this, number " + std::to_string(i) + "\n";
  write(folder / "text.txt", text);
  EXPECT_NE(refusal(folder / "absent.mp4").find("there is no such file; check the path"), std::string::npos);
  EXPECT_NE(refusal(folder.path()).find("is a folder"), std::string::npos);
  EXPECT_NE(refusal(folder / "empty.mp4").find("the file is empty"), std::string::npos);
  EXPECT_NE(refusal(folder / "text.mp4").find("is no video that can be read"), std::string::npos);
  EXPECT_NE(refusal(folder / "text.txt").find("is a text"), std::string::npos);
  EXPECT_NE(refusal(folder / "a%03d.png").find("no file of that pattern exists"), std::string::npos);
  EXPECT_NE(refusal(folder / "*.png").find("no file matches"), std::string::npos);
  EXPECT_NE(refusal(folder / "no/a%03d.png").find("the folder can't be read"), std::string::npos);
  EXPECT_FALSE(refusal("").empty());
}

TEST(BadInput, SoundAloneHoldsNoPictures) {
  const test::TemporaryFolder folder;
  const std::string sound = folder / "sound.wav";
  test::ffmpeg("-f lavfi -i sine=440:duration=0.2 " + sound);
  EXPECT_NE(refusal(sound).find("holds no pictures"), std::string::npos);
}

TEST(BadInput, NoiseInPlaceOfAnImage) {
  const test::TemporaryFolder folder;
  const std::string image = folder / "a.png";
  test::ffmpeg("-f lavfi -i testsrc=size=64x48 -frames:v 1 " + image);
  std::string bytes = read(image);
  // All but the signature and the header.
  for (std::size_t i = 60; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 37);
  write(image, bytes);
  EXPECT_NE(refusal(image).find("no picture of it can be decoded"), std::string::npos);
}

class Truncated : public testing::TestWithParam<const char*> {};

TEST_P(Truncated, GivesWhatIsThereAndSaysSo) {
  const test::TemporaryFolder folder;
  const std::string whole = folder / ("whole." + std::string(GetParam()));
  test::ffmpeg("-f lavfi -i testsrc2=size=160x120:rate=25 -t 4 -c:v mpeg4 -g 5 -movflags +faststart " + whole);
  const std::string bytes = read(whole);
  const fs::path part = folder / ("part." + std::string(GetParam()));
  write(part, bytes.substr(0, bytes.size() * 6 / 10));
  auto source = source::open(part.string());
  const auto frames = test::all_frames(*source);
  EXPECT_GT(frames.size(), 40u);
  EXPECT_LT(frames.size(), 80u);
  EXPECT_NE(source->damage(), "");
  EXPECT_EQ(source->damage().find('\n'), std::string::npos);
  // What was decoded is what the whole file holds there; the last picture may be torn.
  const std::string expected = test::decoded_by_ffmpeg(whole);
  std::string got;
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) got += test::samples(frames[i]);
  EXPECT_TRUE(expected.starts_with(got));
}
INSTANTIATE_TEST_SUITE_P(Containers, Truncated, testing::Values("mp4", "mkv", "avi"));

TEST(BadInput, CorruptVideoIsDecodedAndCounted) {
  const test::TemporaryFolder folder;
  const std::string whole = folder / "whole.avi";
  test::ffmpeg("-f lavfi -i testsrc2=size=160x120:rate=25 -t 4 -c:v mpeg4 -g 5 " + whole);
  std::string bytes = read(whole);
  for (std::size_t i = bytes.size() / 3; i < bytes.size() / 2; i += 61) bytes[i] = static_cast<char>(bytes[i] ^ 0x5a);
  write(folder / "bad.avi", bytes);
  auto source = source::open(folder / "bad.avi");
  const auto frames = test::all_frames(*source);
  EXPECT_GT(frames.size(), 50u);
  EXPECT_LE(frames.size(), 101u);
  EXPECT_NE(source->damage(), "");
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_GT(frames[i].pts, frames[i - 1].pts);
}

TEST(BadInput, CorruptLosslessPicturesAreCounted) {
  const test::TemporaryFolder folder;
  const std::string whole = folder / "whole.mkv";
  test::ffmpeg("-f lavfi -i testsrc2=size=160x120:rate=25 -t 1 -c:v ffv1 -level 3 -g 1 " + whole);
  std::string bytes = read(whole);
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 20; ++i) bytes[i] = static_cast<char>(bytes[i] ^ 0xff);
  write(folder / "bad.mkv", bytes);
  auto source = source::open(folder / "bad.mkv");
  EXPECT_GE(test::all_frames(*source).size(), 24u);
  EXPECT_NE(source->damage(), "");
}

TEST(BadInput, NothingIsPrintedByTheLibraries) {
  const test::TemporaryFolder folder;
  const std::string whole = folder / "whole.mkv";
  test::ffmpeg("-f lavfi -i testsrc2=size=160x120:rate=25 -t 1 -c:v mpeg4 " + whole);
  const std::string bytes = read(whole);
  write(folder / "part.mkv", bytes.substr(0, bytes.size() / 2));
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  auto source = source::open(folder / "part.mkv");
  test::all_frames(*source);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace rinkaku

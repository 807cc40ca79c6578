#include "pipeline/track/camera_file.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/pipeline/track/track_test_support.h"
#include "tests/support/test_data.h"

namespace rinkaku::track {
namespace {

using test::write;

// A camera file whose parts can be replaced one by one.
struct CameraText {
  std::string size = "image_width: 640\nimage_height: 480\n";
  std::string rows = "3", cols = "3";
  std::string matrix = "600, 0, 320, 0, 610, 240, 0, 0, 1";
  std::string distortion = "0.1, -0.2, 0.003, 0.004, 0.05";
  std::string more;

  std::string text() const {
    const auto count = std::to_string(std::count(distortion.begin(), distortion.end(), ',') + 1);
    return "%YAML:1.0\n---\n" + size + "camera_matrix: !!opencv-matrix\n   rows: " + rows + "\n   cols: " + cols +
           "\n   dt: d\n   data: [ " + matrix + " ]\ndistortion_coefficients: !!opencv-matrix\n   rows: " + count +
           "\n   cols: 1\n   dt: d\n   data: [ " + distortion + " ]\n" + more;
  }
};

class CameraFile : public testing::Test {
 protected:
  CameraModel read(const CameraText& camera) { return read_camera(write(folder_ / "camera.yml", camera.text())); }
  rinkaku::test::TemporaryFolder folder_;
};

TEST_F(CameraFile, ReadsWhatOpenCvWrites) {
  const CameraModel camera = read({});
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.height_px, 480);
  EXPECT_EQ(camera.fx_px, 600);
  EXPECT_EQ(camera.fy_px, 610);
  EXPECT_EQ(camera.cx_px, 320);
  EXPECT_EQ(camera.cy_px, 240);
  EXPECT_EQ(camera.distortion[0], 0.1);
  EXPECT_EQ(camera.distortion[4], 0.05);
  EXPECT_EQ(camera.distortion[5], 0);
}

TEST_F(CameraFile, TakesEveryCountOfCoefficientsThatOpenCvWrites) {
  CameraText text;
  text.distortion = "1, 2, 3, 4";
  EXPECT_EQ(read(text).distortion[3], 4);
  text.distortion = "1, 2, 3, 4, 5, 6, 7, 8";
  EXPECT_EQ(read(text).distortion[7], 8);
  text.distortion = "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12";
  EXPECT_EQ(read(text).distortion[11], 12);
  text.distortion = "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0";
  EXPECT_EQ(read(text).distortion[11], 12);
  text.distortion = "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0.01, 0";
  EXPECT_REFUSED(read(text), "tau");
  text.distortion = "1, 2, 3";
  EXPECT_REFUSED(read(text), "holds 3 values");
}

TEST_F(CameraFile, RefusesCamerasThatCannotBe) {
  CameraText text;
  text.matrix = "-600, 0, 320, 0, 610, 240, 0, 0, 1";
  EXPECT_REFUSED(read(text), "not positive");
  text.matrix = "0, 0, 320, 0, 610, 240, 0, 0, 1";
  EXPECT_REFUSED(read(text), "not positive");
  text.matrix = ".Nan, 0, 320, 0, 610, 240, 0, 0, 1";
  EXPECT_REFUSED(read(text), "not finite");
  text.matrix = "600, 0, .Inf, 0, 610, 240, 0, 0, 1";
  EXPECT_REFUSED(read(text), "not finite");
  text.matrix = "600, 1.5, 320, 0, 610, 240, 0, 0, 1";
  EXPECT_REFUSED(read(text), "skew");
  text = {};
  text.rows = "2";
  text.matrix = "600, 0, 320, 0, 610, 240";
  EXPECT_REFUSED(read(text), "2x3, not 3x3");
  text = {};
  text.distortion = ".Nan, 0, 0, 0";
  EXPECT_REFUSED(read(text), "not finite");
  text = {};
  text.size = "image_width: 0\nimage_height: 480\n";
  EXPECT_REFUSED(read(text), "image_width");
  text.size = "image_width: 640.5\nimage_height: 480\n";
  EXPECT_REFUSED(read(text), "image_width");
  text.size = "image_width: \"640\"\nimage_height: 480\n";
  EXPECT_REFUSED(read(text), "image_width");
}

TEST_F(CameraFile, NamesMissingAndMisspeltKeys) {
  CameraText text;
  text.size = "image_width: 640\n";
  EXPECT_REFUSED(read(text), "\"image_height\" is missing");
  text.size = "Image_Width: 640\nimage_height: 480\n";
  EXPECT_REFUSED(read(text), "\"Image_Width\" should be \"image_width\"");
}

TEST_F(CameraFile, RefusesFisheye) {
  CameraText text;
  text.more = "distortion_model: \"fisheye\"\n";
  EXPECT_REFUSED(read(text), "fisheye");
  text.more = "distortion_model: equidistant\n";
  EXPECT_REFUSED(read(text), "equidistant");
  text.more = "fisheye_model: 1\n";
  EXPECT_REFUSED(read(text), "fisheye");
  text.more = "flags: \" fisheye::CALIB_FIX_SKEW\"\n";
  EXPECT_REFUSED(read(text), "fisheye");
  text.more = "fisheye_model: 0\ndistortion_model: \"plumb_bob\"\n";
  EXPECT_EQ(read(text).fx_px, 600);
}

TEST_F(CameraFile, TellsWhatIsWrongWithMalformedFilesInOneLineAndNothingElse) {
  testing::internal::CaptureStderr();
  const std::string good = CameraText().text();
  std::vector<std::string> texts = {"",
                                    "\n\n",
                                    "hello",
                                    "%YAML:1.0",
                                    "%YAML:1.0\n---\n[ 1, 2",
                                    "{",
                                    "{\"a\":",
                                    "<?xml",
                                    "<opencv_storage>",
                                    "\x89PNG\r\n\x1a\n",
                                    std::string(64, '\0'),
                                    "%YAML:1.0\n---\ncamera_matrix: [ 1, 2, [ 3 ] ]\n"};
  // The good file cut off anywhere may still be readable, but never crashes.
  for (std::size_t length = 0; length < good.size(); length += 7) texts.push_back(good.substr(0, length));
  for (const std::string& text : texts) {
    const auto file = write(folder_ / "camera.yml", text);
    try {
      read_camera(file);
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_status(), 2);
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      EXPECT_EQ(std::string(error.what()).find(file.string()), 0u) << error.what();
    }
  }
  EXPECT_REFUSED(read_camera(folder_ / "none.yml"), "no such file");
  EXPECT_REFUSED(read_camera(folder_.path()), "folder");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(CameraFile, ReadsPlainListsAndJson) {
  const auto yaml =
      write(folder_ / "plain.yml",
            "image_width: 640\nimage_height: 480\ncamera_matrix: [ [600, 0, 320], [0, 610, 240], [0, 0, 1] ]\n"
            "distortion_coefficients: [ 0.1, 0, 0, 0 ]\n");
  EXPECT_EQ(read_camera(yaml).fy_px, 610);
  EXPECT_EQ(read_camera(yaml).distortion[0], 0.1);
}

TEST_F(CameraFile, ReadsBackWhatItWrote) {
  CameraModel camera{1920, 1080, 1500.25, 1499.75, 960.5, 539.125, {}};
  camera.distortion = {0.1, -0.2, 0.003, 0.004, 0.05};
  for (const int last : {5, 8, 12}) {
    for (int i = 5; i < last; ++i) camera.distortion[static_cast<std::size_t>(i)] = 0.01 * i;
    for (const char* name : {"a.yml", "a.json", "a.xml"}) {
      write_camera(folder_ / name, camera, CalibrationNote{0.25, 12});
      const CameraModel back = read_camera(folder_ / name);
      EXPECT_EQ(back.width_px, camera.width_px) << name;
      EXPECT_DOUBLE_EQ(back.fx_px, camera.fx_px) << name;
      EXPECT_DOUBLE_EQ(back.cy_px, camera.cy_px) << name;
      for (std::size_t i = 0; i < 14; ++i) EXPECT_DOUBLE_EQ(back.distortion[i], camera.distortion[i]) << name << i;
    }
  }
  EXPECT_THROW(write_camera(folder_ / "no" / "folder.yml", camera), Error);
}

TEST_F(CameraFile, NamesBothSizesOfAnotherResolution) {
  const CameraModel camera = read({});
  check_resolution(camera, "camera.yml", 640, 480);
  EXPECT_REFUSED(check_resolution(camera, "camera.yml", 1280, 720), "640x480");
  EXPECT_REFUSED(check_resolution(camera, "camera.yml", 1280, 720), "1280x720");
}

TEST(CameraFileOfARecording, IsRead) {
  RINKAKU_NEEDS_DATA();
  const CameraModel camera = read_camera(rinkaku::test::data("recordings/aruco_single/intrinsics.yml"));
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_DOUBLE_EQ(camera.fx_px, 628.158);
  EXPECT_DOUBLE_EQ(camera.distortion[3], 0.00336531);
}

}  // namespace
}  // namespace rinkaku::track

#include "recordings/generator/check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/frame/rigid_transform.h"
#include "recordings/generator/desk_room.h"

namespace rinkaku::recordings {
namespace {

std::vector<RigidTransform> read_poses(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<RigidTransform> poses;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream values(line);
    double frame, time_s;
    RigidTransform p;
    values >> frame >> time_s >> p.translation_m.x >> p.translation_m.y >> p.translation_m.z >> p.rotation.x >>
        p.rotation.y >> p.rotation.z >> p.rotation.w;
    poses.push_back(p);
  }
  return poses;
}

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

}  // namespace

std::string check_desk(const std::filesystem::path& folder) {
  cv::Mat matrix, distortion;
  int width = 0, height = 0;
  const cv::FileStorage camera(folder / "camera.yml", cv::FileStorage::READ);
  camera["camera_matrix"] >> matrix;
  camera["distortion_coefficients"] >> distortion;
  camera["image_width"] >> width;
  camera["image_height"] >> height;
  const std::vector<RigidTransform> poses = read_poses(folder / "poses.csv");

  const BoardLayout layout;
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
  const auto settings = cv::aruco::DetectorParameters::create();
  settings->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;

  const std::string call =
      "ffmpeg -nostdin -loglevel error -i '" + (folder / "video.mp4").string() + "' -f rawvideo -pix_fmt gray -";
  std::FILE* pipe = popen(call.c_str(), "r");
  if (!pipe) throw runtime_failure("ffmpeg", "could not be started", "install it");
  cv::Mat1b picture(height, width);
  std::size_t frame = 0, markers = 0, frames_with_all = 0, frames_without = 0;
  std::vector<double> corner_px, translation_percent, contour_px;
  while (frame < poses.size() && std::fread(picture.data, 1, picture.total(), pipe) == picture.total()) {
    const RigidTransform truth = inverse(poses[frame++]);  // camera_from_world
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    cv::aruco::detectMarkers(picture, dictionary, corners, ids, settings);
    markers += ids.size();
    if (static_cast<int>(ids.size()) == layout.columns * layout.rows) ++frames_with_all;
    if (ids.empty()) {
      ++frames_without;
      continue;
    }
    std::vector<cv::Point3f> world;
    std::vector<cv::Point2f> seen, expected, found;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const float pitch = layout.size_m + layout.gap_m, side = layout.size_m;
      const float x = static_cast<float>(ids[i] % layout.columns) * pitch;
      const float y = layout.height_m() - static_cast<float>(ids[i] / layout.columns) * pitch;
      world.insert(world.end(), {{x, y, 0}, {x + side, y, 0}, {x + side, y - side, 0}, {x, y - side, 0}});
      seen.insert(seen.end(), corners[i].begin(), corners[i].end());
    }
    const glm::dvec3 axis = glm::axis(truth.rotation) * glm::angle(truth.rotation);
    const cv::Vec3d true_rotation(axis.x, axis.y, axis.z);
    const cv::Vec3d true_translation(truth.translation_m.x, truth.translation_m.y, truth.translation_m.z);
    cv::projectPoints(world, true_rotation, true_translation, matrix, distortion, expected);
    cv::Vec3d rotation, translation;
    cv::solvePnP(world, seen, matrix, distortion, rotation, translation, false, cv::SOLVEPNP_ITERATIVE);
    cv::projectPoints(world, rotation, translation, matrix, distortion, found);
    double corner2 = 0, contour = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      corner2 += std::pow(cv::norm(seen[i] - expected[i]), 2);
      contour += cv::norm(found[i] - expected[i]);
    }
    corner_px.push_back(std::sqrt(corner2 / static_cast<double>(seen.size())));
    contour_px.push_back(contour / static_cast<double>(seen.size()));
    translation_percent.push_back(100 * cv::norm(translation - true_translation) / cv::norm(true_translation));
  }
  pclose(pipe);

  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(3);
  out << "frames " << frame << ", with all markers " << frames_with_all << ", with none " << frames_without
      << ", markers found " << markers << " of " << frame * static_cast<std::size_t>(layout.columns * layout.rows)
      << "\n";
  if (corner_px.empty()) throw runtime_failure(folder.string(), "no marker was found in any frame", "make it again");
  const auto row = [&](const char* what, const std::vector<double>& values) {
    out << what << ": median " << percentile(values, 0.5) << ", 95 % " << percentile(values, 0.95) << ", most "
        << percentile(values, 1) << "\n";
  };
  row("found corners against the truth, rms px", corner_px);
  row("board placed by the found pose against the truth, mean px", contour_px);
  row("camera's translation against the truth, %", translation_percent);
  if (frame != poses.size() || percentile(contour_px, 0.95) > 1 || percentile(translation_percent, 0.95) > 0.5) {
    throw runtime_failure(folder.string(), "the recording does not keep its promises:\n" + out.str(), "make it again");
  }
  return out.str();
}

}  // namespace rinkaku::recordings

#include "report/sections/rendered_scene.h"

#include <fstream>
#include <sstream>

#include "mesh/topology.h"
#include "pipeline/files/pending_file.h"
#include "pipeline/frame/error.h"
#include "report/sections/shapes.h"

namespace rinkaku::report {

namespace fs = std::filesystem;

ChildRun run_whole(const Settings& settings, const std::vector<std::string>& command) {
  check_interrupted(settings);
  const fs::path prints = settings.scratch / "prints.txt";
  const ChildRun run = run_child(command, prints);
  check_interrupted(settings);
  if (run.status == 0) return run;
  std::ifstream in(prints);
  std::string last;
  for (std::string line; std::getline(in, line);) last = line;
  const std::string name = fs::path(command[0]).filename().string();
  if (run.status == 127) throw runtime_failure(name, "isn't there", "install it");
  throw runtime_failure(name, "failed with status " + std::to_string(run.status) + ": " + quotable(last));
}

std::vector<std::string> render_command(const Settings& settings, const fs::path& scene, const std::string& frames) {
  std::vector<std::string> command = {settings.rinkaku.string(),
                                      "render",
                                      scene.string(),
                                      "-o",
                                      (settings.scratch / "out.mp4").string(),
                                      "--codec",
                                      "mpeg4",
                                      "--bit-rate",
                                      "6000000",
                                      "--force"};
  if (!frames.empty()) command.insert(command.end(), {"--frames", frames});
  return command;
}

fs::path scratch_file(const Settings& settings, const std::string& name, const std::string& text) {
  const fs::path file = settings.scratch / name;
  files::write_file(file.string(), text);
  return file;
}

std::string camera_yml(int width_px, int height_px) {
  std::ostringstream out;
  out << "%YAML:1.0\n---\nimage_width: " << width_px << "\nimage_height: " << height_px
      << "\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ " << width_px << ", 0., "
      << width_px / 2.0 << ", 0., " << width_px << ", " << height_px / 2.0
      << ", 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
      << "   data: [ 0., 0., 0., 0., 0. ]\n";
  return out.str();
}

std::string ball_obj(int n) {
  const mesh::Topology ball = mesh::topology(bumpy_ball(n));
  std::ostringstream out;
  for (const glm::vec3& p : ball.points) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const glm::uvec3& f : ball.faces) out << "f " << f.x + 1 << ' ' << f.y + 1 << ' ' << f.z + 1 << '\n';
  return out.str();
}

}  // namespace rinkaku::report

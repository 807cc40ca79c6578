// Frames per second of `rinkaku render` beside ffmpeg's on the same video, in interleaved runs:
//   an empty scene                                       against a plain transcode,
//   an object covering a tenth of the frame, outlined    against overlaying a still picture of that size.
// Same input, same encoder (MPEG-4), same bit rate, same number of frames. See docs/benchmarks.md.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "mesh/bounds.h"
#include "mesh/import.h"
#include "pipeline/objects/placement.h"

namespace {

namespace fs = std::filesystem;

struct Settings {
  std::string rinkaku;
  std::string video;
  std::string mesh;
  int frames = 1800;
  int rounds = 5;
  long bit_rate = 6'000'000;
};

struct Run {
  double wall_s = 0;
  double cpu_s = 0;
};

Run run(const std::vector<std::string>& command) {
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDIN_FILENO);
    dup2(nowhere, STDOUT_FILENO);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (status != 0) {
    std::fprintf(stderr, "failed: %s ...\n", command[0].c_str());
    std::exit(1);
  }
  auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) / 1e6; };
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          seconds(usage.ru_utime) + seconds(usage.ru_stime)};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Series {
  std::vector<Run> runs;
  double fps(int frames) const {
    std::vector<double> all;
    for (const Run& r : runs) all.push_back(frames / r.wall_s);
    return median(all);
  }
  double cpu_ms(int frames) const {
    std::vector<double> all;
    for (const Run& r : runs) all.push_back(r.cpu_s * 1000 / frames);
    return median(all);
  }
};

void print_ratio(const char* name, const Series& ours, const Series& theirs) {
  std::vector<double> all;
  for (std::size_t i = 0; i < ours.runs.size(); ++i) all.push_back(theirs.runs[i].wall_s / ours.runs[i].wall_s);
  std::printf("  %s %.3f (%.3f to %.3f)\n", name, median(all), *std::min_element(all.begin(), all.end()),
              *std::max_element(all.begin(), all.end()));
}

// An orbit around the object at the distance at which its bounding rectangle covers `part` of the picture on average.
struct Orbit {
  double distance_m = 0;
  int width_px = 0, height_px = 0;  // of the mean rectangle
};

constexpr double focal_widths = 1.0;  // the focal length in picture widths: 53 degrees of view

glm::dvec3 eye_at(double turn, double distance_m) {
  constexpr double raised = 0.35;  // radians above the ground
  return distance_m *
         glm::dvec3(std::cos(turn) * std::cos(raised), std::sin(turn) * std::cos(raised), std::sin(raised));
}

double turn_of(int frame) { return 0.01 * frame; }

glm::dvec2 mean_rectangle(const std::vector<glm::dvec3>& points, double distance_m, int width_px, int frames) {
  glm::dvec2 sum(0);
  int count = 0;
  for (int frame = 0; frame < frames; frame += 10, ++count) {
    const glm::dvec3 eye = eye_at(turn_of(frame), distance_m), z = -glm::normalize(eye);
    const glm::dvec3 x = glm::normalize(glm::cross(z, glm::dvec3(0, 0, 1))), y = glm::cross(z, x);
    glm::dvec2 low(1e9), high(-1e9);
    for (const glm::dvec3& p : points) {
      const glm::dvec3 d = p - eye;
      const glm::dvec2 seen = focal_widths * width_px * glm::dvec2(glm::dot(d, x), glm::dot(d, y)) / glm::dot(d, z);
      low = glm::min(low, seen), high = glm::max(high, seen);
    }
    sum += high - low;
  }
  return sum / static_cast<double>(count);
}

Orbit find_orbit(const std::string& mesh_path, double part, int width_px, int height_px, int frames) {
  const rinkaku::mesh::Imported imported = rinkaku::mesh::import(mesh_path);
  rinkaku::pipeline::ObjectScene object;
  object.mesh = mesh_path;
  object.height_m = 1;
  const glm::dmat4 place = rinkaku::pipeline::world_from_object(
      object, rinkaku::mesh::bounding_box(imported.mesh.positions), imported.summary.up);
  std::vector<glm::dvec3> points;
  for (const glm::vec3& p : imported.mesh.positions) {
    points.push_back(glm::dvec3(place * glm::dvec4(p, 1)) - glm::dvec3(0, 0, 0.5));
  }
  std::printf("object: %zu triangles\n", imported.mesh.triangles.size());
  double near = 1.5, far = 20;
  for (int i = 0; i < 40; ++i) {
    const double middle = (near + far) / 2;
    const glm::dvec2 size = mean_rectangle(points, middle, width_px, frames);
    (size.x * size.y > part * width_px * height_px ? near : far) = middle;
  }
  const glm::dvec2 size = mean_rectangle(points, near, width_px, frames);
  return {near, static_cast<int>(size.x), static_cast<int>(size.y)};
}

void write_scene(const fs::path& folder, const Settings& settings, const Orbit& orbit, int width_px, int height_px) {
  std::ofstream(folder / "empty.toml") << "[plate]\nvideo = \"in.mp4\"\n";
  std::ofstream(folder / "object.toml") << "[plate]\nvideo = \"in.mp4\"\ncamera = \"camera.yml\"\n"
                                        << "[track]\nposes = \"poses.csv\"\n"
                                        << "[[object]]\nmesh = \"" << fs::absolute(settings.mesh).string() << "\"\n"
                                        << "height_m = 1\nposition_m = [0, 0, -0.5]\noutline = { width_px = 3 }\n";
  std::ofstream(folder / "camera.yml")
      << "%YAML:1.0\n---\nimage_width: " << width_px << "\nimage_height: " << height_px
      << "\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ " << focal_widths * width_px
      << ", 0., " << width_px / 2.0 << ", 0., " << focal_widths * width_px << ", " << height_px / 2.0
      << ", 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
      << "   data: [ 0., 0., 0., 0., 0. ]\n";
  std::ofstream poses(folder / "poses.csv");
  poses << "frame,tx,ty,tz,qx,qy,qz,qw\n";
  poses.precision(12);
  for (int frame = 0; frame < settings.frames; ++frame) {
    const glm::dvec3 eye = eye_at(turn_of(frame), orbit.distance_m), z = -glm::normalize(eye);
    const glm::dvec3 x = glm::normalize(glm::cross(z, glm::dvec3(0, 0, 1))), y = glm::cross(z, x);
    const glm::dquat q = glm::quat_cast(glm::dmat3(x, y, z));
    poses << frame << ',' << eye.x << ',' << eye.y << ',' << eye.z << ',' << q.x << ',' << q.y << ',' << q.z << ','
          << q.w << '\n';
  }
}

void compare(const Settings& settings, int width_px, int height_px) {
  const fs::path folder = fs::temp_directory_path() / ("rinkaku_bench_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string in = (folder / "in.mp4").string(), out = (folder / "out.mp4").string();
  const std::string size = std::to_string(width_px) + ":" + std::to_string(height_px);
  const std::string rate = std::to_string(settings.bit_rate), count = std::to_string(settings.frames);
  run({"ffmpeg",
       "-v",
       "error",
       "-y",
       "-stream_loop",
       "-1",
       "-i",
       settings.video,
       "-an",
       "-vf",
       "scale=" + size + ":flags=bicubic,setpts=N/30/TB",
       "-r",
       "30",
       "-frames:v",
       count,
       "-pix_fmt",
       "yuv420p",
       "-c:v",
       "mpeg4",
       "-b:v",
       rate,
       in});
  const Orbit orbit = find_orbit(settings.mesh, 0.1, width_px, height_px, settings.frames);
  write_scene(folder, settings, orbit, width_px, height_px);
  const std::string rectangle = std::to_string(orbit.width_px) + "x" + std::to_string(orbit.height_px);
  const std::string still = (folder / "still.png").string();
  // A still with soft alpha, as a drawn object has.
  run({"ffmpeg", "-v", "error", "-y", "-f", "lavfi", "-i",
       "color=orange:s=" + rectangle +
           ",format=rgba,geq=r='r(X,Y)':g='g(X,Y)':b='b(X,Y)':a='255*lt(hypot(X-W/2,Y-H/2),W/2)'",
       "-frames:v", "1", still});

  const std::vector<std::string> encode = {"-an", "-c:v", "mpeg4", "-b:v", rate, out};
  auto ffmpeg = [&](std::vector<std::string> middle) {
    std::vector<std::string> command = {"ffmpeg", "-v", "error", "-nostdin", "-y", "-i", in};
    command.insert(command.end(), middle.begin(), middle.end());
    command.insert(command.end(), encode.begin(), encode.end());
    return command;
  };
  auto rinkaku = [&](const char* scene) {
    return std::vector<std::string>{
        settings.rinkaku, "render", (folder / scene).string(), "-o", out, "--codec", "mpeg4", "--bit-rate", rate,
        "--force"};
  };
  const std::string place =
      std::to_string((width_px - orbit.width_px) / 2) + ":" + std::to_string((height_px - orbit.height_px) / 2);
  const std::vector<std::vector<std::string>> commands = {
      ffmpeg({}), rinkaku("empty.toml"), ffmpeg({"-i", still, "-filter_complex", "[0:v][1:v]overlay=" + place}),
      rinkaku("object.toml")};
  std::vector<Series> series(commands.size());
  for (int round = 0; round <= settings.rounds; ++round) {
    for (std::size_t i = 0; i < commands.size(); ++i) {
      const Run one = run(commands[i]);
      if (round > 0) series[i].runs.push_back(one);  // the first round warms the caches
    }
  }
  std::printf("%dx%d, %d frames, rectangle %s (%.1f %% of the frame), median of %d interleaved rounds\n", width_px,
              height_px, settings.frames, rectangle.c_str(),
              100.0 * orbit.width_px * orbit.height_px / width_px / height_px, settings.rounds);
  const char* names[] = {"ffmpeg transcode", "rinkaku, empty scene", "ffmpeg overlay", "rinkaku, object"};
  for (std::size_t i = 0; i < series.size(); ++i) {
    std::printf("  %-22s %7.1f fps  %6.2f CPU ms a frame\n", names[i], series[i].fps(settings.frames),
                series[i].cpu_ms(settings.frames));
  }
  print_ratio("empty scene / transcode", series[1], series[0]);
  print_ratio("object / overlay       ", series[3], series[2]);
  fs::remove_all(folder);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  settings.rinkaku = RINKAKU_BINARY;
  settings.video = RINKAKU_SOURCE_DIR "/recordings/desk/video.mp4";
  settings.mesh = RINKAKU_TEST_DATA "/meshes/closed/oded_spot_23k.obj";
  std::vector<std::pair<int, int>> sizes = {{1280, 720}, {1920, 1080}};
  for (int i = 1; i < argc; i += 2) {
    const std::string key = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
    if (key == "--video") {
      settings.video = value;
    } else if (key == "--mesh") {
      settings.mesh = value;
    } else if (key == "--frames") {
      settings.frames = std::stoi(value);
    } else if (key == "--rounds") {
      settings.rounds = std::stoi(value);
    } else if (key == "--bit-rate") {
      settings.bit_rate = std::stol(value);
    } else if (int width = 0, height = 0;
               key == "--size" && std::sscanf(value.c_str(), "%dx%d", &width, &height) == 2) {
      sizes = {{width, height}};
    } else {
      std::fprintf(stderr,
                   "usage: %s [--video FILE] [--mesh FILE] [--frames N] [--rounds N] [--bit-rate N] [--size WxH]\n",
                   argv[0]);
      return 2;
    }
  }
  for (const auto& [width, height] : sizes) compare(settings, width, height);
}

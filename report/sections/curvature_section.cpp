#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "mesh/topology.h"
#include "outline/curvature.h"
#include "outline/pass/curvature_pass.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/buffer.h"
#include "pipeline/gl/context.h"
#include "report/sections/plain_curvature.h"
#include "report/sections/sections.h"
#include "report/sections/shapes.h"

namespace rinkaku::report {
namespace {

struct Shape {
  std::string name;
  std::string plot_title;
  std::function<mesh::Mesh(int size)> mesh;  // of about size^2 points
  std::function<double(const glm::dvec3&)> mean, gauss;
};

std::vector<Shape> shapes(std::uint64_t seed) {
  const Torus torus;
  const Ellipsoid ellipsoid;
  const auto mean = [torus](const glm::dvec3& p) { return torus.mean_curvature(p); };
  const auto gauss = [torus](const glm::dvec3& p) { return torus.gauss_curvature(p); };
  const auto around = [](int size) { return static_cast<int>(size * 1.45); };
  const auto across = [](int size) { return static_cast<int>(size / 1.45); };
  return {
      {"torus", "Torus, even triangles", [=](int size) { return torus.mesh(around(size), across(size)); }, mean, gauss},
      {"ellipsoid", "Ellipsoid of axes 1.3, 1 and 0.7", [=](int size) { return ellipsoid.mesh(size / 2); },
       [=](const glm::dvec3& p) { return ellipsoid.mean_curvature(p); },
       [=](const glm::dvec3& p) { return ellipsoid.gauss_curvature(p); }},
      {"uneven torus", "Torus, points moved along the surface by up to 0.4 of a cell",
       [=](int size) { return torus.mesh(around(size), across(size), 0.4, seed); }, mean, gauss}};
}

struct Errors {
  double mean_rms = 0, mean_most = 0, gauss_rms = 0;  // parts of the truth's root mean square
};

// A method, ready to be run again and again.
class Method {
 public:
  virtual ~Method() = default;
  virtual void run() = 0;
  virtual std::pair<double, double> mean_and_gauss(std::size_t point) = 0;
};

class OnCpu : public Method {
 public:
  OnCpu(const mesh::Topology& topology, outline::CurvatureMethod method)
      : topology_(topology), solver_(topology, method) {}
  void run() override { found_ = &solver_.solve(topology_.points); }
  std::pair<double, double> mean_and_gauss(std::size_t point) override {
    return {found_->mean[point], found_->gauss[point]};
  }

 private:
  const mesh::Topology& topology_;
  outline::CurvatureSolver solver_;
  const outline::Curvature* found_ = nullptr;
};

class OnGpu : public Method {
 public:
  explicit OnGpu(const mesh::Topology& topology)
      : pass_(outline::face_stars(topology), topology.points),
        points_(padded(topology)),
        found_(topology.points.size()) {}
  void run() override {
    pass_.run(points_.name());
    std::array<std::byte, sizeof(glm::vec4)> first;
    pass_.curvatures().read(first);  // waits
    read_ = false;
  }
  std::pair<double, double> mean_and_gauss(std::size_t point) override {
    if (!read_) pass_.curvatures().read(std::as_writable_bytes(std::span(found_))), read_ = true;
    return {found_[point].x, found_[point].y};
  }

 private:
  static gl::StaticBuffer padded(const mesh::Topology& topology) {
    std::vector<glm::vec4> points;
    for (const glm::vec3& p : topology.points) points.emplace_back(p, 1);
    return gl::StaticBuffer(std::as_bytes(std::span(points)));
  }
  outline::CurvaturePass pass_;
  gl::StaticBuffer points_;
  std::vector<glm::vec4> found_;
  bool read_ = false;
};

template <class T>
class Plain : public Method {
 public:
  Plain(const mesh::Topology& topology, void (PlainCurvature<T>::*find)())
      : curvature_(topology.points, topology.faces), find_(find) {}
  void run() override { (curvature_.*find_)(); }
  std::pair<double, double> mean_and_gauss(std::size_t point) override {
    return {curvature_.mean(point), curvature_.gauss(point)};
  }

 private:
  PlainCurvature<T> curvature_;
  void (PlainCurvature<T>::*find_)();
};

Errors errors(const mesh::Topology& topology, const Shape& shape, Method& method) {
  Errors e;
  double mean_truth = 0, gauss_truth = 0;
  for (std::size_t i = 0; i < topology.points.size(); ++i) {
    const glm::dvec3 p(topology.points[i]);
    const auto [mean, gauss] = method.mean_and_gauss(i);
    const double true_mean = shape.mean(p), true_gauss = shape.gauss(p);
    e.mean_rms += std::pow(mean - true_mean, 2), e.gauss_rms += std::pow(gauss - true_gauss, 2);
    e.mean_most = std::max(e.mean_most, std::abs(mean - true_mean));
    mean_truth += true_mean * true_mean, gauss_truth += true_gauss * true_gauss;
  }
  const double count = static_cast<double>(topology.points.size());
  e.mean_most /= std::sqrt(mean_truth / count);
  e.mean_rms = std::sqrt(e.mean_rms / mean_truth), e.gauss_rms = std::sqrt(e.gauss_rms / gauss_truth);
  return e;
}

using Made = std::unique_ptr<Method>;

template <outline::CurvatureMethod method>
Made on_cpu(const mesh::Topology& topology) {
  return std::make_unique<OnCpu>(topology, method);
}
template <class T>
Made plain_corrected(const mesh::Topology& topology) {
  return std::make_unique<Plain<T>>(topology, &PlainCurvature<T>::corrected);
}
template <class T>
Made plain_cotangents(const mesh::Topology& topology) {
  return std::make_unique<Plain<T>>(topology, &PlainCurvature<T>::cotangents);
}
Made on_gpu(const mesh::Topology& topology) { return std::make_unique<OnGpu>(topology); }

struct Kind {
  const char* name;
  Made (*make)(const mesh::Topology&);
};
constexpr Kind kOnGpu{"icnc on the GPU", on_gpu};
constexpr std::array kKinds{Kind{"meyer", on_cpu<outline::CurvatureMethod::Meyer>},
                            Kind{"icnc", on_cpu<outline::CurvatureMethod::Icnc>},
                            Kind{"auto", on_cpu<outline::CurvatureMethod::Auto>},
                            Kind{"quadric", on_cpu<outline::CurvatureMethod::Quadric>},
                            Kind{"meyer plain float", plain_cotangents<float>},
                            Kind{"meyer plain double", plain_cotangents<double>},
                            Kind{"icnc plain float", plain_corrected<float>},
                            Kind{"icnc plain double", plain_corrected<double>},
                            kOnGpu};

struct Measured {
  Errors errors;
  Stopwatch set_up, run;
};

void measure(const Settings& settings, const Shape& shape, int size, bool gpu, Section& section, Plot& plot) {
  const mesh::Topology topology = mesh::topology(shape.mesh(size));
  std::vector<std::unique_ptr<Method>> methods(kKinds.size());
  std::vector<Measured> measured(kKinds.size());
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (kKinds[i].make == on_gpu && !gpu) continue;
    measured[i].set_up.run([&] { methods[i] = kKinds[i].make(topology); });
    methods[i]->run();  // warms up
    measured[i].errors = errors(topology, shape, *methods[i]);
  }
  // In turn, so that what else the machine does falls on all alike.
  for (int round = 0; round < section.repetitions; ++round) {
    check_interrupted(settings);
    for (std::size_t i = 0; i < kKinds.size(); ++i) {
      if (methods[i]) measured[i].run.run([&] { methods[i]->run(); });
    }
  }
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (!methods[i]) continue;
    const Errors& e = measured[i].errors;
    const Timing time = measured[i].run.timing();
    section.table.rows.push_back({shape.name, std::string(kKinds[i].name), static_cast<double>(topology.points.size()),
                                  e.mean_rms, e.mean_most, e.gauss_rms, time.wall_ms.median, time.wall_ms.low,
                                  time.wall_ms.high, time.cpu_ms, measured[i].set_up.timing().wall_ms.median});
    plot.series[i].points.push_back(timed_point(time.wall_ms, e.mean_rms, ""));
  }
}

}  // namespace

Section curvature_section(const Settings& settings) {
  Section section;
  section.intro =
      "Mean and Gaussian curvature at each point of meshes made by formulas, against the formulas' own. Errors are "
      "root "
      "mean squares (and the largest), as parts of the true curvature's root mean square.";
  section.repetitions = settings.quick ? 7 : 31;
  section.table.columns = {{"shape", "Shape"},
                           {"method", "Method"},
                           {"points", "Points"},
                           {"mean_error_rms", "Mean curvature, error"},
                           {"mean_error_most", "largest"},
                           {"gauss_error_rms", "Gaussian, error"},
                           {"time_ms", "Time, ms"},
                           {"time_low_ms", "low"},
                           {"time_high_ms", "high"},
                           {"cpu_ms", "CPU, ms"},
                           {"set_up_ms", "Set-up, ms"}};
  std::unique_ptr<gl::Context> context;
  try {
    context = gl::Context::headless();
  } catch (const Error& error) {
    section.notes.push_back(std::string("Without the GPU's method: ") + error.what());
  }
  std::vector<int> sizes = {16, 32, 64, 128};
  if (!settings.quick) sizes.push_back(252);
  for (const Shape& shape : shapes(settings.seed)) {
    Plot plot;
    plot.title = shape.plot_title;
    plot.x.title = "time of all points, ms";
    plot.y.title = "error of the mean curvature, relative";
    for (const Kind& kind : kKinds) plot.series.push_back({kind.name, {}, true});
    for (const int size : sizes) measure(settings, shape, size, context != nullptr, section, plot);
    if (context == nullptr) plot.series.pop_back();
    plot.says = "Each line is one method on meshes of more and more points. On the front: " + front_names(plot) +
                "; a line that doesn't fall with more points doesn't converge.";
    section.plots.push_back(std::move(plot));
  }
  section.notes.emplace_back(
      "Double against float: \"plain\" methods are the same formulas in simple loops, all of it in one precision or "
      "the "
      "other. Positions are float in all, as meshes have them. The others are the product's: icnc computes in float, "
      "64 "
      "faces side by side; meyer and quadric sum in double.");
  return section;
}

}  // namespace rinkaku::report

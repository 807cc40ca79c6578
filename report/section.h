#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "report/samples.h"
#include "report/table.h"

namespace rinkaku::report {

/// What all sections are told.
struct Settings {
  bool quick = false;                              ///< fewer sizes and repetitions: all sections in under a minute
  std::uint64_t seed = 1;                          ///< of all that is random
  std::filesystem::path recordings;                ///< the folder of recordings; empty: there is none
  std::filesystem::path rinkaku;                   ///< this very program, for sections that run it
  std::filesystem::path scratch;                   ///< a folder for files that are gone at the end
  const std::atomic<bool>* interrupted = nullptr;  ///< set from elsewhere: sections throw Interrupted
};

/// Thrown by a section when it was told to end.
struct Interrupted {};
inline void check_interrupted(const Settings& settings) {
  if (settings.interrupted != nullptr && *settings.interrupted) throw Interrupted{};
}

/// A method at one setting.
struct Point {
  double x = 0, y = 0;
  double x_low = 0, x_high = 0;  ///< of the spread; equal: none is drawn
  std::string label;             ///< written beside it; may be empty
};

/// Points of one colour, joined by a line if they are one method's at several sizes.
struct Series {
  std::string name;
  std::vector<Point> points;
  bool joined = false;
};

struct Axis {
  std::string title;
  bool log = true;  ///< zeros stand at the axis' end, marked 0
};

struct Plot {
  std::string title;
  std::string says;  ///< a sentence on what it shows
  Axis x{"run time, ms"}, y;
  std::vector<Series> series;
  bool front = true;  ///< mark the Pareto front: both axes the less the better
};

/// A part of the report: a table, which also becomes a CSV file, and plots of it.
struct Section {
  std::string intro;  ///< what was measured, on what, against which truth
  Table table;
  std::vector<Plot> plots;
  std::vector<std::string> notes;  ///< what was left out and why
  int repetitions = 0;             ///< of each timing
};

/// A point whose x is a time with its spread.
Point timed_point(const Spread& time_ms, double error, std::string label);

/// The names on a plot's Pareto front, for its sentence: "icnc, quadric and gpu".
std::string front_names(const Plot& plot);

}  // namespace rinkaku::report

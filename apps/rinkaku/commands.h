#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rinkaku::app {

/// The command line of each command, as plain values. Every command returns its exit status and throws Error.

struct RenderCall {
  std::string scene;
  std::string input;
  std::string output;
  std::string frames;  ///< "A:B", "A:", ":B" or empty
  std::string layers;
  std::string timings;
  std::string codec;
  std::string format;
  std::int64_t bit_rate = 0;
  bool force = false;
  bool json = false;
};
int render(const RenderCall& call);

struct ExplainCall {
  std::string scene;
  bool layers = false;
  bool dot = false;
  bool json = false;
};
int explain(const ExplainCall& call);

struct InspectCall {
  std::string mesh;
  bool json = false;
};
int inspect(const InspectCall& call);

struct BoardCall {
  std::string board;
  std::string output;
  std::string page;
  bool force = false;
  bool json = false;
};
int board(const BoardCall& call);

struct CalibrateCall {
  std::vector<std::string> videos;
  std::string board;
  std::string output;
  bool force = false;
  bool json = false;
};
int calibrate(const CalibrateCall& call);

struct CurvatureCall {
  std::string mesh;
  std::string method = "icnc";  ///< "meyer", "icnc", "quadric" or "auto"
  std::string output;
  std::string picture;
  bool force = false;
  bool json = false;
};
int curvature(const CurvatureCall& call);

}  // namespace rinkaku::app

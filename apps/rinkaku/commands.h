#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rinkaku::app {

/// The command line of each command, as plain values. Every command returns its exit status and throws Error. Those
/// about mattes are in matte_commands.h.

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

/// Of play and live.
struct ViewCall {
  std::string scene;
  std::string input;   ///< play only
  std::string camera;  ///< the rest but `seconds`, `no_panel`, `screenshots`: live only
  std::string record;
  std::string virtual_camera;
  std::string session;
  std::string codec;
  std::string screenshots;
  std::string shaders;
  double seconds = 0;
  bool lowest_latency = false;
  bool headless = false;
  bool no_panel = false;
  bool force = false;
  bool json = false;
};
int view(const ViewCall& call, bool live);

struct DevicesCall {
  std::vector<std::string> devices;  ///< empty: all there are
  bool json = false;
};
int devices(const DevicesCall& call);

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

struct SheetCall {
  std::string mesh;
  std::string output;
  std::string styles;  ///< "a,b,c", or empty: all
  double width_px = 3;
  int cell_px = 360;
  int columns = 4;
  double turn_deg = 35;
  double raise_deg = 20;
  std::string clip;              ///< empty: the first one, if a time is given, else the mesh at rest
  std::optional<double> time_s;  ///< of the clip
  bool force = false;
  bool json = false;
};
int sheet(const SheetCall& call);

struct TraceCall {
  std::string scene;
  std::string lines;
  std::string output;
  std::string object;
  std::int64_t frame = 0;
  bool force = false;
  bool json = false;
};
int trace(const TraceCall& call);

struct ReportCall {
  std::string output;
  std::string recordings;  ///< empty: looked for
  std::string sections;    ///< "a,b,c", or empty: all
  std::int64_t seed = 1;
  bool quick = false;
  bool force = false;
  bool json = false;
};
int report(const ReportCall& call);

}  // namespace rinkaku::app

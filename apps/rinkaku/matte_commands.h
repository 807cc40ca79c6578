#pragma once

#include <cstdint>
#include <string>

namespace rinkaku::app {

/// The command lines of the commands about mattes, as those of commands.h.

struct BakeCall {
  std::string mesh;
  std::string output;
  int cells = 8;
  int shells = 1;
  double inner_radii = 1.5;
  double depth_radii = 0;
  bool drop_hidden = false;
  bool force = false;
  bool json = false;
};
int bake(const BakeCall& call);

struct MatteCall {
  std::string mesh;
  std::string regions;
  std::string eye;     ///< "X,Y,Z"
  std::string target;  ///< "X,Y,Z"
  double fov_deg = 40;
  std::string size;  ///< "WxH"
  std::string method;
  std::int64_t triangles = 0;  ///< 0: as many as the region has
  std::string output;
  bool force = false;
  bool json = false;
};
int matte(const MatteCall& call);

struct VerifyCall {
  std::string regions;
  std::string mesh;
  std::int64_t eyes = 2000;
  std::int64_t seed = 1;
  std::string size;  ///< "WxH", or empty: several
  bool json = false;
};
int verify(const VerifyCall& call);

struct ScoreCall {
  std::string matte;
  std::string truth;
  bool json = false;
};
int score(const ScoreCall& call);

}  // namespace rinkaku::app

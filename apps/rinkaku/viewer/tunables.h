#pragma once

#include <array>
#include <string>
#include <vector>

namespace rinkaku::app {

/// A value of the scene that a panel can change while the scene is shown.
struct Tunable {
  enum class Kind { Number, Whole, Flag, Vector, Colour, Choice };
  const char* table;  ///< in the section it is of, e.g. of [[object]]: "", "toon", "outline", ...; for [light] "light"
  const char* key;
  const char* label;
  Kind kind = Kind::Number;
  double least = 0, most = 1, preset = 0;
  bool logarithmic = false;
  std::vector<std::string> choices{};  ///< the first is the preset
  /// Goes only with this key at this word, or with it among its words, in the same table: the scene refuses it
  /// otherwise. Empty: always.
  const char* with_key = "";
  const char* with_word = "";
  std::array<float, 3> preset_vector{};  ///< of a Vector
  bool only_given = false;               ///< shown only where the scene gives it, as what it is otherwise isn't fixed
  const char* without_key = "";          ///< goes only without this key in the same table
};

/// Of every [[object]].
const std::vector<Tunable>& object_tunables();
/// Of [water], of each of its surfaces and of each spray.
const std::vector<Tunable>& water_tunables();
const std::vector<Tunable>& water_surface_tunables();
const std::vector<Tunable>& water_spray_tunables();
/// Of every [[foreground]].
const std::vector<Tunable>& foreground_tunables();
/// Of the scene as a whole.
const std::vector<Tunable>& scene_tunables();

}  // namespace rinkaku::app

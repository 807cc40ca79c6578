#pragma once

#include <array>
#include <string>
#include <vector>

namespace rinkaku::app {

/// A value of the scene that a panel can change while the scene is shown.
struct Tunable {
  enum class Kind { Number, Whole, Vector, Colour, Choice };
  const char* table;  ///< of [[object]]: "", "toon", "outline", ...; for [light] "light"
  const char* key;
  const char* label;
  Kind kind = Kind::Number;
  double least = 0, most = 1, preset = 0;
  bool logarithmic = false;
  std::vector<std::string> choices{};  ///< the first is the preset
  /// Goes only with this key at this word, in the same table: the scene refuses it otherwise. Empty: always.
  const char* with_key = "";
  const char* with_word = "";
  std::array<float, 3> preset_vector{};  ///< of a Vector
};

/// Of every [[object]].
const std::vector<Tunable>& object_tunables();
/// Of the scene as a whole.
const std::vector<Tunable>& scene_tunables();

}  // namespace rinkaku::app

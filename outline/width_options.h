#pragma once

namespace rinkaku::outline {

/// Which curvature a line's width follows. All count in 1 / length: of Gauss, the square root is taken, with its sign.
enum class CurvatureKind { Mean, Gauss, Largest, Smallest };

/// What hollow and hump do to a line.
enum class CurvatureSign {
  Magnitude,  ///< both make it thicker
  Convex,     ///< humps make it thicker, hollows thinner than the base line
  Concave,    ///< the other way
};

struct WidthOptions {
  CurvatureKind kind = CurvatureKind::Mean;
  CurvatureSign sign = CurvatureSign::Magnitude;
  float exaggeration = 2;  ///< the most that is added to the base line, in base lines: t / u
  float saturation = 1;    ///< the curvature from which on that much is added, in K95: s / K95; above 0
  float curve = 1;         ///< exponent on the way there, above 0: below 1 gentle bends count more, above 1 less
  float least = 0.25f;     ///< the thinnest line, in base lines; above 0, to 1
  int smoothing = 3;       ///< how often factors are averaged over neighbours, so that widths don't jitter
};

}  // namespace rinkaku::outline

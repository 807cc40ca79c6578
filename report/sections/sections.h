#pragma once

#include <span>

#include "report/section.h"

namespace rinkaku::report {

/// Each measures one thing. They throw Error where that can't be done here, and Interrupted if told to end.

/// Curvature on surfaces where it is known.
Section curvature_section(const Settings& settings);

/// Mattes of fewer triangles beside the whole mesh's.
Section matte_section(const Settings& settings);

/// Camera poses from filmed markers.
Section tracking_section(const Settings& settings);

/// Mattes of filmed things.
Section foreground_section(const Settings& settings);

/// Every style of line around a ball.
Section outline_section(const Settings& settings);

/// Particles carried by a flow, by several integrators.
Section water_section(const Settings& settings);

/// How much painted water flickers, by several ways of colouring strokes.
Section flicker_section(const Settings& settings);

/// Whole programs against sizes, beside ffmpeg.
Section whole_section(const Settings& settings);

/// What each thing that a scene may have costs beyond a scene without it.
Section left_out_section(const Settings& settings);

/// What no scene should hold, and what comes of it.
Section extreme_section(const Settings& settings);

/// A section by name.
struct ListedSection {
  const char* id;  ///< a word
  const char* title;
  Section (*measure)(const Settings& settings);
};

/// All of them, in the page's order.
std::span<const ListedSection> all_sections();

}  // namespace rinkaku::report

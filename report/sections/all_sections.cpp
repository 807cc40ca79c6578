#include <array>

#include "report/sections/sections.h"

namespace rinkaku::report {

std::span<const ListedSection> all_sections() {
  static constexpr std::array sections{
      ListedSection{"curvature", "Curvature", curvature_section},
      ListedSection{"mattes", "Mattes of fewer triangles", matte_section},
      ListedSection{"tracking", "Tracking", tracking_section},
      ListedSection{"foregrounds", "Mattes of filmed things", foreground_section},
      ListedSection{"outlines", "Lines", outline_section},
      ListedSection{"water", "Water", water_section},
      ListedSection{"flicker", "Flicker of water", flicker_section},
      ListedSection{"whole", "The whole", whole_section},
      ListedSection{"left_out", "Leaving out", left_out_section},
      ListedSection{"extremes", "Extreme cases", extreme_section},
  };
  return sections;
}

}  // namespace rinkaku::report

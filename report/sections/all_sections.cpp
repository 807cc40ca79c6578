#include <array>

#include "report/sections/sections.h"

namespace rinkaku::report {

std::span<const ListedSection> all_sections() {
  static constexpr std::array sections{
      ListedSection{"curvature", "Curvature", curvature_section},
      ListedSection{"mattes", "Mattes of fewer triangles", matte_section},
      ListedSection{"tracking", "Tracking", tracking_section},
      ListedSection{"foregrounds", "Mattes of filmed things", foreground_section},
  };
  return sections;
}

}  // namespace rinkaku::report

#pragma once

#include <string>
#include <vector>

#include "recordings/generator/implicit_surface.h"

namespace rinkaku::recordings {

struct Material {
  std::string name;
  glm::vec3 colour;  ///< sRGB in [0, 1]
};

/// The project's own mascot, a round waving cat with a bell: about 1 high, feet at y = 0, facing +z. Body, eyes, nose,
/// mouth, collar and bell are closed components; the coat's colours are cut crisply.
struct Mascot {
  ColouredMesh mesh;
  std::vector<Material> materials;  ///< indexed by ColouredMesh::materials
};
Mascot make_mascot();

/// glTF 2.0 binary: one primitive a material, positions, normals and indices.
void write_glb(const std::string& file, const Mascot& mascot);

/// A toon-shaded look at the mesh from `azimuth_deg` (0 is the front), for the eye only.
void write_preview(const std::string& png, const Mascot& mascot, float azimuth_deg, float elevation_deg, int size_px);

}  // namespace rinkaku::recordings

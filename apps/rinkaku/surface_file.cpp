#include "apps/rinkaku/surface_file.h"

#include <cstdio>

#include "mesh/import.h"
#include "mesh/topology.h"

namespace rinkaku::app {

silhouette::Surface read_surface(const std::string& mesh_file) {
  const mesh::Imported imported = mesh::import(mesh_file);
  if (imported.summary.skins > 0 || imported.summary.morph_targets > 0) {
    std::fprintf(stderr, "rinkaku: note: %s moves (skins or morphs); this holds for its pose at rest only\n",
                 mesh_file.c_str());
  }
  return silhouette::make_surface(imported.mesh, mesh::topology(imported.mesh));
}

}  // namespace rinkaku::app

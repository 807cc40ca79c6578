#include <cstdio>
#include <optional>
#include <string>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/json_output.h"
#include "mesh/bounds.h"
#include "mesh/inspect.h"
#include "mesh/topology.h"
#include "silhouette/surface.h"

namespace rinkaku::app {
namespace {

// What mattes do about a mesh's parts; nothing for a mesh without triangles or size, which has no matte.
std::optional<silhouette::Treatment> treatment_of(const mesh::Imported& imported) {
  if (imported.mesh.triangles.empty() || glm::length(mesh::bounding_box(imported.mesh.positions).size()) <= 0) {
    return std::nullopt;
  }
  return silhouette::make_surface(imported.mesh, mesh::topology(imported.mesh)).treatment;
}

nlohmann::json to_json(const silhouette::Treatment& treatment) {
  return {{"single_sided_components", treatment.single_sided_components},
          {"repaired_components", treatment.repaired_components},
          {"turned_triangles", treatment.turned_triangles},
          {"two_sided_components", treatment.two_sided_components},
          {"two_sided_triangles", treatment.two_sided_triangles}};
}

nlohmann::json to_json(const mesh::Imported& imported, const mesh::Inspection& found,
                       const std::optional<silhouette::Treatment>& treatment) {
  const mesh::ImportSummary& summary = imported.summary;
  nlohmann::json clips = nlohmann::json::array();
  for (const mesh::Clip& clip : summary.clips) clips.push_back({{"name", clip.name}, {"seconds", clip.duration_s}});
  const glm::vec3 &low = found.box.min, &high = found.box.max;
  return {{"format", summary.format},
          {"up", std::string(1, summary.up)},
          {"vertices", found.vertices},
          {"points", found.points},
          {"triangles", found.triangles},
          {"components", found.components},
          {"euler", found.euler},
          {"closed", found.closed},
          {"manifold", found.manifold},
          {"two_sided", found.two_sided},
          {"degenerate", found.degenerate},
          {"slivers", found.slivers},
          {"duplicates", found.duplicates},
          {"isolated", found.isolated},
          {"boundary_edges", found.boundary_edges},
          {"non_manifold_edges", found.non_manifold_edges},
          {"non_manifold_points", found.non_manifold_points},
          {"inconsistent_edges", found.inconsistent_edges},
          {"box", {{"min", {low.x, low.y, low.z}}, {"max", {high.x, high.y, high.z}}}},
          {"parts", imported.mesh.parts.size()},
          {"materials", imported.mesh.materials.size()},
          {"textures", imported.mesh.textures.size()},
          {"texture_coordinates", !imported.mesh.uvs.empty()},
          {"skins", summary.skins},
          {"skin_names", summary.skin_names},
          {"bones", summary.bones},
          {"morph_targets", summary.morph_targets},
          {"clips", clips},
          {"dropped",
           {{"lines", summary.dropped_lines},
            {"points", summary.dropped_points},
            {"non_finite", summary.dropped_non_finite},
            {"bad_index", summary.dropped_bad_index},
            {"collapsed", summary.dropped_collapsed}}},
          {"matte", treatment ? to_json(*treatment) : nlohmann::json()},
          {"warnings", summary.warnings}};
}

void print_row(const char* name, const std::string& value) { std::printf("%-22s %s\n", name, value.c_str()); }

void print_count(const char* name, std::uint64_t count) {
  if (count > 0) print_row(name, std::to_string(count));
}

std::string counted(std::uint64_t n, const char* what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

std::string yes_or_no(bool yes) { return yes ? "yes" : "no"; }

// How parts are made right for mattes (see docs/silhouette.md); nothing is said of meshes that are closed and sound.
void print(const silhouette::Treatment& treatment) {
  if (treatment.repaired_components > 0) {
    print_row("matte", counted(treatment.repaired_components, "part") + " wound alike, " +
                           counted(treatment.turned_triangles, "triangle") + " turned round for it");
  }
  if (treatment.two_sided_components > 0) {
    print_row("matte", counted(treatment.two_sided_components, "part") + " of " +
                           counted(treatment.two_sided_triangles, "triangle") +
                           " drawn from both sides: open, non-manifold or one-sided");
  }
}

void print(const mesh::Imported& imported, const mesh::Inspection& found) {
  const mesh::ImportSummary& summary = imported.summary;
  char text[128];
  print_row("format", summary.format + ", up is " + summary.up);
  print_row("triangles", std::to_string(found.triangles));
  print_row("vertices", std::to_string(found.vertices) + " (" + std::to_string(found.points) + " points)");
  const glm::dvec3 size = found.box.size();
  std::snprintf(text, sizeof text, "%.6g x %.6g x %.6g", size.x, size.y, size.z);
  print_row("size", text);
  print_row("components", std::to_string(found.components));
  print_row("closed", yes_or_no(found.closed));
  print_row("manifold", yes_or_no(found.manifold));
  print_row("materials", std::to_string(imported.mesh.materials.size()) + ", " +
                             std::to_string(imported.mesh.textures.size()) + " textures");
  print_count("drawn two-sided", found.two_sided);
  print_count("boundary edges", found.boundary_edges);
  print_count("non-manifold edges", found.non_manifold_edges);
  print_count("non-manifold points", found.non_manifold_points);
  print_count("winding disagrees at", found.inconsistent_edges);
  print_count("degenerate", found.degenerate);
  print_count("duplicates", found.duplicates);
  print_count("slivers", found.slivers);
  print_count("isolated points", found.isolated);
  for (const std::string& name : summary.skin_names) print_row("skin", name.empty() ? "(no name)" : name);
  print_count("bones", summary.bones);
  print_count("morph targets", summary.morph_targets);
  for (const mesh::Clip& clip : summary.clips) {
    std::snprintf(text, sizeof text, "%.2f s", clip.duration_s);
    print_row("clip", (clip.name.empty() ? "(no name)" : clip.name) + ", " + text);
  }
  print_count("dropped lines", summary.dropped_lines);
  print_count("dropped points", summary.dropped_points);
  print_count("dropped non-finite", summary.dropped_non_finite);
  print_count("dropped bad index", summary.dropped_bad_index);
  for (const std::string& warning : summary.warnings) print_row("warning", warning);
}

}  // namespace

int inspect(const InspectCall& call) {
  const mesh::Imported imported = mesh::import(call.mesh);
  const mesh::Inspection found = mesh::inspect(imported);
  const std::optional<silhouette::Treatment> treatment = treatment_of(imported);
  if (call.json) {
    print_json(to_json(imported, found, treatment));
  } else {
    print(imported, found);
    if (treatment) print(*treatment);
  }
  return 0;
}

}  // namespace rinkaku::app

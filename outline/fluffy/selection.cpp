#include "outline/fluffy/selection.h"

#include <algorithm>
#include <set>
#include <string>

#include <fnmatch.h>

#include "pipeline/frame/error.h"

namespace rinkaku::fluffy {
namespace {

bool fits(const std::string& pattern, const std::string& name) {
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

std::string names_of(const mesh::Mesh& mesh) {
  constexpr std::size_t most_listed = 20;
  std::set<std::string> names;
  for (const mesh::Part& part : mesh.parts) {
    for (const std::string& name : {mesh.materials[part.material].name, part.name}) {
      if (!name.empty()) names.insert(name);
    }
  }
  std::string text;
  std::size_t listed = 0;
  for (const std::string& name : names) {
    if (listed++ == most_listed) return text + ", ...";
    text += (text.empty() ? "'" : ", '") + name + "'";
  }
  return text;
}

// Per part: whether a pattern names it.
std::vector<std::uint8_t> named(const mesh::Mesh& mesh, const Selection& selection, const char* where) {
  std::vector<std::uint8_t> chosen(mesh.parts.size(), selection.names.empty() ? 1 : 0);
  for (const std::string& pattern : selection.names) {
    bool any = false;
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
      const mesh::Part& part = mesh.parts[p];
      if (!fits(pattern, part.name) && !fits(pattern, mesh.materials[part.material].name)) continue;
      chosen[p] = 1;
      any = true;
    }
    if (any) continue;
    const std::string there = names_of(mesh);
    throw input_error(where, "no material or group of the mesh is called '" + pattern + "'",
                      there.empty() ? "it has none with a name: leave 'parts' out" : "it has " + there);
  }
  return chosen;
}

}  // namespace

Chosen choose(const mesh::Mesh& mesh, const Selection& selection, const char* where) {
  const std::vector<std::uint8_t> parts = named(mesh, selection, where);
  Chosen chosen;
  chosen.weights.assign(mesh.positions.size(), 1.0f);
  if (selection.painted_channel >= 0) {
    if (mesh.colours.empty()) {
      throw input_error(where, "the mesh has no vertex colours to paint fluff with",
                        "leave 'vertex_paint' out, or paint the mesh's vertices");
    }
    for (std::size_t v = 0; v < chosen.weights.size(); ++v) {
      chosen.weights[v] = std::clamp(mesh.colours[v][selection.painted_channel], 0.0f, 1.0f);
    }
  }
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p] == 0) continue;
    const mesh::Part& part = mesh.parts[p];
    for (std::uint32_t f = part.first_triangle; f < part.first_triangle + part.triangle_count; ++f) {
      const glm::uvec3& t = mesh.triangles[f];
      if (std::max({chosen.weights[t.x], chosen.weights[t.y], chosen.weights[t.z]}) > 0) chosen.triangles.push_back(f);
    }
  }
  std::sort(chosen.triangles.begin(), chosen.triangles.end());
  if (chosen.triangles.empty()) {
    throw input_error(where, "the vertex paint is 0 everywhere", "choose another channel for 'vertex_paint'");
  }
  return chosen;
}

}  // namespace rinkaku::fluffy

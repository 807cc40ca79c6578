#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/rig.h"

namespace rinkaku::mesh {

struct ImportOptions {
  /// Edges whose faces' normals differ by more than this are shaded hard where the normals are computed.
  double crease_deg = 60;
  /// Where the shading normals come from. ByFormat: the file's own for glTF, VRM and FBX, where somebody made them on
  /// purpose (missing ones are computed); computed for OBJ, PLY, OFF and STL, whose normals are mostly per face or
  /// absent.
  enum class Normals { ByFormat, File, Computed } normals = Normals::ByFormat;
  bool rig = false;                      ///< also how it moves; then points that part when it does are not welded
  double time_limit_s = 0;               ///< processor time; 0: 5 s and 1 s more for every 10 MB of the file
  std::uint64_t memory_limit_bytes = 0;  ///< 0: 1 GiB and 64 times the file's size
};

/// An animation's name and length, in the order of Rig::animations.
struct Clip {
  std::string name;
  double duration_s = 0;
};

/// What else the file held, and what was left out of the mesh. Counts are of the file, before anything was dropped.
struct ImportSummary {
  std::string format;       ///< "glTF", "VRM", "OBJ", "PLY", "OFF", "STL", "FBX", or Assimp's name of it
  char up = 'y';            ///< likely up axis: 'z' for STL, what an FBX file says, else 'y'
  std::uint32_t skins = 0;  ///< skinned meshes
  std::vector<std::string> skin_names;
  std::uint32_t bones = 0;  ///< different bones in all skins
  std::uint32_t morph_targets = 0;
  std::vector<Clip> clips;
  std::uint64_t dropped_lines = 0;  ///< drawn elements of one or two corners
  std::uint64_t dropped_points = 0;
  std::uint64_t dropped_non_finite = 0;  ///< triangles with a NaN or infinite position
  std::uint64_t dropped_bad_index = 0;   ///< triangles that name a vertex the file does not have
  std::uint64_t dropped_collapsed = 0;   ///< triangles two of whose corners are one point
  std::uint64_t unused_vertices = 0;     ///< vertices in no triangle, as far as the reader tells
  std::vector<std::string> warnings;     ///< one line each: textures not found or not readable, ...
};

struct Imported {
  Mesh mesh;
  ImportSummary summary;
  Rig rig{};  ///< empty unless asked for, and if the file holds neither clips nor morph targets
};

/// Reads a mesh file (glTF, GLB, VRM, OBJ, PLY, OFF, STL, FBX and what else Assimp reads) into one mesh.
///
/// Node transforms are applied (units and axes as in the file), skinned meshes are in the pose their nodes have,
/// polygons are triangulated, vertices at exactly one position are one point, equal vertices are merged, triangles are
/// grouped by part and ordered for the vertex cache. Throws Error (Input), one line naming the file and the remedy:
/// missing, empty, unreadable or unknown file, nothing to draw in it, or one that crashes its reader or exceeds the
/// limits. Error (Runtime) if the reader itself is not found. The file is read in a child process, `rinkaku-import`,
/// found beside the running program (where installing puts it), in ../libexec/rinkaku (where a package may put it) or
/// where it was built; the environment's RINKAKU_IMPORT overrides that. Any thread; several at once are fine. Cost:
/// about 10 ms and 2 microseconds a triangle.
Imported import(const std::filesystem::path& file, const ImportOptions& options = {});

}  // namespace rinkaku::mesh

#pragma once

#include <filesystem>
#include <vector>

#include "mesh/assemble.h"
#include "mesh/import.h"

namespace rinkaku::mesh {

inline constexpr const char* kKnownFormats = "use a glTF, GLB, VRM, OBJ, PLY, OFF, STL or FBX file";
inline constexpr const char* kExportAgain = "open it in a 3D program and export it again, as GLB for instance";

/// What a surface without any material is drawn in: a light grey, which leaves room for light and shade.
inline constexpr glm::vec4 kPlainColour{0.8f, 0.8f, 0.8f, 1.0f};

struct ReadScene {
  Soup soup;
  ImportSummary summary;
};

/// Reads a mesh file into triangles. `normals` says whether the file's normals go into the soup, `rig` whether how it
/// moves does. Throws ImportFailure.
ReadScene read_file(const std::filesystem::path& file, ImportOptions::Normals normals, bool rig);

/// The readers behind it. PLY and OFF are read here, not by Assimp, which takes blanks between lines for data in a
/// binary PLY, knows no binary OFF and stumbles over comments.
ReadScene read_ply(const std::filesystem::path& file, bool keep_normals);
ReadScene read_off(const std::filesystem::path& file, bool keep_normals);
/// Everything else: node transforms applied, skinned meshes in the pose their nodes have, polygons cut into triangles,
/// lines and points counted and left out.
ReadScene read_with_assimp(const std::filesystem::path& file, ImportOptions::Normals normals, bool rig);

/// The whole file. Throws ImportFailure if it can't be read.
std::vector<char> read_bytes(const std::filesystem::path& file);

/// The file name's ending in small letters, with its dot.
std::string lower_ending(const std::filesystem::path& file);

}  // namespace rinkaku::mesh

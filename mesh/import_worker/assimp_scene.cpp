#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "mesh/import_message.h"
#include "mesh/import_worker/materials.h"
#include "mesh/import_worker/mtoon.h"
#include "mesh/import_worker/read_file.h"
#include "mesh/import_worker/rig_reader.h"

namespace rinkaku::mesh {
namespace {

namespace fs = std::filesystem;

using Matrix = aiMatrix4x4t<double>;
using Vector = aiVector3t<double>;

/// What a file format means by what it stores.
struct Format {
  const char* name;
  char up;
  bool own_normals;     ///< its normals were made on purpose
  bool linear_colours;  ///< colour factors and vertex colours are linear
  bool materials;       ///< it has materials at all
};

Format format_of(const std::string& ending) {
  if (ending == ".gltf" || ending == ".glb") return {"glTF", 'y', true, true, true};
  if (ending == ".vrm") return {"VRM", 'y', true, true, true};
  if (ending == ".fbx") return {"FBX", 'y', true, false, true};
  if (ending == ".obj") return {"OBJ", 'y', false, false, true};
  if (ending == ".stl") return {"STL", 'z', false, false, false};
  return {nullptr, 'y', true, false, true};
}

/// Assimp's reason, short and in one line.
std::string reason(const Assimp::Importer& importer) {
  std::string text = importer.GetErrorString();
  if (text.find("No suitable reader") != std::string::npos) return "its content is not what its ending says";
  for (char& c : text) {
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = ' ';
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  constexpr std::size_t kLongest = 160;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text.empty() ? "no reason given" : text;
}

/// Empties faces that name vertices their mesh does not have, before Assimp's own steps trip over them.
std::uint64_t empty_bad_faces(const aiScene& scene) {
  std::uint64_t bad = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      aiFace& face = mesh.mFaces[f];
      const bool good = mesh.mVertices != nullptr && std::all_of(face.mIndices, face.mIndices + face.mNumIndices,
                                                                 [&](unsigned i) { return i < mesh.mNumVertices; });
      if (good) continue;
      face.mNumIndices = 0;
      ++bad;
    }
  }
  return bad;
}

const aiScene& load(Assimp::Importer& importer, const fs::path& file, const std::string& ending,
                    std::uint64_t& bad_faces) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  const aiScene* scene = nullptr;
  if (ending == ".vrm") {
    // A VRM is a GLB, which Assimp does not know by that name.
    const std::vector<char> bytes = read_bytes(file);
    scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "glb");
  } else {
    if (ending.empty() || !importer.IsExtensionSupported(ending)) {
      throw ImportFailure{ending.empty() ? "its name has no ending" : "unknown ending " + ending, kKnownFormats};
    }
    scene = importer.ReadFile(file.string(), 0);
  }
  if (scene == nullptr || scene->mRootNode == nullptr) throw ImportFailure{reason(importer), kExportAgain};
  bad_faces = empty_bad_faces(*scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) throw ImportFailure{reason(importer), kExportAgain};
  return *scene;
}

Vector times(const Matrix& m, const aiVector3D& v) { return m * Vector(v.x, v.y, v.z); }

/// Transforms directions at right angles to surfaces: by the cofactors, which unlike the inverse always exist. They
/// turn round what a mirroring transform mirrors, where a surface's outer side has to stay outside.
Vector times_normal(const Matrix& m, const aiVector3D& n) {
  const Vector x(m.a1, m.b1, m.c1);
  const Vector y(m.a2, m.b2, m.c2);
  const Vector z(m.a3, m.b3, m.c3);
  const Vector turned =
      (y ^ z) * static_cast<double>(n.x) + (z ^ x) * static_cast<double>(n.y) + (x ^ y) * static_cast<double>(n.z);
  return x * (y ^ z) < 0 ? -turned : turned;
}

bool mirrors(const Matrix& m) {
  return Vector(m.a1, m.b1, m.c1) * (Vector(m.a2, m.b2, m.c2) ^ Vector(m.a3, m.b3, m.c3)) < 0;
}

class SceneReader {
 public:
  SceneReader(const aiScene& scene, const fs::path& file, const Format& format, bool keep_normals, bool rig)
      : scene_(scene), format_(format), keep_normals_(keep_normals), textures_(&scene, file.parent_path()) {
    if (rig) rig_.emplace(scene);
    const std::string ending = lower_ending(file);
    if (ending == ".vrm" || ending == ".glb") lines_ = MtoonLines(read_bytes(file));
  }

  ReadScene read() {
    place_nodes();
    reserve_streams();
    for (const auto& [node, world] : placed_) {
      for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        if (node->mMeshes[i] < scene_.mNumMeshes) add_mesh(*scene_.mMeshes[node->mMeshes[i]], *node, world);
      }
    }
    Soup& soup = result_.soup;
    soup.textures = std::move(textures_.textures);
    if (rig_) soup.rig = rig_->finish();
    auto& warnings = result_.summary.warnings;
    warnings.insert(warnings.end(), textures_.warnings.begin(), textures_.warnings.end());
    summarise();
    return std::move(result_);
  }

 private:
  struct Placed {
    const aiNode* node;
    Matrix world;  ///< root_from_node
  };

  void place_nodes() {
    std::vector<Placed> open{{scene_.mRootNode, Matrix(scene_.mRootNode->mTransformation)}};
    while (!open.empty()) {
      const Placed at = open.back();
      open.pop_back();
      // Bones are known by name only; of several nodes of one name, they are the one that is no mesh itself.
      const auto [known, fresh] = world_by_name_.try_emplace(at.node->mName.C_Str(), at);
      if (!fresh && known->second.node->mNumMeshes > 0 && at.node->mNumMeshes == 0) known->second = at;
      placed_.push_back(at);
      for (unsigned i = at.node->mNumChildren; i-- > 0;) {
        const aiNode* child = at.node->mChildren[i];
        if (child != nullptr) open.push_back({child, at.world * Matrix(child->mTransformation)});
      }
    }
  }

  /// Our number of one of Assimp's materials, which is read on first use.
  std::uint32_t material(unsigned index) {
    const auto [known, fresh] = material_numbers_.try_emplace(index, result_.soup.materials.size());
    if (!fresh) return known->second;
    Material material;
    if (index < scene_.mNumMaterials)
      material = read_material(*scene_.mMaterials[index], format_.linear_colours, textures_);
    lines_.read_line(index, material, textures_);
    // What Assimp adds where a file has none.
    if (material.name == AI_DEFAULT_MATERIAL_NAME || !format_.materials) material.base_colour = kPlainColour;
    result_.soup.materials.push_back(std::move(material));
    return known->second;
  }

  /// A stream that any mesh has is filled for all of them.
  void reserve_streams() {
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[i];
      any_uvs_ = any_uvs_ || mesh.HasTextureCoords(channel_of(mesh));
      any_colours_ = any_colours_ || mesh.HasVertexColors(0);
      any_normals_ = any_normals_ || (keep_normals_ && mesh.HasNormals());
    }
  }

  unsigned channel_of(const aiMesh& mesh) const {
    if (mesh.mMaterialIndex >= scene_.mNumMaterials) return 0;
    return uv_channel(*scene_.mMaterials[mesh.mMaterialIndex]);
  }

  /// For each vertex the transform into the scene: its node's, or for a skinned one its bones', blended.
  std::vector<Matrix> skinned_transforms(const aiMesh& mesh, const Matrix& world) const {
    std::vector<Matrix> blended(mesh.mNumVertices, Matrix(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0));
    std::vector<double> total(mesh.mNumVertices, 0.0);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const aiBone& bone = *mesh.mBones[b];
      const auto node = world_by_name_.find(bone.mName.C_Str());
      if (node == world_by_name_.end()) continue;
      const Matrix joint = node->second.world * Matrix(bone.mOffsetMatrix);
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const aiVertexWeight& weight = bone.mWeights[w];
        if (weight.mVertexId >= mesh.mNumVertices || !(weight.mWeight > 0)) continue;
        blended[weight.mVertexId] = blended[weight.mVertexId] + joint * static_cast<double>(weight.mWeight);
        total[weight.mVertexId] += static_cast<double>(weight.mWeight);
      }
    }
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      blended[v] = total[v] > 1e-6 ? blended[v] * (1.0 / total[v]) : world;
    }
    return blended;
  }

  void add_mesh(const aiMesh& mesh, const aiNode& node, const Matrix& world) {
    if (mesh.mVertices == nullptr) return;
    Soup& soup = result_.soup;
    const std::size_t first = soup.positions.size();
    if (first + mesh.mNumVertices >= 0xffffffffu) throw ImportFailure{"it has over 4 billion vertices", "reduce it"};
    std::vector<Matrix> of_vertex;
    if (mesh.HasBones()) of_vertex = skinned_transforms(mesh, world);
    add_vertices(mesh, world, of_vertex);
    if (rig_) rig_->add_vertices(mesh, node);
    const bool mirrored = mirrors(of_vertex.empty() ? world : of_vertex.front());
    add_faces(mesh, node, static_cast<std::uint32_t>(first), mirrored);
  }

  void add_vertices(const aiMesh& mesh, const Matrix& world, const std::vector<Matrix>& of_vertex) {
    Soup& soup = result_.soup;
    const unsigned channel = channel_of(mesh);
    const bool uvs = mesh.HasTextureCoords(channel);
    const bool colours = mesh.HasVertexColors(0);
    const bool opaque = colours && without_alpha(mesh);
    const bool normals = keep_normals_ && mesh.HasNormals();
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const Matrix& m = of_vertex.empty() ? world : of_vertex[v];
      const Vector p = times(m, mesh.mVertices[v]);
      soup.positions.emplace_back(p.x, p.y, p.z);
      if (any_normals_) {
        Vector n(0, 0, 0);
        if (normals) n = times_normal(m, mesh.mNormals[v]);
        const double length = n.Length();
        if (length > 0) n /= length;
        soup.normals.emplace_back(n.x, n.y, n.z);
      }
      if (any_uvs_) {
        const aiVector3D uv = uvs ? mesh.mTextureCoords[channel][v] : aiVector3D(0, 1, 0);
        soup.uvs.emplace_back(uv.x, 1.0f - uv.y);  // Assimp's origin is the bottom left
      }
      if (any_colours_) soup.colours.push_back(colours ? colour(mesh.mColors[0][v], opaque) : glm::vec4(1));
    }
  }

  /// Assimp gives colours of three components an alpha of 0; nobody stores colours none of which can be seen.
  static bool without_alpha(const aiMesh& mesh) {
    return std::all_of(mesh.mColors[0], mesh.mColors[0] + mesh.mNumVertices,
                       [](const aiColor4D& c) { return c.a == 0; });
  }

  glm::vec4 colour(const aiColor4D& c, bool opaque) const {
    const float alpha = opaque ? 1.0f : c.a;
    if (!format_.linear_colours) return {c.r, c.g, c.b, alpha};
    return {srgb_from_linear(c.r), srgb_from_linear(c.g), srgb_from_linear(c.b), alpha};
  }

  void add_faces(const aiMesh& mesh, const aiNode& node, std::uint32_t first, bool mirrored) {
    Soup& soup = result_.soup;
    Part part;
    part.name = mesh.mName.length > 0 ? mesh.mName.C_Str() : node.mName.C_Str();
    part.first_triangle = static_cast<std::uint32_t>(soup.triangles.size());
    part.material = material(mesh.mMaterialIndex);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices == 1) ++result_.summary.dropped_points;
      if (face.mNumIndices == 2) ++result_.summary.dropped_lines;
      if (face.mNumIndices != 3) continue;
      const unsigned* i = face.mIndices;
      if (i[0] >= mesh.mNumVertices || i[1] >= mesh.mNumVertices || i[2] >= mesh.mNumVertices) {
        ++result_.summary.dropped_bad_index;
        continue;
      }
      soup.triangles.emplace_back(first + i[0], first + (mirrored ? i[2] : i[1]), first + (mirrored ? i[1] : i[2]));
    }
    part.triangle_count = static_cast<std::uint32_t>(soup.triangles.size()) - part.first_triangle;
    soup.parts.push_back(std::move(part));
    // Vertex colours multiply the material; one that was made up must not darken them.
    if (mesh.HasVertexColors(0) && !format_.linear_colours) {
      Material& of_part = soup.materials[soup.parts.back().material];
      of_part.base_colour = glm::vec4(1, 1, 1, of_part.base_colour.a);
    }
  }

  void summarise() {
    ImportSummary& s = result_.summary;
    std::set<std::string> bones;
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[i];
      if (mesh.HasBones()) {
        ++s.skins;
        s.skin_names.push_back(mesh.mName.C_Str());
      }
      s.morph_targets += mesh.mNumAnimMeshes;
      for (unsigned b = 0; b < mesh.mNumBones; ++b) bones.insert(mesh.mBones[b]->mName.C_Str());
    }
    s.bones = static_cast<std::uint32_t>(bones.size());
    for (unsigned i = 0; i < scene_.mNumAnimations; ++i) {
      const aiAnimation& clip = *scene_.mAnimations[i];
      const double per_second = clip.mTicksPerSecond > 0 ? clip.mTicksPerSecond : 25.0;
      const double duration_s = clip.mDuration / per_second;
      s.clips.push_back({clip.mName.C_Str(), std::isfinite(duration_s) ? duration_s : 0.0});
    }
  }

  const aiScene& scene_;
  Format format_;
  bool keep_normals_;
  TextureReader textures_;
  MtoonLines lines_;
  std::optional<RigReader> rig_;
  std::vector<Placed> placed_;
  std::unordered_map<std::string, Placed> world_by_name_;
  std::unordered_map<unsigned, std::uint32_t> material_numbers_;
  bool any_uvs_ = false, any_colours_ = false, any_normals_ = false;
  ReadScene result_;
};

char up_axis(const aiScene& scene, const Format& format) {
  int axis = 0;
  if (scene.mMetaData != nullptr && scene.mMetaData->Get("UpAxis", axis) && axis >= 0 && axis <= 2) {
    return static_cast<char>('x' + axis);  // FBX says so itself
  }
  return format.up;
}

std::string reader_name(const Assimp::Importer& importer) {
  const int index = importer.GetPropertyInteger("importerIndex", -1);
  const aiImporterDesc* desc = index >= 0 ? importer.GetImporterInfo(static_cast<std::size_t>(index)) : nullptr;
  return desc != nullptr && desc->mName != nullptr ? desc->mName : "unknown";
}

/// Assimp keeps silent about a material library that is not there and draws in its own grey.
void note_missing_materials(const fs::path& file, ReadScene& scene) {
  std::ifstream lines(file);
  std::string line;
  constexpr int kHeaderLines = 1000;  // the library is named before the first face
  for (int i = 0; i < kHeaderLines && std::getline(lines, line); ++i) {
    if (!line.starts_with("mtllib ")) continue;
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back())) != 0) line.pop_back();
    const std::string name = line.substr(7);
    std::error_code ignored;
    if (fs::exists(file.parent_path() / name, ignored)) continue;
    scene.summary.warnings.push_back("material library " + name + ": not found; drawn in plain grey");
    for (Material& material : scene.soup.materials) material.base_colour = kPlainColour;
  }
}

}  // namespace

ReadScene read_with_assimp(const fs::path& file, ImportOptions::Normals normals, bool rig) {
  const std::string ending = lower_ending(file);
  const Format format = format_of(ending);
  Assimp::Importer importer;
  std::uint64_t bad_faces = 0;
  const aiScene& scene = load(importer, file, ending, bad_faces);
  const bool keep_normals =
      normals == ImportOptions::Normals::File || (normals == ImportOptions::Normals::ByFormat && format.own_normals);
  ReadScene result = SceneReader(scene, file, format, keep_normals, rig).read();
  result.summary.format = format.name != nullptr ? format.name : reader_name(importer);
  result.summary.up = up_axis(scene, format);
  result.summary.dropped_bad_index += bad_faces;
  if (ending == ".obj") note_missing_materials(file, result);
  return result;
}

}  // namespace rinkaku::mesh

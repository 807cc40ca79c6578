// Other people's animated files, posed here and by a reader of glTF's JSON that shares no code with the import.
#include <array>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>

#include <nlohmann/json.hpp>

#include "mesh/import.h"
#include "mesh/moving_mesh.h"
#include "tests/mesh/rigs.h"
#include "tests/support/test_data.h"

namespace rinkaku::mesh {
namespace {

using nlohmann::json;

const std::filesystem::path animated = std::filesystem::path(RINKAKU_TEST_DATA) / "meshes/animated";

/// A glTF file's skinned vertices at a time of a clip, straight from the specification: linear keys, four weights.
class PlainGltf {
 public:
  explicit PlainGltf(const std::filesystem::path& file) {
    const std::string bytes = read(file);
    if (bytes.starts_with("glTF")) {
      std::uint32_t length = 0;
      std::memcpy(&length, bytes.data() + 12, 4);
      json_ = json::parse(bytes.substr(20, length));
      buffer_ = bytes.substr(28 + length);
    } else {
      json_ = json::parse(bytes);
      buffer_ = read(file.parent_path() / json_["buffers"][0]["uri"].get<std::string>());
    }
    for (const json& node : json_["nodes"]) at_rest_.push_back(local(node));
    for (std::size_t n = 0; n < at_rest_.size(); ++n) {
      for (const json& child : json_["nodes"][n].value("children", json::array())) parent_[child] = n;
    }
  }

  std::size_t clips() const { return json_["animations"].size(); }

  /// Of all skinned meshes, in the file's order. `clip` -1: at rest.
  std::vector<glm::vec3> vertices(int clip, float time_s) const {
    std::vector<Local> nodes = at_rest_;
    if (clip >= 0) animate(nodes, json_["animations"][static_cast<std::size_t>(clip)], time_s);
    std::vector<glm::vec3> all;
    for (const json& node : json_["nodes"]) {
      if (!node.contains("mesh") || !node.contains("skin")) continue;
      const json& skin = json_["skins"][node["skin"].get<std::size_t>()];
      const auto inverse_bind = numbers(skin["inverseBindMatrices"]);
      std::vector<glm::mat4> joints;
      for (const json& joint : skin["joints"]) {
        glm::mat4 bind;
        std::copy_n(inverse_bind.begin() + static_cast<std::ptrdiff_t>(16 * joints.size()), 16, &bind[0][0]);
        joints.push_back(world(nodes, joint) * bind);
      }
      for (const json& primitive : json_["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
        const json& attributes = primitive["attributes"];
        const auto position = numbers(attributes["POSITION"]), joint = numbers(attributes["JOINTS_0"]),
                   weight = numbers(attributes["WEIGHTS_0"]);
        for (std::size_t v = 0; v < position.size() / 3; ++v) {
          glm::vec4 sum(0);
          float total = 0;
          for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
            sum += weight[k] * (joints[static_cast<std::size_t>(joint[k])] *
                                glm::vec4(position[3 * v], position[3 * v + 1], position[3 * v + 2], 1));
            total += weight[k];
          }
          all.push_back(glm::vec3(sum) / total);
        }
      }
    }
    return all;
  }

 private:
  struct Local {
    glm::vec3 position{0}, scale{1};
    glm::quat rotation{1, 0, 0, 0};
    glm::mat4 matrix{0};  // if given instead
    glm::mat4 m() const {
      if (matrix != glm::mat4(0)) return matrix;
      return glm::translate(glm::mat4(1), position) * glm::mat4_cast(rotation) * glm::scale(glm::mat4(1), scale);
    }
  };
  static std::string read(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static Local local(const json& node) {
    Local l;
    const auto copy = [&](const char* key, float* to, std::size_t count) {
      if (!node.contains(key)) return;
      for (std::size_t i = 0; i < count; ++i) to[i] = node[key][i];
    };
    copy("translation", &l.position[0], 3);
    copy("scale", &l.scale[0], 3);
    float q[] = {0, 0, 0, 1};
    copy("rotation", q, 4);
    l.rotation = glm::quat(q[3], q[0], q[1], q[2]);
    copy("matrix", &l.matrix[0][0], 16);
    return l;
  }
  std::vector<float> numbers(const json& accessor_number) const {
    const json& accessor = json_["accessors"][accessor_number.get<std::size_t>()];
    const json& view = json_["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::map<std::string, std::size_t> sizes{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const std::size_t components = sizes.at(accessor["type"]);
    const int type = accessor["componentType"];
    const std::size_t size = type == 5126 || type == 5125 ? 4 : type == 5123 ? 2 : 1;
    const std::size_t stride = view.value("byteStride", components * size);
    const std::size_t first = view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
    std::vector<float> all;
    for (std::size_t i = 0; i < accessor["count"]; ++i) {
      for (std::size_t c = 0; c < components; ++c) {
        const char* at = buffer_.data() + first + i * stride + c * size;
        if (type == 5126) {
          float f = 0;
          std::memcpy(&f, at, 4);
          all.push_back(f);
        } else {
          std::uint32_t whole = 0;
          std::memcpy(&whole, at, size);
          all.push_back(static_cast<float>(whole));
        }
      }
    }
    return all;
  }
  void animate(std::vector<Local>& nodes, const json& clip, float time_s) const {
    for (const json& channel : clip["channels"]) {
      const json& sampler = clip["samplers"][channel["sampler"].get<std::size_t>()];
      const auto times = numbers(sampler["input"]), values = numbers(sampler["output"]);
      std::size_t next = 0;
      while (next < times.size() && times[next] <= time_s) ++next;
      const std::size_t a = next == 0 ? 0 : next - 1, b = std::min(next, times.size() - 1);
      const float part = b > a && next > 0 ? (time_s - times[a]) / (times[b] - times[a]) : 0;
      Local& node = nodes[channel["target"]["node"].get<std::size_t>()];
      const std::string path = channel["target"]["path"];
      if (path == "rotation") {
        const auto q = [&](std::size_t k) {
          return glm::quat(values[4 * k + 3], values[4 * k], values[4 * k + 1], values[4 * k + 2]);
        };
        node.rotation = glm::normalize(glm::slerp(q(a), q(b), part));
      } else if (path == "translation" || path == "scale") {
        const auto v = [&](std::size_t k) { return glm::vec3(values[3 * k], values[3 * k + 1], values[3 * k + 2]); };
        (path == "scale" ? node.scale : node.position) = glm::mix(v(a), v(b), part);
      }
    }
  }
  glm::mat4 world(const std::vector<Local>& nodes, std::size_t node) const {
    const glm::mat4 own = nodes[node].m();
    const auto parent = parent_.find(node);
    return parent == parent_.end() ? own : world(nodes, parent->second) * own;
  }

  json json_;
  std::string buffer_;
  std::vector<Local> at_rest_;
  std::map<std::size_t, std::size_t> parent_;
};

struct RealRig {
  const char* file;
  bool all_skinned;  ///< every vertex is in a skinned mesh
};

class RealRigs : public testing::TestWithParam<RealRig> {};

// Each posed point of ours must be one of the plain reader's vertices that stood at the same place at rest.
TEST_P(RealRigs, MoveAsTheSpecificationSays) {
  RINKAKU_NEEDS_DATA();
  const PlainGltf plain(animated / GetParam().file);
  ImportOptions options;
  options.rig = true;
  const Imported imported = import(animated / GetParam().file, options);
  ASSERT_EQ(imported.rig.animations.size(), plain.clips());
  const Topology rest = topology(imported.mesh);
  double size = 0;
  for (const glm::vec3& p : rest.points) size = std::max<double>(size, glm::length(p));
  // The matrices differ by float rounding over a chain of some ten bones; keys that Assimp keeps in milliseconds lie
  // off by up to half of one, in which nothing of these clips moves farther than a thousandth of the size.
  const double near = 2e-3 * size;
  const std::vector<glm::vec3> plain_rest = plain.vertices(-1, 0);
  std::vector<std::vector<std::size_t>> candidates(rest.points.size());
  for (std::size_t p = 0; p < rest.points.size(); ++p) {
    for (std::size_t v = 0; v < plain_rest.size(); ++v) {
      if (glm::distance(rest.points[p], plain_rest[v]) < 1e-5 * size) candidates[p].push_back(v);
    }
    ASSERT_TRUE(!candidates[p].empty() || !GetParam().all_skinned) << "at rest, point " << p;
  }
  Skin skin(imported.mesh, rest, imported.rig);
  Poser poser(imported.rig);
  double moved = 0;
  for (std::size_t clip = 0; clip < plain.clips(); ++clip) {
    const Animation& animation = imported.rig.animations[clip];
    for (const double part : {0.0, 0.37, 0.81}) {
      const double time_s = part * animation.duration_s;
      skin.pose(poser.at(animation, time_s));
      const std::vector<glm::vec3> truth = plain.vertices(static_cast<int>(clip), static_cast<float>(time_s));
      for (std::size_t p = 0; p < rest.points.size(); ++p) {
        if (candidates[p].empty()) continue;
        double nearest = 1e30;
        for (const std::size_t v : candidates[p]) {
          nearest = std::min<double>(nearest, glm::distance(skin.points()[p], truth[v]));
        }
        ASSERT_LT(nearest, near) << animation.name << " at " << time_s << " s, point " << p;
        moved = std::max<double>(moved, glm::distance(skin.points()[p], rest.points[p]));
      }
    }
  }
  EXPECT_GT(moved, 0.02 * size) << "nothing moved: nothing was tested";
}

INSTANTIATE_TEST_SUITE_P(Files, RealRigs,
                         testing::Values(RealRig{"Fox.glb", true}, RealRig{"CesiumMan/CesiumMan.gltf", true},
                                         RealRig{"raylib_robot.glb", false},
                                         RealRig{"03_skinned_cylinder/03_skinned_cylinder.gltf", true}),
                         [](const auto& rig) {
                           std::string name = rig.param.file;
                           name = name.substr(0, name.find_first_of("./"));
                           return name;
                         });

TEST(RealMorphs, StressTestMovesItsOwnBlockOnly) {
  RINKAKU_NEEDS_DATA();
  ImportOptions options;
  options.rig = true;
  const Imported imported = import(animated / "MorphStressTest.gltf", options);
  ASSERT_EQ(imported.rig.morphs.size(), 16u);  // eight keys in each of two primitives
  const auto individuals = std::find_if(imported.rig.animations.begin(), imported.rig.animations.end(),
                                        [](const Animation& a) { return a.name == "Individuals"; });
  ASSERT_NE(individuals, imported.rig.animations.end());
  const Topology rest = topology(imported.mesh);
  Skin skin(imported.mesh, rest, imported.rig);
  Poser poser(imported.rig);
  // Each of its eight blocks rises by itself, one after the other: some points move by more than a block's height, and
  // never more than a quarter of all.
  std::size_t most_moved = 0;
  for (double time_s = 0; time_s < individuals->duration_s; time_s += 0.1) {
    skin.pose(poser.at(*individuals, time_s));
    std::size_t moved = 0;
    for (std::size_t p = 0; p < rest.points.size(); ++p) {
      moved += glm::distance(skin.points()[p], rest.points[p]) > 0.05f ? 1 : 0;
    }
    most_moved = std::max(most_moved, moved);
    EXPECT_LT(moved, rest.points.size() / 4);
  }
  EXPECT_GT(most_moved, 20u);
}

TEST(ImportRig, IsLeftOutUnlessAskedFor) {
  RINKAKU_NEEDS_DATA();
  const Imported plain = import(animated / "Fox.glb");
  EXPECT_TRUE(plain.rig.empty());
  EXPECT_EQ(plain.summary.clips.size(), 3u);
}

}  // namespace
}  // namespace rinkaku::mesh

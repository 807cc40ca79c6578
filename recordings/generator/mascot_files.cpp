#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/frame/error.h"
#include "recordings/generator/mascot.h"
#include "recordings/generator/rasterise.h"

namespace rinkaku::recordings {
namespace {

float linear_from_srgb(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

template <class T>
std::size_t put(std::string& bytes, const std::vector<T>& values) {
  while (bytes.size() % 4 != 0) bytes.push_back('\0');
  const std::size_t offset = bytes.size();
  bytes.resize(offset + values.size() * sizeof(T));
  std::memcpy(bytes.data() + offset, values.data(), values.size() * sizeof(T));
  return offset;
}

void put_word(std::string& bytes, std::size_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>((value >> (8 * i)) & 255u));
}

}  // namespace

void write_glb(const std::string& file, const Mascot& mascot) {
  std::string data;
  std::ostringstream views, accessors, primitives, materials;
  int accessor = 0;
  const auto add = [&](std::size_t offset, std::size_t bytes, int target, int component, std::size_t count,
                       const char* type, const std::string& bounds) {
    const char* comma = accessor > 0 ? "," : "";
    views << comma << "{\"buffer\":0,\"byteOffset\":" << offset << ",\"byteLength\":" << bytes
          << ",\"target\":" << target << "}";
    accessors << comma << "{\"bufferView\":" << accessor << ",\"componentType\":" << component << ",\"count\":" << count
              << ",\"type\":\"" << type << "\"" << bounds << "}";
    return accessor++;
  };

  for (std::size_t m = 0; m < mascot.materials.size(); ++m) {
    std::map<int, std::uint16_t> renumbered;
    std::vector<glm::vec3> positions, normals;
    std::vector<std::uint16_t> indices;
    glm::vec3 low(1e9f), high(-1e9f);
    for (std::size_t t = 0; t < mascot.mesh.triangles.size(); ++t) {
      if (mascot.mesh.materials[t] != static_cast<int>(m)) continue;
      for (const int v : mascot.mesh.triangles[t]) {
        const auto [at, is_new] = renumbered.emplace(v, static_cast<std::uint16_t>(positions.size()));
        if (is_new) {
          positions.push_back(mascot.mesh.positions[static_cast<std::size_t>(v)]);
          normals.push_back(mascot.mesh.normals[static_cast<std::size_t>(v)]);
          low = glm::min(low, positions.back());
          high = glm::max(high, positions.back());
        }
        indices.push_back(at->second);
      }
    }
    std::ostringstream bounds;
    bounds.precision(9);
    bounds << ",\"min\":[" << low.x << "," << low.y << "," << low.z << "],\"max\":[" << high.x << "," << high.y << ","
           << high.z << "]";
    constexpr int array_buffer = 34962, element_buffer = 34963, f32 = 5126, u16 = 5123;
    const std::size_t n = positions.size();
    const int p = add(put(data, positions), n * 12, array_buffer, f32, n, "VEC3", bounds.str());
    const int q = add(put(data, normals), n * 12, array_buffer, f32, n, "VEC3", "");
    const int i = add(put(data, indices), indices.size() * 2, element_buffer, u16, indices.size(), "SCALAR", "");
    const char* comma = m > 0 ? "," : "";
    primitives << comma << "{\"attributes\":{\"POSITION\":" << p << ",\"NORMAL\":" << q << "},\"indices\":" << i
               << ",\"material\":" << m << "}";
    const glm::vec3 c = mascot.materials[m].colour;
    materials << comma << "{\"name\":\"" << mascot.materials[m].name << "\",\"pbrMetallicRoughness\":{"
              << "\"baseColorFactor\":[" << linear_from_srgb(c.x) << "," << linear_from_srgb(c.y) << ","
              << linear_from_srgb(c.z) << ",1],\"metallicFactor\":0,\"roughnessFactor\":0.9}}";
  }
  while (data.size() % 4 != 0) data.push_back('\0');

  std::ostringstream json;
  json << "{\"asset\":{\"version\":\"2.0\",\"generator\":\"rinkaku-generate-recordings\","
       << "\"copyright\":\"the rinkaku project, Apache-2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
       << "\"nodes\":[{\"mesh\":0,\"name\":\"mascot\"}],\"meshes\":[{\"name\":\"mascot\",\"primitives\":["
       << primitives.str() << "]}],\"materials\":[" << materials.str() << "],\"accessors\":[" << accessors.str()
       << "],\"bufferViews\":[" << views.str() << "],\"buffers\":[{\"byteLength\":" << data.size() << "}]}";
  std::string text = json.str();
  while (text.size() % 4 != 0) text.push_back(' ');

  std::string glb = "glTF";
  put_word(glb, 2);
  put_word(glb, 12 + 8 + text.size() + 8 + data.size());
  put_word(glb, text.size());
  glb += "JSON" + text;
  put_word(glb, data.size());
  glb += std::string("BIN\0", 4) + data;
  std::ofstream out(file, std::ios::binary);
  if (!out.write(glb.data(), static_cast<std::streamsize>(glb.size()))) {
    throw runtime_failure(file, "could not be written", "check the folder and the free space");
  }
}

void write_preview(const std::string& png, const Mascot& mascot, float azimuth_deg, float elevation_deg, int size_px) {
  constexpr int finer = 3;
  const int size = size_px * finer;
  const float a = glm::radians(azimuth_deg), e = glm::radians(elevation_deg);
  const glm::vec3 back(std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e));
  const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), back)), up = glm::cross(back, right);
  const glm::vec3 light = glm::normalize(right * -0.5f + up * 0.75f + back * 0.65f);
  constexpr float distance = 3.2f;
  const auto seen = [&](glm::vec3 p) {
    const glm::vec3 q = p - glm::vec3(0.05f, 0.5f, 0);
    const float depth = distance - glm::dot(q, back), scale = static_cast<float>(size) * 0.8f * distance / depth;
    const float half = static_cast<float>(size) / 2;
    return glm::vec3(half + glm::dot(q, right) * scale, half - glm::dot(q, up) * scale, 1 / depth);
  };
  cv::Mat3b picture(size, size, cv::Vec3b(235, 238, 240));
  cv::Mat1f nearest(size, size, 0.0f);
  const auto draw = [&](bool line) {
    for (std::size_t t = 0; t < mascot.mesh.triangles.size(); ++t) {
      std::array<glm::vec3, 3> p, n, s;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t v = static_cast<std::size_t>(mascot.mesh.triangles[t][i]);
        n[i] = mascot.mesh.normals[v];
        p[i] = mascot.mesh.positions[v] + (line ? 0.008f : 0.0f) * n[i];
        s[i] = seen(p[i]);
      }
      const bool front = (s[1].x - s[0].x) * (s[2].y - s[0].y) - (s[2].x - s[0].x) * (s[1].y - s[0].y) < 0;
      if (front == line) continue;
      const glm::vec3 colour = mascot.materials[static_cast<std::size_t>(mascot.mesh.materials[t])].colour;
      rasterise(s, size, size, [&](int x, int y, float inverse_depth, glm::vec3 w) {
        if (inverse_depth <= nearest(y, x)) return;
        nearest(y, x) = inverse_depth;
        const glm::vec3 normal = glm::normalize(w.x * n[0] + w.y * n[1] + w.z * n[2]);
        const float lit = glm::dot(normal, light);
        const glm::vec3 shade = lit > 0.35f    ? glm::vec3(1)
                                : lit > -0.15f ? glm::vec3(0.86f, 0.84f, 0.90f)
                                               : glm::vec3(0.70f, 0.67f, 0.80f);
        const glm::vec3 c = line ? glm::vec3(0.10f, 0.07f, 0.10f) : colour * shade;
        for (int i = 0; i < 3; ++i) picture(y, x)[2 - i] = cv::saturate_cast<uchar>(255 * c[i]);
      });
    }
  };
  draw(true);
  draw(false);
  cv::Mat small;
  cv::resize(picture, small, {}, 1.0 / finer, 1.0 / finer, cv::INTER_AREA);
  cv::imwrite(png, small);
}

}  // namespace rinkaku::recordings

// PLY as its author describes it (G. Turk, "The PLY polygon file format", 1994), with what scanners and modellers put
// into it: colours, normals, texture coordinates per vertex or per corner, triangle strips, elements nobody knows.

#include <array>
#include <cmath>
#include <string>

#include "mesh/import_message.h"
#include "mesh/import_worker/materials.h"
#include "mesh/import_worker/ply_stream.h"
#include "mesh/import_worker/polygon_sink.h"

namespace rinkaku::mesh {
namespace {

/// Where a vertex's properties go: slots of one small array.
enum Slot { kX, kY, kZ, kNx, kNy, kNz, kU, kV, kRed, kGreen, kBlue, kAlpha, kSlots };

int slot_named(const std::string& name) {
  static constexpr std::pair<const char*, Slot> kNames[] = {{"x", kX},
                                                            {"y", kY},
                                                            {"z", kZ},
                                                            {"nx", kNx},
                                                            {"ny", kNy},
                                                            {"nz", kNz},
                                                            {"u", kU},
                                                            {"v", kV},
                                                            {"s", kU},
                                                            {"t", kV},
                                                            {"texture_u", kU},
                                                            {"texture_v", kV},
                                                            {"red", kRed},
                                                            {"green", kGreen},
                                                            {"blue", kBlue},
                                                            {"alpha", kAlpha},
                                                            {"r", kRed},
                                                            {"g", kGreen},
                                                            {"b", kBlue},
                                                            {"diffuse_red", kRed},
                                                            {"diffuse_green", kGreen},
                                                            {"diffuse_blue", kBlue}};
  for (const auto& [known, slot] : kNames) {
    if (name == known) return slot;
  }
  return -1;
}

class PlyReader {
 public:
  PlyReader(const PlyHeader& header, std::string_view data, bool keep_normals, ReadScene& scene)
      : header_(header), stream_(data, header.format), keep_normals_(keep_normals), scene_(scene), polygons_(scene) {}

  void read() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      if (element.name == "vertex") {
        read_vertices(element);
      } else {
        read_others(element);
      }
    }
  }

 private:
  ImportFailure ends_early(const PlyElement& element, std::uint64_t got) const {
    return {"it ends after " + std::to_string(got) + " of the " + std::to_string(element.count) + " elements \"" +
                element.name + "\" it announces",
            "export it again"};
  }

  void read_vertices(const PlyElement& element) {
    std::vector<int> slots;
    std::array<bool, kSlots> has{};
    for (const PlyProperty& p : element.properties) {
      slots.push_back(p.list ? -1 : slot_named(p.name));
      if (slots.back() >= 0) has[static_cast<std::size_t>(slots.back())] = true;
    }
    if (!has[kX] || !has[kY] || !has[kZ]) throw ImportFailure{"its vertices have no x, y and z", "export it again"};
    Soup& soup = scene_.soup;
    std::array<double, kSlots> values{};
    values[kAlpha] = 1;
    for (std::uint64_t v = 0; v < element.count; ++v) {
      for (std::size_t i = 0; i < slots.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (property.list) {
          read_list(property);
          continue;
        }
        const double value = stream_.next(property.type);
        if (slots[i] < 0) continue;
        values[static_cast<std::size_t>(slots[i])] = slots[i] >= kRed ? value / ply_full_value(property.type) : value;
      }
      if (stream_.ended()) throw ends_early(element, v);
      soup.positions.emplace_back(values[kX], values[kY], values[kZ]);
      if (keep_normals_ && has[kNx]) soup.normals.emplace_back(values[kNx], values[kNy], values[kNz]);
      if (has[kU] && has[kV]) soup.uvs.emplace_back(values[kU], 1.0 - values[kV]);
      if (has[kRed] && has[kGreen] && has[kBlue]) {
        soup.colours.emplace_back(values[kRed], values[kGreen], values[kBlue], values[kAlpha]);
      }
    }
  }

  void read_others(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      corners_.clear();
      uvs_.clear();
      bool strip = false;
      for (const PlyProperty& property : element.properties) {
        if (!property.list) {
          stream_.next(property.type);
          continue;
        }
        read_list(property);
        if (property.name == "vertex_indices" || property.name == "vertex_index") {
          corners_.assign(list_.begin(), list_.end());
          strip = element.name == "tristrips";
        }
        if (property.name == "texcoord") uvs_ = list_;
      }
      if (stream_.ended()) throw ends_early(element, i);
      if (strip) {
        add_strips();
      } else if (element.name == "edge") {
        ++scene_.summary.dropped_lines;
      } else if (!corners_.empty()) {
        if (uvs_.size() == corners_.size() * 2) split_corners();
        polygons_.add(corners_);
      }
    }
  }

  void read_list(const PlyProperty& property) {
    list_.clear();
    const double count = stream_.next(property.count_type);
    if (!(count >= 0) || count > static_cast<double>(stream_.bytes_left())) {
      throw ImportFailure{"a list in it is longer than the file", "export it again"};
    }
    for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
      const double value = stream_.next(property.type);
      list_.push_back(std::isfinite(value) && std::abs(value) < 1e15 ? value : -1);
    }
  }

  /// Strips in one list, parted by -1; every other triangle of a strip is wound the other way.
  void add_strips() {
    std::size_t start = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] < 0) {
        start = i + 1;
      } else if (i >= start + 2) {
        const bool odd = (i - start) % 2 == 1;
        const std::array<std::int64_t, 3> triangle{corners_[i - 2], corners_[odd ? i : i - 1],
                                                   corners_[odd ? i - 1 : i]};
        polygons_.add(triangle);
      }
    }
  }

  /// Gives each corner of a polygon with its own texture coordinates a vertex of its own.
  void split_corners() {
    Soup& soup = scene_.soup;
    soup.uvs.resize(soup.positions.size(), glm::vec2(0));
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      if (corners_[c] < 0 || static_cast<std::uint64_t>(corners_[c]) >= soup.positions.size()) return;
      const auto of = static_cast<std::size_t>(corners_[c]);
      soup.positions.push_back(glm::vec3(soup.positions[of]));
      if (!soup.normals.empty()) soup.normals.push_back(glm::vec3(soup.normals[of]));
      if (!soup.colours.empty()) soup.colours.push_back(glm::vec4(soup.colours[of]));
      soup.uvs.emplace_back(uvs_[c * 2], 1.0 - uvs_[c * 2 + 1]);
      corners_[c] = static_cast<std::int64_t>(soup.positions.size() - 1);
    }
  }

  const PlyHeader& header_;
  PlyStream stream_;
  bool keep_normals_;
  ReadScene& scene_;
  PolygonSink polygons_;
  std::vector<double> list_, uvs_;
  std::vector<std::int64_t> corners_;
};

}  // namespace

ReadScene read_ply(const std::filesystem::path& file, bool keep_normals) {
  const std::vector<char> bytes = read_bytes(file);
  const std::string_view whole(bytes.data(), bytes.size());
  const PlyHeader header = read_ply_header(whole);
  ReadScene scene;
  scene.summary.format = "PLY";
  PlyReader(header, whole.substr(header.size), keep_normals, scene).read();
  Material material;
  if (!header.texture.empty()) {
    TextureReader textures(nullptr, file.parent_path());
    material.texture = textures.number_of(header.texture);
    scene.soup.textures = std::move(textures.textures);
    scene.summary.warnings = std::move(textures.warnings);
  }
  if (material.texture < 0 && scene.soup.colours.empty()) material.base_colour = kPlainColour;
  PolygonSink(scene).finish(material);
  return scene;
}

}  // namespace rinkaku::mesh

#include "mesh/import_message.h"

#include <cmath>

#include "mesh/message_stream.h"
#include "mesh/rig_message.h"

namespace rinkaku::mesh {
namespace {

constexpr std::uint32_t kMagic = 0x334d4b52;  // "RKM3"
enum class Content : std::uint32_t { Mesh = 1, Failure = 2 };

void put_summary(MessageWriter& out, const ImportSummary& s) {
  out.put(s.format);
  out.put(s.up);
  out.put(s.skins);
  out.put_texts(s.skin_names);
  out.put(s.bones);
  out.put(s.morph_targets);
  out.put(static_cast<std::uint64_t>(s.clips.size()));
  for (const Clip& clip : s.clips) {
    out.put(clip.name);
    out.put(clip.duration_s);
  }
  for (const std::uint64_t n : {s.dropped_lines, s.dropped_points, s.dropped_non_finite, s.dropped_bad_index,
                                s.dropped_collapsed, s.unused_vertices}) {
    out.put(n);
  }
  out.put_texts(s.warnings);
}

ImportSummary get_summary(MessageReader& in) {
  ImportSummary s;
  s.format = in.get_text();
  s.up = in.get<char>();
  s.skins = in.get<std::uint32_t>();
  s.skin_names = in.get_texts();
  s.bones = in.get<std::uint32_t>();
  s.morph_targets = in.get<std::uint32_t>();
  s.clips.resize(in.length(sizeof(std::uint64_t)));
  for (Clip& clip : s.clips) {
    clip.name = in.get_text();
    clip.duration_s = in.get<double>();
  }
  for (std::uint64_t* n : {&s.dropped_lines, &s.dropped_points, &s.dropped_non_finite, &s.dropped_bad_index,
                           &s.dropped_collapsed, &s.unused_vertices}) {
    *n = in.get<std::uint64_t>();
  }
  s.warnings = in.get_texts();
  return s;
}

void put_mesh(MessageWriter& out, const Mesh& m) {
  out.put_array(m.positions);
  out.put_array(m.normals);
  out.put_array(m.uvs);
  out.put_array(m.colours);
  out.put_array(m.welded);
  out.put(m.point_count);
  out.put_array(m.triangles);
  out.put(static_cast<std::uint64_t>(m.parts.size()));
  for (const Part& part : m.parts) {
    out.put(part.name);
    out.put(part.first_triangle);
    out.put(part.triangle_count);
    out.put(part.material);
  }
  out.put(static_cast<std::uint64_t>(m.materials.size()));
  for (const Material& material : m.materials) {
    out.put(material.name);
    out.put(material.base_colour);
    out.put(static_cast<std::int32_t>(material.texture));
    out.put(static_cast<std::uint8_t>(material.two_sided));
    out.put(static_cast<std::uint8_t>(material.alpha));
    out.put(material.alpha_cutoff);
    const MaterialLine line = material.line.value_or(MaterialLine{});
    out.put(static_cast<std::uint8_t>(material.line.has_value()));
    out.put(static_cast<std::uint8_t>(line.unit));
    out.put(line.width);
    out.put(line.colour);
    out.put(line.lit);
    out.put(static_cast<std::int32_t>(line.width_texture));
    out.put(static_cast<std::int32_t>(line.width_channel));
  }
  out.put(static_cast<std::uint64_t>(m.textures.size()));
  for (const Texture& texture : m.textures) {
    out.put(static_cast<std::int32_t>(texture.width_px));
    out.put(static_cast<std::int32_t>(texture.height_px));
    out.put_array(texture.rgba);
  }
}

Mesh get_mesh(MessageReader& in) {
  Mesh m;
  m.positions = in.get_array<glm::vec3>();
  m.normals = in.get_array<glm::vec3>();
  m.uvs = in.get_array<glm::vec2>();
  m.colours = in.get_array<glm::vec4>();
  m.welded = in.get_array<std::uint32_t>();
  m.point_count = in.get<std::uint32_t>();
  m.triangles = in.get_array<glm::uvec3>();
  m.parts.resize(in.length(3 * sizeof(std::uint32_t)));
  for (Part& part : m.parts) {
    part.name = in.get_text();
    part.first_triangle = in.get<std::uint32_t>();
    part.triangle_count = in.get<std::uint32_t>();
    part.material = in.get<std::uint32_t>();
  }
  m.materials.resize(in.length(sizeof(glm::vec4)));
  for (Material& material : m.materials) {
    material.name = in.get_text();
    material.base_colour = in.get<glm::vec4>();
    material.texture = in.get<std::int32_t>();
    material.two_sided = in.get<std::uint8_t>() != 0;
    const auto alpha = in.get<std::uint8_t>();
    material.alpha = alpha == 1 ? Material::Alpha::Mask : alpha == 2 ? Material::Alpha::Blend : Material::Alpha::Opaque;
    material.alpha_cutoff = in.get<float>();
    const bool has_line = in.get<std::uint8_t>() != 0;
    MaterialLine line;
    const auto unit = in.get<std::uint8_t>();
    line.unit = unit == 1   ? MaterialLine::Unit::Metres
                : unit == 2 ? MaterialLine::Unit::PictureHeights
                            : MaterialLine::Unit::None;
    line.width = in.get<float>();
    line.colour = in.get<glm::vec3>();
    line.lit = in.get<float>();
    line.width_texture = in.get<std::int32_t>();
    line.width_channel = in.get<std::int32_t>();
    if (has_line) material.line = line;
  }
  m.textures.resize(in.length(sizeof(std::uint64_t)));
  for (Texture& texture : m.textures) {
    texture.width_px = in.get<std::int32_t>();
    texture.height_px = in.get<std::int32_t>();
    texture.rgba = in.get_array<std::uint8_t>();
  }
  return m;
}

template <typename Vector>
bool all_finite(const std::vector<Vector>& values) {
  for (const Vector& v : values) {
    for (int k = 0; k < Vector::length(); ++k) {
      if (!std::isfinite(v[k])) return false;
    }
  }
  return true;
}

bool sound(const Mesh& m) {
  const std::size_t count = m.positions.size();
  if (m.normals.size() != count || m.welded.size() != count) return false;
  if (!m.uvs.empty() && m.uvs.size() != count) return false;
  if (!m.colours.empty() && m.colours.size() != count) return false;
  if (!all_finite(m.positions) || !all_finite(m.normals) || !all_finite(m.uvs) || !all_finite(m.colours)) return false;
  if (m.point_count > count || m.triangles.empty() || m.materials.empty()) return false;
  for (const std::uint32_t point : m.welded) {
    if (point >= m.point_count) return false;
  }
  for (const glm::uvec3& t : m.triangles) {
    if (t.x >= count || t.y >= count || t.z >= count) return false;
    if (m.welded[t.x] == m.welded[t.y] || m.welded[t.y] == m.welded[t.z] || m.welded[t.z] == m.welded[t.x])
      return false;
  }
  std::uint64_t next = 0;
  for (const Part& part : m.parts) {
    if (part.first_triangle != next || part.material >= m.materials.size()) return false;
    next += part.triangle_count;
  }
  if (next != m.triangles.size()) return false;
  for (const Material& material : m.materials) {
    if (material.texture < -1 || material.texture >= static_cast<std::int64_t>(m.textures.size())) return false;
    if (!all_finite(std::vector{material.base_colour}) || !std::isfinite(material.alpha_cutoff)) return false;
    const MaterialLine line = material.line.value_or(MaterialLine{});
    if (!std::isfinite(line.width) || line.width < 0 || !all_finite(std::vector{line.colour})) return false;
    if (!(line.lit >= 0 && line.lit <= 1) || line.width_channel < 0 || line.width_channel > 3) return false;
    if (line.width_texture < -1 || line.width_texture >= static_cast<std::int64_t>(m.textures.size())) return false;
  }
  for (const Texture& t : m.textures) {
    if (t.width_px <= 0 || t.height_px <= 0) return false;
    if (t.rgba.size() !=
        std::uint64_t{4} * static_cast<std::uint64_t>(t.width_px) * static_cast<std::uint64_t>(t.height_px)) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> encode(const Imported& imported) {
  MessageWriter out;
  out.put(kMagic);
  out.put(Content::Mesh);
  put_summary(out, imported.summary);
  put_mesh(out, imported.mesh);
  put_rig(out, imported.rig);
  return std::move(out.bytes);
}

std::vector<std::uint8_t> encode(const ImportFailure& failure) {
  MessageWriter out;
  out.put(kMagic);
  out.put(Content::Failure);
  out.put(failure.what);
  out.put(failure.remedy);
  return std::move(out.bytes);
}

std::optional<ImportMessage> decode(std::span<const std::uint8_t> bytes) {
  MessageReader in(bytes);
  if (in.get<std::uint32_t>() != kMagic) return {};
  ImportMessage message;
  switch (in.get<Content>()) {
    case Content::Mesh: {
      Imported imported;
      imported.summary = get_summary(in);
      imported.mesh = get_mesh(in);
      imported.rig = get_rig(in);
      if (!in.good() || !in.at_end() || !sound(imported.mesh)) return {};
      if (!sound(imported.rig, imported.mesh.point_count)) return {};
      message.imported = std::move(imported);
      return message;
    }
    case Content::Failure: {
      ImportFailure failure;
      failure.what = in.get_text();
      failure.remedy = in.get_text();
      if (!in.good() || !in.at_end() || failure.what.empty()) return {};
      message.failure = std::move(failure);
      return message;
    }
  }
  return {};
}

}  // namespace rinkaku::mesh

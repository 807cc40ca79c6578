// OFF as Geomview describes it: [ST][C][N]OFF, text or binary, comments anywhere; and the little-endian binary of newer
// libraries.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

#include "mesh/import_message.h"
#include "mesh/import_worker/polygon_sink.h"
#include "mesh/import_worker/text_cursor.h"

namespace rinkaku::mesh {
namespace {

struct OffHeader {
  bool uvs = false, colours = false, normals = false, binary = false;
};

/// What the first word says; throws for what is no OFF or has other than three dimensions.
OffHeader header_in(std::string_view word) {
  OffHeader header;
  const std::string_view whole = word;
  const auto take = [&](std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
  };
  header.uvs = take("ST");
  header.colours = take("C");
  header.normals = take("N");
  if (word == "4OFF" || word == "nOFF" || word == "4nOFF") {
    throw ImportFailure{"its points have not three coordinates but " + std::string(whole),
                        "export it in three dimensions"};
  }
  if (word != "OFF") throw ImportFailure{"it does not start with OFF", kExportAgain};
  return header;
}

ImportFailure ends_early(const char* within, std::uint64_t got, std::uint64_t promised) {
  return {
      "it ends after " + std::to_string(got) + " of the " + std::to_string(promised) + " " + within + " it announces",
      "export it again"};
}

class TextOff {
 public:
  TextOff(TextCursor& cursor, const OffHeader& header, bool keep_normals, ReadScene& scene)
      : cursor_(cursor), header_(header), keep_normals_(keep_normals && header.normals), scene_(scene) {}

  void read() {
    std::string_view word = cursor_.word();
    const auto vertices = count_in(word);
    const auto faces = count_in(cursor_.word_on_line());
    if (!vertices || !faces) throw ImportFailure{"the numbers of points and faces are missing", "export it again"};
    cursor_.skip_line();
    for (std::uint64_t v = 0; v < *vertices; ++v) {
      if (!read_vertex()) throw ends_early("points", v, *vertices);
    }
    PolygonSink polygons(scene_);
    for (std::uint64_t f = 0; f < *faces; ++f) {
      if (!read_face(polygons)) throw ends_early("faces", f, *faces);
    }
  }

 private:
  float number(std::string_view word) {
    const auto value = number_in(word);
    if (!value)
      throw ImportFailure{"\"" + std::string(word.substr(0, 40)) + "\" stands where a number should",
                          "export it again"};
    return static_cast<float>(*value);
  }

  bool read_vertex() {
    Soup& soup = scene_.soup;
    const std::string_view first = cursor_.word();
    if (first.empty()) return false;
    glm::vec3 p(number(first), 0, 0);
    for (int k = 1; k < 3; ++k) p[k] = number(cursor_.word_on_line());
    soup.positions.push_back(p);
    // After the position normal, colour and texture coordinates, as the header announces them.
    glm::vec3 n(0);
    if (header_.normals) {
      for (int k = 0; k < 3; ++k) n[k] = number(cursor_.word_on_line());
    }
    if (keep_normals_) soup.normals.push_back(n);
    if (header_.colours) soup.colours.push_back(colour());
    if (header_.uvs) {
      const float u = number(cursor_.word_on_line());
      soup.uvs.emplace_back(u, 1.0f - number(cursor_.word_on_line()));
    }
    cursor_.skip_line();
    return true;
  }

  /// Whole numbers are of 255; red, green, blue, and alpha unless texture coordinates end the line.
  glm::vec4 colour() {
    glm::vec4 c(0, 0, 0, 1);
    bool whole = true;
    for (int k = 0; k < 4; ++k) {
      TextCursor before = cursor_;
      const std::string_view word = cursor_.word_on_line();
      if (k == 3 && (header_.uvs || word.empty())) {
        cursor_ = before;
        if (whole) c.a = 255;
        break;
      }
      c[k] = number(word);
      whole = whole && word.find_first_of(".eE") == std::string_view::npos;
    }
    return whole ? c / 255.0f : c;
  }

  bool read_face(PolygonSink& polygons) {
    const std::string_view first = cursor_.word();
    if (first.empty()) return false;
    const auto corners = count_in(first);
    if (!corners)
      throw ImportFailure{"\"" + std::string(first.substr(0, 40)) + "\" stands where a face should start",
                          "export it again"};
    corners_.clear();
    for (std::uint64_t c = 0; c < *corners; ++c) {
      const std::string_view word = cursor_.word();
      if (word.empty()) return false;
      const auto index = count_in(word);
      corners_.push_back(index ? static_cast<std::int64_t>(std::min<std::uint64_t>(*index, 1ull << 62)) : -1);
    }
    cursor_.skip_line();  // the rest is the face's colour
    polygons.add(corners_);
    return true;
  }

  TextCursor& cursor_;
  OffHeader header_;
  bool keep_normals_;
  ReadScene& scene_;
  std::vector<std::int64_t> corners_;
};

class BinaryOff {
 public:
  BinaryOff(std::string_view bytes, const OffHeader& header, ReadScene& scene) : bytes_(bytes), scene_(scene) {
    floats_a_vertex_ = 3u + (header.normals ? 3u : 0u) + (header.colours ? 4u : 0u) + (header.uvs ? 2u : 0u);
  }

  void read() {
    // Geomview stores the large end first; which one it is shows by whether the points fit the file.
    if (!counts_fit()) big_endian_ = true;
    if (!counts_fit()) throw ImportFailure{"its numbers of points and faces do not fit its size", "export it again"};
    for (std::uint32_t v = 0; v < vertices_; ++v) {
      glm::vec3 p(0);
      for (int k = 0; k < 3; ++k) p[k] = std::bit_cast<float>(next());
      at_ += 4 * (floats_a_vertex_ - 3);
      scene_.soup.positions.push_back(p);
    }
    // Geomview has each face's colour behind its corners, others do not. The one that ends with the file is right.
    const std::size_t start = at_;
    const bool colours = read_faces(true, nullptr) && at_ == bytes_.size();
    at_ = start;
    PolygonSink polygons(scene_);
    if (!read_faces(colours, &polygons)) throw ImportFailure{"it ends within its faces", "export it again"};
  }

 private:
  bool counts_fit() {
    at_ = 0;
    if (bytes_.size() < 12) return false;
    vertices_ = next();
    faces_ = next();
    next();
    return bytes_.size() >= 12 + std::uint64_t{vertices_} * 4 * floats_a_vertex_ + std::uint64_t{faces_} * 4;
  }

  bool read_faces(bool colours, PolygonSink* polygons) {
    std::vector<std::int64_t> corners;
    for (std::uint32_t f = 0; f < faces_; ++f) {
      if (left() < 1) return false;
      const std::uint32_t count = next();
      if (left() < count) return false;
      corners.clear();
      for (std::uint32_t c = 0; c < count; ++c) corners.push_back(next());
      if (colours) {
        if (left() < 1) return false;
        const std::uint32_t components = next();
        if (components > 4 || left() < components) return false;
        at_ += 4 * std::size_t{components};
      }
      if (polygons != nullptr) polygons->add(corners);
    }
    return true;
  }

  std::size_t left() const { return (bytes_.size() - at_) / 4; }
  std::uint32_t next() {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes_.data() + at_, 4);
    at_ += 4;
    return big_endian_ ? __builtin_bswap32(value) : value;
  }

  std::string_view bytes_;
  ReadScene& scene_;
  std::size_t at_ = 0;
  std::uint32_t floats_a_vertex_ = 3, vertices_ = 0, faces_ = 0;
  bool big_endian_ = false;
};

}  // namespace

ReadScene read_off(const std::filesystem::path& file, bool keep_normals) {
  const std::vector<char> bytes = read_bytes(file);
  ReadScene scene;
  scene.summary.format = "OFF";
  TextCursor cursor(std::string_view(bytes.data(), bytes.size()), '#');
  OffHeader header = header_in(cursor.word());
  TextCursor after = cursor;
  header.binary = after.word_on_line() == "BINARY";
  if (header.binary) {
    after.skip_line();
    BinaryOff(after.rest().substr(std::min<std::size_t>(1, after.rest().size())), header, scene).read();
  } else {
    TextOff(cursor, header, keep_normals, scene).read();
  }
  Material material;
  if (scene.soup.colours.empty()) material.base_colour = kPlainColour;
  PolygonSink(scene).finish(material);
  return scene;
}

}  // namespace rinkaku::mesh

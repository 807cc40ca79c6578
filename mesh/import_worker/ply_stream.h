#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/import_worker/text_cursor.h"

namespace rinkaku::mesh {

enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float;
  bool list = false;
  PlyType count_type = PlyType::Uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum class Format { Text, LittleEndian, BigEndian } format = Format::Text;
  std::vector<PlyElement> elements;
  std::string texture;   ///< "comment TextureFile NAME"
  std::size_t size = 0;  ///< where the data start
};

/// Throws ImportFailure.
PlyHeader read_ply_header(std::string_view bytes);

/// The numbers behind the header, one after the other, text or binary alike.
class PlyStream {
 public:
  PlyStream(std::string_view data, PlyHeader::Format format) : data_(data), text_(data), format_(format) {}

  /// The next number; 0 after the end, and `ended` is set from then on.
  double next(PlyType type);
  bool ended() const { return ended_; }
  /// No more numbers than this can follow.
  std::uint64_t bytes_left() const;

 private:
  std::string_view data_;
  TextCursor text_;
  PlyHeader::Format format_;
  bool ended_ = false;
};

/// What an integer colour channel's full value is; 1 for floats.
double ply_full_value(PlyType type);

}  // namespace rinkaku::mesh

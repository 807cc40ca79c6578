#include "mesh/import_worker/ply_stream.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

#include "mesh/import_message.h"

namespace rinkaku::mesh {
namespace {

std::optional<PlyType> type_named(std::string_view name) {
  constexpr std::pair<std::string_view, PlyType> kNames[] = {
      {"char", PlyType::Int8},     {"int8", PlyType::Int8},     {"uchar", PlyType::Uint8},
      {"uint8", PlyType::Uint8},   {"short", PlyType::Int16},   {"int16", PlyType::Int16},
      {"ushort", PlyType::Uint16}, {"uint16", PlyType::Uint16}, {"int", PlyType::Int32},
      {"int32", PlyType::Int32},   {"uint", PlyType::Uint32},   {"uint32", PlyType::Uint32},
      {"float", PlyType::Float},   {"float32", PlyType::Float}, {"double", PlyType::Double},
      {"float64", PlyType::Double}};
  for (const auto& [known, type] : kNames) {
    if (known == name) return type;
  }
  return {};
}

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::Int8:
    case PlyType::Uint8:
      return 1;
    case PlyType::Int16:
    case PlyType::Uint16:
      return 2;
    case PlyType::Double:
      return 8;
    default:
      return 4;
  }
}

template <typename T>
double read_as(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

ImportFailure broken_header(std::string_view line) {
  return {"its header has a line that is no PLY: \"" + std::string(line.substr(0, 60)) + "\"", "export it again"};
}

PlyProperty property_in(TextCursor words, std::string_view line) {
  PlyProperty property;
  std::string_view word = words.word();
  if (word == "list") {
    property.list = true;
    const auto count_type = type_named(words.word());
    if (!count_type) throw broken_header(line);
    property.count_type = *count_type;
    word = words.word();
  }
  const auto type = type_named(word);
  property.name = words.word();
  if (!type || property.name.empty()) throw broken_header(line);
  property.type = *type;
  return property;
}

PlyHeader::Format format_in(std::string_view word, std::string_view line) {
  if (word == "ascii") return PlyHeader::Format::Text;
  if (word == "binary_little_endian") return PlyHeader::Format::LittleEndian;
  if (word == "binary_big_endian") return PlyHeader::Format::BigEndian;
  throw broken_header(line);
}

}  // namespace

PlyHeader read_ply_header(std::string_view bytes) {
  PlyHeader header;
  if (!bytes.starts_with("ply")) throw ImportFailure{"it does not start with ply", "export it again"};
  std::size_t at = 0;
  while (true) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string_view::npos) throw ImportFailure{"its header does not end", "export it again"};
    const std::string_view line = bytes.substr(at, end - at);
    at = end + 1;
    TextCursor words(line);
    const std::string_view keyword = words.word();
    if (keyword == "end_header") break;
    if (keyword == "format") header.format = format_in(words.word(), line);
    if (keyword == "element") {
      const std::string_view name = words.word();
      const auto count = count_in(words.word());
      if (name.empty() || !count) throw broken_header(line);
      header.elements.push_back({std::string(name), *count, {}});
    }
    if (keyword == "property") {
      if (header.elements.empty()) throw broken_header(line);
      header.elements.back().properties.push_back(property_in(words, line));
    }
    if (keyword == "comment" && words.word() == "TextureFile") header.texture = words.word();
  }
  header.size = at;
  return header;
}

double PlyStream::next(PlyType type) {
  if (format_ == PlyHeader::Format::Text) {
    const std::string_view word = text_.word();
    const auto value = number_in(word);
    if (value) return *value;
    if (!word.empty()) {
      throw ImportFailure{"\"" + std::string(word.substr(0, 40)) + "\" stands where a number should",
                          "export it again"};
    }
    ended_ = true;
    return 0;
  }
  const std::size_t size = size_of(type);
  if (data_.size() < size) {
    data_ = {};
    ended_ = true;
    return 0;
  }
  std::array<char, 8> bytes{};
  std::copy_n(data_.begin(), size, bytes.begin());
  data_.remove_prefix(size);
  if (format_ == PlyHeader::Format::BigEndian)
    std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  switch (type) {
    case PlyType::Int8:
      return read_as<std::int8_t>(bytes.data());
    case PlyType::Uint8:
      return read_as<std::uint8_t>(bytes.data());
    case PlyType::Int16:
      return read_as<std::int16_t>(bytes.data());
    case PlyType::Uint16:
      return read_as<std::uint16_t>(bytes.data());
    case PlyType::Int32:
      return read_as<std::int32_t>(bytes.data());
    case PlyType::Uint32:
      return read_as<std::uint32_t>(bytes.data());
    case PlyType::Float:
      return read_as<float>(bytes.data());
    case PlyType::Double:
      return read_as<double>(bytes.data());
  }
  return 0;
}

std::uint64_t PlyStream::bytes_left() const {
  return format_ == PlyHeader::Format::Text ? text_.rest().size() : data_.size();
}

double ply_full_value(PlyType type) {
  switch (type) {
    case PlyType::Int8:
      return 127;
    case PlyType::Uint8:
      return 255;
    case PlyType::Int16:
      return 32767;
    case PlyType::Uint16:
      return 65535;
    case PlyType::Int32:
    case PlyType::Uint32:
      return 255;
    default:
      return 1;
  }
}

}  // namespace rinkaku::mesh

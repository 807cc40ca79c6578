#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace rinkaku::mesh {

/// Puts values one after the other, as they lie in memory; lengths before texts and arrays.
class MessageWriter {
 public:
  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { append(&value, sizeof(T)); }
  void put(const std::string& text) {
    put(static_cast<std::uint64_t>(text.size()));
    append(text.data(), text.size());
  }
  template <typename T>
  void put_array(const std::vector<T>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    append(values.data(), values.size() * sizeof(T));
  }
  void put_texts(const std::vector<std::string>& texts) {
    put(static_cast<std::uint64_t>(texts.size()));
    for (const std::string& text : texts) put(text);
  }
  std::vector<std::uint8_t> bytes;

 private:
  void append(const void* data, std::size_t size) {
    if (size == 0) return;
    const std::size_t before = bytes.size();
    bytes.resize(before + size);
    std::memcpy(bytes.data() + before, data, size);
  }
};

/// Reads what a MessageWriter wrote; after the first thing that is not there, `good` is false and zeros follow.
class MessageReader {
 public:
  explicit MessageReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  template <typename T>
  requires std::is_trivially_copyable_v<T> T get() {
    T value{};
    copy(&value, sizeof(T));
    return value;
  }
  std::string get_text() {
    std::string text(length(1), '\0');
    copy(text.data(), text.size());
    return text;
  }
  template <typename T>
  std::vector<T> get_array() {
    std::vector<T> values(length(sizeof(T)));
    copy(values.data(), values.size() * sizeof(T));
    return values;
  }
  std::vector<std::string> get_texts() {
    std::vector<std::string> texts(length(sizeof(std::uint64_t)));
    for (std::string& text : texts) text = get_text();
    return texts;
  }
  /// A number of elements that takes at least `least_bytes` each.
  std::size_t length(std::size_t least_bytes) {
    const auto count = get<std::uint64_t>();
    if (count > rest_.size() / least_bytes) {
      good_ = false;
      return 0;
    }
    return static_cast<std::size_t>(count);
  }
  bool good() const { return good_; }
  bool at_end() const { return rest_.empty(); }

 private:
  void copy(void* to, std::size_t size) {
    if (size > rest_.size()) {
      good_ = false;
      return;
    }
    if (size == 0) return;
    std::memcpy(to, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  std::span<const std::uint8_t> rest_;
  bool good_ = true;
};

}  // namespace rinkaku::mesh

#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace rinkaku::mesh {

/// Walks through the words of a text file, whatever its line ends and the user's locale.
class TextCursor {
 public:
  /// `comment`: what starts a comment that runs to the end of its line; 0 for none.
  explicit TextCursor(std::string_view text, char comment = 0) : text_(text), comment_(comment) {}

  /// The next word; empty at the end.
  std::string_view word() {
    skip_blanks(true);
    return rest_of_word();
  }
  /// The next word on this line; empty if there is none.
  std::string_view word_on_line() {
    skip_blanks(false);
    return rest_of_word();
  }
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  std::size_t position() const { return at_; }
  std::string_view rest() const { return text_.substr(at_); }

 private:
  void skip_blanks(bool lines) {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == comment_ && comment_ != 0) {
        skip_line();
      } else if (c == ' ' || c == '\t' || c == '\r' || (lines && c == '\n')) {
        ++at_;
      } else {
        return;
      }
    }
  }
  std::string_view rest_of_word() {
    const std::size_t start = at_;
    while (at_ < text_.size() && text_[at_] != ' ' && text_[at_] != '\t' && text_[at_] != '\r' && text_[at_] != '\n') {
      ++at_;
    }
    return text_.substr(start, at_ - start);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  char comment_;
};

/// A whole word as a number; empty if it is none.
inline std::optional<double> number_in(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failed != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

inline std::optional<std::uint64_t> count_in(std::string_view word) {
  std::uint64_t value = 0;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failed != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

}  // namespace rinkaku::mesh

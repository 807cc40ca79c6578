#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace rinkaku {

/// What the program tells its user when it cannot go on: one line that says where, what, and how to mend it.
///
/// `Kind::Input` means that the call or its files are wrong (exit status 2), `Kind::Runtime` that something failed
/// while running (exit status 1). An expected absence in a frame is never an Error but an empty std::optional.
class Error : public std::runtime_error {
 public:
  enum class Kind { Input, Runtime };

  /// The line reads "where: what; remedy". `where` is a file (with line and column where known) or a device; `where`
  /// and `remedy` may be empty.
  Error(Kind kind, std::string_view where, std::string_view what, std::string_view remedy = {});

  Kind kind() const { return kind_; }
  int exit_status() const { return kind_ == Kind::Input ? 2 : 1; }

 private:
  Kind kind_;
};

/// The call or one of its files is wrong.
inline Error input_error(std::string_view where, std::string_view what, std::string_view remedy = {}) {
  return {Error::Kind::Input, where, what, remedy};
}

/// Something failed while running.
inline Error runtime_failure(std::string_view where, std::string_view what, std::string_view remedy = {}) {
  return {Error::Kind::Runtime, where, what, remedy};
}

/// How a message shows a text of a file: control characters as '?', cut after 60 bytes.
std::string quotable(std::string_view text);

}  // namespace rinkaku

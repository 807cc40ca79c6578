#pragma once

#include <atomic>

namespace rinkaku::matte {

/// What this folder has made so far in this process, so that tests can tell that a scene without filmed things makes
/// none of it.
struct Made {
  int things = 0;    ///< Foreground, with its estimators
  int networks = 0;  ///< models read
  int mattes = 0;    ///< begun
  bool operator==(const Made&) const = default;
};
Made made();

/// The counters behind made(); for the files of this folder.
struct Counters {
  std::atomic<int> things{0}, networks{0}, mattes{0};
};
Counters& counters();

}  // namespace rinkaku::matte

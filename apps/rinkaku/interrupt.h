#pragma once

#include <atomic>

namespace rinkaku::app {

/// Becomes true at the first Ctrl-C (SIGINT) or SIGTERM, so that what was rendered can be finished; a second one ends
/// the program at once. Installs the handlers when first called.
const std::atomic<bool>& interrupted();

}  // namespace rinkaku::app

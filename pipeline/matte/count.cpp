#include "pipeline/matte/count.h"

namespace rinkaku::matte {

Counters& counters() {
  static Counters all;
  return all;
}

Made made() {
  const Counters& c = counters();
  return {c.things, c.networks, c.mattes};
}

}  // namespace rinkaku::matte

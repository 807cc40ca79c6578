// Whatever bytes the import worker sends, they are refused or make a mesh that can be used.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

#include "mesh/import_message.h"
#include "mesh/moving_mesh.h"
#include "mesh/topology.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rinkaku::mesh;
  std::optional<ImportMessage> message = decode({data, size});
  if (!message || !message->imported) return 0;
  Imported& imported = *message->imported;
  if (!decode(encode(imported))) std::abort();
  const Topology known = topology(imported.mesh);
  if (imported.rig.animations.empty()) return 0;
  MovingMesh moving(imported.mesh, known, std::move(imported.rig), {});
  for (const double time_s : {-1.0, 0.4, 1e9}) moving.move_to(time_s);
  return 0;
}

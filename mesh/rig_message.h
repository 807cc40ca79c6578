#pragma once

#include <cstdint>

#include "mesh/message_stream.h"
#include "mesh/rig.h"

namespace rinkaku::mesh {

/// A rig as part of the import worker's message.
void put_rig(MessageWriter& out, const Rig& rig);
Rig get_rig(MessageReader& in);

/// Whether every index names something of a mesh with so many points, parents come before their children, keys are in
/// order and every number is finite: then pose() and Skin take it. An empty rig is sound.
bool sound(const Rig& rig, std::uint32_t point_count);

}  // namespace rinkaku::mesh

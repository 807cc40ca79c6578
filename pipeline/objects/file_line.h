#pragma once

#include <filesystem>

#include "mesh/mesh.h"
#include "pipeline/scene/object.h"

namespace rinkaku::pipeline {

/// The object with what its mesh's file says about its outline (VRM's MToon), as far as the scene leaves it open: the
/// width of the widest material, what the others have of it, and the colour of most of the surface. An object without
/// an outline in the scene gets none. Of materials that count in another unit than most of the surface, the width is
/// the widest's. The mesh's unit is `unit_m` metres in the world.
/// `camera` is the plate's: widths may count in its picture's height. Throws Error (Input) if it is
/// needed and can't be read.
ObjectScene with_file_line(ObjectScene object, const mesh::Mesh& mesh, double unit_m,
                           const std::filesystem::path& camera);

}  // namespace rinkaku::pipeline

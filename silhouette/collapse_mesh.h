#pragma once

#include <cstdint>

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <OpenMesh/Core/Mesh/Attributes.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <glm/vec3.hpp>

namespace rinkaku::silhouette {

struct CollapseTraits : OpenMesh::DefaultTraitsDouble {
  VertexAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::None);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};

/// The half-edge mesh that front meshes are collapsed in.
using CollapseMesh = OpenMesh::TriMesh_ArrayKernelT<CollapseTraits>;

inline glm::dvec3 place_of(const CollapseMesh& mesh, CollapseMesh::VertexHandle v) {
  const auto& p = mesh.point(v);
  return {p[0], p[1], p[2]};
}

}  // namespace rinkaku::silhouette

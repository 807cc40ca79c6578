#include "report/sections/plain_curvature.h"

#include <cmath>

#include <gtest/gtest.h>

#include "mesh/topology.h"
#include "outline/curvature.h"
#include "report/sections/shapes.h"

namespace rinkaku::report {
namespace {

// Plain loops in double give what the product's curvature gives, which computes in float or sums by other roads.
TEST(PlainCurvature, IsTheProducts) {
  const mesh::Topology topology = mesh::topology(Torus{}.mesh(60, 42));
  PlainCurvature<double> plain(topology.points, topology.faces);
  PlainCurvature<float> coarse(topology.points, topology.faces);
  using Method = outline::CurvatureMethod;
  for (const Method method : {Method::Icnc, Method::Meyer}) {
    method == Method::Icnc ? plain.corrected() : plain.cotangents();
    method == Method::Icnc ? coarse.corrected() : coarse.cotangents();
    const outline::Curvature found = outline::curvature(topology, method);
    for (std::size_t p = 0; p < topology.points.size(); ++p) {
      // Curvatures are of some 1; positions in float move angles of cells 0.1 across by 1e-6 and more.
      EXPECT_NEAR(plain.mean(p), found.mean[p], 2e-4);
      EXPECT_NEAR(plain.gauss(p), found.gauss[p], 2e-3);
      EXPECT_NEAR(coarse.mean(p), plain.mean(p), 2e-4);
    }
  }
}

}  // namespace
}  // namespace rinkaku::report

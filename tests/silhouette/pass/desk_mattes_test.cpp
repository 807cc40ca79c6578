// A recording that the repository ships: the object's region mattes along a filmed camera's way.
#include <set>

#include "mesh/bounds.h"
#include "mesh/import.h"
#include "pipeline/objects/placement.h"
#include "pipeline/scene/scene.h"
#include "pipeline/track/camera_file.h"
#include "pipeline/track/pose_file.h"
#include "silhouette/bake.h"
#include "silhouette/region_lists.h"
#include "silhouette/verify/matte_comparison.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

class RecordedMattes : public test::GlTest {};

TEST_F(RecordedMattes, EqualTheWholeMeshsInEveryFrameOfTheDesk) {
  const std::filesystem::path desk = std::filesystem::path(RINKAKU_SOURCE_DIR) / "recordings" / "desk";
  const pipeline::Scene scene = pipeline::read_scene(desk / "scene.toml");
  const mesh::Imported mascot = mesh::import(scene.objects.at(0).mesh);
  const Surface surface = test::surface_of(mascot.mesh);
  BakeOptions options;
  options.space = RegionLayout{4, 1, 1.5};  // few regions: the camera moves little, and baking takes the time
  const auto file =
      std::make_shared<const RegionFile>(RegionFile::from_memory(bake(surface, options)->file, "mascot.rgn"));
  RegionListsOptions at_once;
  at_once.decode_at_once = true;
  RegionLists lists(file, at_once);

  CheckView view;
  view.world_from_object =
      pipeline::world_from_object(scene.objects[0], mesh::bounding_box(mascot.mesh.positions), mascot.summary.up);
  view.view.camera = track::read_camera(desk / "camera.yml");
  MatteComparison comparison(surface);
  std::set<std::uint32_t> regions;
  int frames = 0;
  const track::PoseTable poses = track::read_poses(desk / "poses.csv");
  for (const track::FilePose& pose : poses.poses()) {
    view.view.camera_from_world = inverse(pose.world_from_camera);
    const glm::dvec4 eye(pose.world_from_camera.translation_m, 1);
    const RegionList list = lists.at(glm::dvec3(glm::inverse(view.world_from_object) * eye));
    ASSERT_FALSE(list.whole) << "the camera stays outside the inner radius";
    regions.insert(list.region);
    const MatteDifference difference = comparison.compare(view, list.indices);
    EXPECT_EQ(difference.mismatch_px, 0) << "frame " << frames;
    EXPECT_TRUE(difference.has_edge);
    ++frames;
  }
  EXPECT_EQ(frames, 150);
  EXPECT_GT(regions.size(), 1u) << "the camera moves through several regions";
}

}  // namespace
}  // namespace rinkaku::silhouette

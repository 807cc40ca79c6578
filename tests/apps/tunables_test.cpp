// Every slider's ends are values that a scene takes.
#include "apps/rinkaku/viewer/tunables.h"

#include <gtest/gtest.h>

#include "apps/rinkaku/viewer/scene_file.h"
#include "tests/apps/cli_tools.h"

namespace rinkaku::app {
namespace {

const std::string scene = test::plate + test::locked + test::cube +
                          "outline = { method = \"curvature\" }\nfluffy = true\n"
                          "[[foreground]]\nmethod = [\"chroma\", \"difference\"]\ndistance_m = 1\n"
                          "[background]\ncolour = \"#102030\"\n"
                          "[water]\n"
                          "[[water.surface]]\noutline_m = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]\n"
                          "[[water.spray]]\nfrom_m = [0, 0, 0]\nto_m = [1, 0, 0]\n";

std::vector<std::string> values_of(const Tunable& t) {
  using Kind = Tunable::Kind;
  switch (t.kind) {
    case Kind::Number:
      return {std::to_string(t.least), std::to_string(t.most)};
    case Kind::Whole:
      return {std::to_string(static_cast<int>(t.least)), std::to_string(static_cast<int>(t.most))};
    case Kind::Flag:
      return {"true", "false"};
    case Kind::Vector:
      return {"[0.1, 0.2, 0.3]"};
    case Kind::Colour:
      return {"\"#8040ff\""};
    case Kind::Choice: {
      std::vector<std::string> words;
      for (const std::string& word : t.choices) words.push_back("\"" + word + "\"");
      return words;
    }
  }
  return {};
}

struct Group {
  std::string name;
  const std::vector<Tunable>& tunables;
  toml::Path above;
  SceneFile::Effect effect;  // at most
};
class TunablesTest : public testing::TestWithParam<Group> {};

TEST_P(TunablesTest, ScenesTakeBothEnds) {
  const test::ShotFolder folder;
  folder.write("in.mkv", "");
  folder.write("scene.toml", scene);
  for (const Tunable& tunable : GetParam().tunables) {
    toml::Path path = GetParam().above;
    if (*tunable.table != '\0') path.push_back({tunable.table});
    path.push_back({tunable.key});
    for (const std::string& value : values_of(tunable)) {
      SceneFile file(folder / "scene.toml", {});
      try {
        EXPECT_LE(file.set(path, value), GetParam().effect) << tunable.label;
      } catch (const std::exception& error) {
        ADD_FAILURE() << tunable.label << " = " << value << ": " << error.what();
      }
      ASSERT_NE(file.find(path), nullptr) << tunable.label;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, TunablesTest,
    testing::Values(Group{"object", object_tunables(), {{"object"}}, SceneFile::Effect::Redraw},
                    Group{"water", water_tunables(), {{"water"}}, SceneFile::Effect::Redraw},
                    Group{"surface", water_surface_tunables(), {{"water"}, {"surface"}}, SceneFile::Effect::Redraw},
                    Group{"spray", water_spray_tunables(), {{"water"}, {"spray"}}, SceneFile::Effect::Redraw},
                    Group{"foreground", foreground_tunables(), {{"foreground"}}, SceneFile::Effect::Restart},
                    Group{"scene", scene_tunables(), {}, SceneFile::Effect::Restart}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace rinkaku::app

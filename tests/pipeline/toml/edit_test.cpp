#include "pipeline/toml/edit.h"

#include <gtest/gtest.h>

#include "pipeline/frame/error.h"

namespace rinkaku::toml {
namespace {

const std::string text =
    "# a scene\n"
    "[plate]\n"
    "video = \"a # b.mp4\" # the film\n"
    "\n"
    "[[object]]\n"
    "mesh = 'kätzchen.obj'\n"
    "position_m = [1, # right\n"
    "  2, 3]  # up\n"
    "outline = { width_px = 3, colour = \"#ff0000\" } # its line\n"
    "\n"
    "[[object]]   # the second\n"
    "mesh = \"b.obj\"\n"
    "outline = true\n"
    "[object.toon]\n"
    "bands = 3\n";

std::string replaced(std::string in, const std::string& old, const std::string& by) {
  return in.replace(in.find(old), old.size(), by);
}

TEST(TomlEdit, ReplacesAValueAndNothingElse) {
  EXPECT_EQ(with_value(text, {{"object"}, {"outline"}, {"width_px"}}, "4.5"),
            replaced(text, "width_px = 3,", "width_px = 4.5,"));
  EXPECT_EQ(with_value(text, {{"object"}, {"outline"}, {"colour"}}, "\"#00ff00\""),
            replaced(text, "#ff0000", "#00ff00"));
  EXPECT_EQ(with_value(text, {{"plate"}, {"video"}}, "\"c.mp4\""), replaced(text, "\"a # b.mp4\"", "\"c.mp4\""));
  EXPECT_EQ(with_value(text, {{"object"}, {"position_m"}}, "[0, 0, 0]"),
            replaced(text, "[1, # right\n  2, 3]", "[0, 0, 0]"));
  EXPECT_EQ(with_value(text, {{"object", 1}, {"toon"}, {"bands"}}, "5"), replaced(text, "bands = 3", "bands = 5"));
}

TEST(TomlEdit, CountsCharactersNotBytes) {
  // The umlaut takes two bytes and stands before the value.
  const std::string line = "[a]\nb = { ä = \"öö\", c = 1 }\n";
  // Bare keys are ASCII: quote it.
  const std::string quoted = replaced(line, "ä", "\"ä\"");
  EXPECT_EQ(with_value(quoted, {{"a"}, {"b"}, {"c"}}, "2"), replaced(quoted, "c = 1", "c = 2"));
}

TEST(TomlEdit, AddsWhatIsMissing) {
  EXPECT_EQ(with_value(text, {{"object"}, {"outline"}, {"max_px"}}, "9"),
            replaced(text, "\"#ff0000\" }", "\"#ff0000\", max_px = 9 }"));
  EXPECT_EQ(with_value(text, {{"object", 1}, {"outline"}, {"width_px"}}, "2"),
            replaced(text, "outline = true", "outline = { width_px = 2 }"));
  EXPECT_EQ(with_value(text, {{"object", 1}, {"toon"}, {"shade"}}, "1"),
            replaced(text, "[object.toon]\n", "[object.toon]\nshade = 1\n"));
  EXPECT_EQ(with_value(text, {{"object", 1}, {"height_m"}}, "0.2"),
            replaced(text, "# the second\n", "# the second\nheight_m = 0.2\n"));
  EXPECT_EQ(with_value(text, {{"light"}, {"direction"}}, "[1, 0, 0]"), text + "\n[light]\ndirection = [1, 0, 0]\n");
}

const std::string arrows =
    "[[water.surface]] # a brook\n"
    "outline = 1\n"
    "[[water.surface.arrow]] # the first\n"
    "from = [1, # x\n"
    "  2] # y\n"
    "\n"
    "[[water.surface]]\n"
    "arrow = [{ from = 3 }, # third\n"
    "  { from = 4 }]\n"
    "[[water.surface]]\n"
    "outline = 2 # still\n"
    "# the end\n"
    "[output]\n";

TEST(TomlEdit, AddsTablesAsTheirNeighboursAreWritten) {
  const std::vector<std::string> entries = {"from = 7", "to = 8"};
  EXPECT_EQ(with_table(arrows, {{"water"}, {"surface"}, {"arrow"}}, entries),
            replaced(arrows, "  2] # y\n", "  2] # y\n[[water.surface.arrow]]\nfrom = 7\nto = 8\n"));
  EXPECT_EQ(with_table(arrows, {{"water"}, {"surface", 1}, {"arrow"}}, entries),
            replaced(arrows, "{ from = 4 }]", "{ from = 4 }, { from = 7, to = 8 }]"));
  EXPECT_EQ(with_table(arrows, {{"water"}, {"surface", 2}, {"arrow"}}, entries),
            replaced(arrows, "# still\n", "# still\n[[water.surface.arrow]]\nfrom = 7\nto = 8\n"));
  EXPECT_EQ(with_table("[a]\nb = { c = 1 }\n", {{"a"}, {"b"}, {"d"}}, entries),
            "[a]\nb = { c = 1, d = [{ from = 7, to = 8 }] }\n");
  EXPECT_EQ(with_table("[a]\nd = [] # none\n", {{"a"}, {"d"}}, entries), "[a]\nd = [{ from = 7, to = 8 }] # none\n");
  EXPECT_EQ(with_table("[a]", {{"a"}, {"d"}}, entries), "[a]\n[[a.d]]\nfrom = 7\nto = 8");
  EXPECT_THROW(with_table(arrows, {{"river"}, {"arrow"}}, entries), Error);
  EXPECT_THROW(with_table("[a]\nd = 1\n", {{"a"}, {"d"}}, entries), Error);
}

TEST(TomlEdit, TakesTablesAwayAndNothingElse) {
  EXPECT_EQ(without_table(arrows, {{"water"}, {"surface"}, {"arrow"}}),
            replaced(arrows, "[[water.surface.arrow]] # the first\nfrom = [1, # x\n  2] # y\n", ""));
  EXPECT_EQ(without_table("a = { d = [{ e = 1 }, { e = 2 }] }", {{"a"}, {"d"}}), "a = { d = [{ e = 2 }] }");
  EXPECT_EQ(without_table("a = { d = [{ e = 1 }, { e = 2 }] }", {{"a"}, {"d", 1}}), "a = { d = [{ e = 1 }] }");
  EXPECT_EQ(without_table("a = { d = [{ e = 1 }] }", {{"a"}, {"d"}}), "a = { d = [] }");
  EXPECT_THROW(without_table(arrows, {{"water"}, {"surface"}, {"arrow", 1}}), Error);
}

// A comment may stand between a table and the comma before it.
TEST(TomlEdit, WhatIsLeftWhenATableGoesReadsBack) {
  const Path gone = {{"water"}, {"surface", 1}, {"arrow", 1}};
  const std::string left = without_table(arrows, gone);
  const Value document = parse_text(left, "left");
  EXPECT_EQ(find(document, gone), nullptr);
  EXPECT_NE(find(document, {{"water"}, {"surface", 1}, {"arrow"}, {"from"}}), nullptr);
  EXPECT_NE(left.find("# third"), std::string::npos);
}

TEST(TomlEdit, EveryEditReadsBackAsWritten) {
  const std::vector<Path> places = {{{"object"}, {"outline"}, {"width_px"}},
                                    {{"object"}, {"toon"}, {"bands"}},
                                    {{"object", 1}, {"outline"}, {"taper_px"}},
                                    {{"object", 1}, {"rotation"}},
                                    {{"light"}, {"strength"}},
                                    {{"plate"}, {"fps"}}};
  std::string edited = text;
  for (const Path& place : places) edited = with_value(edited, place, "7");
  const Value document = parse_text(edited, "edited");
  for (const Path& place : places) {
    const Value* value = find(document, place);
    ASSERT_NE(value, nullptr) << place.back().key;
    EXPECT_EQ(std::get<std::int64_t>(value->held), 7) << place.back().key;
  }
  for (const char* comment : {"# a scene", "# the film", "# right", "# up", "# its line", "# the second"}) {
    EXPECT_NE(edited.find(comment), std::string::npos) << comment;
  }
}

TEST(TomlEdit, WhatIsNoTableIsRefused) {
  EXPECT_THROW(with_value(text, {{"plate"}, {"video"}, {"x"}}, "1"), Error);
  EXPECT_THROW(with_value("[", {{"a"}, {"b"}}, "1"), Error);
}

TEST(TomlEdit, TellsWhichTablesChanged) {
  const Value before = parse_text(text, "a");
  EXPECT_TRUE(changed_keys(before, parse_text("# other comments\n" + replaced(text, "# up", "#"), "b")).empty());
  const Value wider = parse_text(with_value(text, {{"object"}, {"outline"}, {"width_px"}}, "4"), "b");
  EXPECT_EQ(changed_keys(before, wider), std::vector<std::string>{"object"});
  const Value lit = parse_text(with_value(text, {{"light"}, {"direction"}}, "[1, 0, 0]"), "b");
  EXPECT_EQ(changed_keys(before, lit), std::vector<std::string>{"light"});
  EXPECT_EQ(changed_keys(lit, before), std::vector<std::string>{"light"});
}

}  // namespace
}  // namespace rinkaku::toml

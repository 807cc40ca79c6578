#include "report/page.h"

#include <gtest/gtest.h>

namespace rinkaku::report {
namespace {

TEST(Escaped, LeavesNoMarkup) {
  EXPECT_EQ(escaped("a < b && c > \"d\" 'e'"), "a &lt; b &amp;&amp; c &gt; &quot;d&quot; &#39;e&#39;");
  EXPECT_EQ(escaped("größe µm"), "größe µm");
  EXPECT_EQ(escaped(""), "");
}

TEST(Page, ShowsWhatWasMeasuredAndWhatFailed) {
  Page page;
  page.facts = {{"Processor", "<fast>"}};
  PageSection good;
  good.id = "good", good.title = "Good & well";
  good.section.intro = "On a < b.";
  good.section.table = {{{"m", "M"}}, {{std::string("<b>")}, {0.25}}};
  Plot plot;
  plot.title = "A plot", plot.says = "It shows that.";
  good.section.plots = {plot};
  good.svgs = {"<svg></svg>"};
  PageSection bad;
  bad.id = "bad", bad.title = "Bad", bad.failed = "no <file>";
  page.sections = {good, bad};
  const std::string text = html(page);
  for (const char* part : {"<svg></svg>", "It shows that.", "Good &amp; well", "<td class=\"text\">&lt;b&gt;</td>",
                           "<td>0.25</td>", "On a &lt; b.", "&lt;fast&gt;", "Not measured: no &lt;file&gt;",
                           "prefers-color-scheme: dark", "@media print", "width=device-width"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(text.find("<script"), std::string::npos);
  EXPECT_EQ(text.find("http"), std::string::npos) << "nothing is loaded from elsewhere";
}

// A browser passes over a rule that begins with what is no CSS, and the rules' colours are defined in the first.
TEST(Page, StyleBeginsWithTheRuleThatDefinesColours) {
  const std::string text = html({});
  const std::string open = "<style>\n/* report/page.css */\n:root {";
  const std::size_t style = text.find(open);
  ASSERT_NE(style, std::string::npos);
  const std::string rule = text.substr(style, text.find('}', style) - style);
  for (std::size_t at = text.find("var("); at != std::string::npos; at = text.find("var(", at + 1)) {
    const std::string name = text.substr(at + 4, text.find(')', at) - at - 4);
    EXPECT_NE(rule.find(name + ":"), std::string::npos) << name << " is used and not defined";
  }
}

}  // namespace
}  // namespace rinkaku::report

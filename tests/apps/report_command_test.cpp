#include <algorithm>
#include <sstream>

#include "tests/apps/cli_tools.h"

namespace rinkaku {
namespace {

using test::contains;

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

bool plotter_is_there() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

class ReportCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (!plotter_is_there()) GTEST_SKIP() << "gnuplot isn't installed";
  }
  test::ShotFolder folder_;
};

TEST_F(ReportCommand, WritesAPageByItselfAndATableForEachSection) {
  const test::CliResult got = test::run_rinkaku(folder_, "report -o out --quick --sections curvature,water --json");
  ASSERT_EQ(got.status, 0) << got.err;
  const auto told = test::json_of(got.out);
  ASSERT_EQ(told.at("sections").size(), 2u);
  EXPECT_EQ(told.at("sections")[0].at("failed"), "");

  const auto files = test::contents(folder_.path() / "out");
  ASSERT_EQ(files.size(), 3u);
  const std::string& page = files.at("index.html");
  for (const char* part : {"<svg", "Curvature", "Processor", "OpenCV", "Seed", "On the front: ", "curvature.csv"}) {
    EXPECT_TRUE(contains(page, part)) << part;
  }
  EXPECT_FALSE(contains(page, "<script")) << "nothing runs in the page";
  EXPECT_FALSE(contains(page, "<link")) << "nothing is loaded";
  // Four plots: three shapes and the water. gnuplot names its marks alike in every one; here they may not clash.
  std::size_t plots = 0;
  for (std::size_t at = 0; (at = page.find("<svg", at)) != std::string::npos; ++at) ++plots;
  EXPECT_EQ(plots, 4u);
  EXPECT_FALSE(contains(page, "id='gpPt0'"));
  EXPECT_FALSE(contains(page, "'#gpPt"));
}

TEST_F(ReportCommand, TablesHoldWhatIsKnownOfTheMethods) {
  const test::CliResult got = test::run_rinkaku(folder_, "report -o out --quick --sections curvature,water");
  ASSERT_EQ(got.status, 0) << got.err;
  const auto curvature = rows_of(test::text_of(folder_.path() / "out/curvature.csv"));
  ASSERT_GT(curvature.size(), 1u);
  EXPECT_EQ(curvature[0][0], "shape");
  // All methods converge on even tori: sixteen times the points, a tenth of the error at most.
  for (const char* method : {"meyer", "icnc", "auto", "quadric"}) {
    std::vector<double> errors;
    for (const auto& row : curvature) {
      if (row[0] == "torus" && row[1] == method) errors.push_back(std::stod(row[3]));
    }
    ASSERT_EQ(errors.size(), 4u) << method;
    EXPECT_LT(errors[3], errors[1] / 10) << method;
  }
  // Euler's error falls as the step, that of RK2 as its square: from 0.1 s to 0.05 s by 2 and by 4.
  const auto water = rows_of(test::text_of(folder_.path() / "out/water.csv"));
  const auto error_of = [&water](const std::string& method, double step_s) {
    for (const auto& row : water) {
      if (row[0] == method && std::stod(row[1]) == step_s) return std::stod(row[2]);
    }
    return -1.0;
  };
  EXPECT_NEAR(error_of("Euler", 0.1) / error_of("Euler", 0.05), 2, 0.2);  // terms of higher order
  EXPECT_NEAR(error_of("RK2", 0.1) / error_of("RK2", 0.05), 4, 0.4);
}

TEST_F(ReportCommand, ExactMattesDifferInNoPixel) {
  const test::CliResult got = test::run_rinkaku(folder_, "report -o out --quick --sections mattes");
  ASSERT_EQ(got.status, 0) << got.err;
  const auto rows = rows_of(test::text_of(folder_.path() / "out/mattes.csv"));
  int exact = 0, others = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::string& method = rows[i][0];
    const bool keeps = contains(method, "regions") || method == "cones" || method == "whole mesh";
    (keeps ? exact : others) += 1;
    if (keeps) {
      EXPECT_EQ(rows[i][3], "0") << method;
    } else {
      EXPECT_GT(std::stod(rows[i][3]), 0) << method << " knows nothing of the eye";
    }
  }
  EXPECT_GE(exact, 4);
  EXPECT_GE(others, 4);
}

TEST_F(ReportCommand, ExtremeCasesEndAsTheyShould) {
  const test::CliResult got = test::run_rinkaku(folder_, "report -o out --quick --sections extremes");
  ASSERT_EQ(got.status, 0) << got.err;
  const std::string table = test::text_of(folder_.path() / "out/extremes.csv");
  EXPECT_FALSE(contains(table, "WRONG")) << table;
  const auto times = [&table](const std::string& word) {
    int found = 0;
    for (std::size_t at = 0; (at = table.find(word, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  EXPECT_GE(times(",right,"), 40);
  EXPECT_GE(times(",refused,"), 10);
  EXPECT_TRUE(contains(test::text_of(folder_.path() / "out/index.html"), "cases ended as they should"));
}

TEST_F(ReportCommand, SectionThatCannotRunSaysSoAndTheOthersDo) {
  std::filesystem::create_directories(folder_.path() / "nothing");
  const test::CliResult got =
      test::run_rinkaku(folder_, "report -o out --quick --sections tracking,water --recordings nothing --json");
  ASSERT_EQ(got.status, 0) << got.err;
  EXPECT_TRUE(contains(got.err, "section tracking is left out")) << got.err;
  EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
  EXPECT_NE(test::json_of(got.out).at("sections")[0].at("failed"), "");
  EXPECT_TRUE(contains(test::text_of(folder_.path() / "out/index.html"), "Not measured: "));
  EXPECT_GT(rows_of(test::text_of(folder_.path() / "out/water.csv")).size(), 10u);
}

TEST_F(ReportCommand, BadCallsSayOneLineAndWriteNothing) {
  std::filesystem::create_directories(folder_.path() / "kept");
  folder_.write("kept/water.csv", "kept");
  const auto before = test::contents(folder_.path());
  const std::pair<const char*, const char*> calls[] = {
      {"report -o out --sections curvature,fancy", "there is no section 'fancy'"},
      {"report -o kept --sections water", "water.csv"},
      {"report -o kept/water.csv --sections water", "water.csv"},
      {"report -o out --recordings gone", "gone"},
      {"report -o out --seed -1", "--seed"},
      {"report", "--output"},
  };
  for (const auto& [call, part] : calls) {
    const test::CliResult got = test::run_rinkaku(folder_, call);
    EXPECT_EQ(got.status, 2) << call;
    EXPECT_TRUE(contains(got.err, part)) << call << ": " << got.err;
    EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
    EXPECT_EQ(test::contents(folder_.path()), before) << call;
  }
}

TEST_F(ReportCommand, InterruptedLeavesNothing) {
  const auto before = test::contents(folder_.path());
  const test::CliResult got =
      test::run_shell(folder_.path(),
                      "\"$RINKAKU\" report -o out --sections curvature & "
                      // Until it is no shell any more and listens: a shell starts what runs beside it with SIGINT
                      // ignored.
                      "until grep -q rinkaku /proc/$!/comm && grep -qE '^SigCgt:.*[2367abef]$' /proc/$!/status; "
                      "do sleep 0.05; done; "
                      "kill -INT $!; wait $!");
  EXPECT_EQ(got.status, 1) << got.err;
  EXPECT_TRUE(contains(got.err, "interrupted")) << got.err;
  EXPECT_EQ(test::contents(folder_.path()), before);
}

TEST(ReportWithoutPlotter, SaysWhatToInstall) {
  const test::ShotFolder folder;
  const test::CliResult got = test::run_shell(folder.path(), "PATH=/nowhere \"$RINKAKU\" report -o out --quick");
  EXPECT_EQ(got.status, 2);
  EXPECT_TRUE(contains(got.err, "gnuplot-nox")) << got.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace rinkaku

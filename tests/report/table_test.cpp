#include "report/table.h"

#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

namespace rinkaku::report {
namespace {

TEST(Csv, QuotesTextsThatNeedItAndLeavesOutWhatIsNotKnown) {
  Table table;
  table.columns = {{"method", "Method"}, {"time_ms", "Time, ms"}};
  table.rows = {{std::string("plain"), 1.5},
                {std::string("a,b"), std::monostate{}},
                {std::string("say \"x\"\nagain"), std::numeric_limits<double>::infinity()},
                {std::string(""), std::nan("")}};
  EXPECT_EQ(csv(table), "method,time_ms\nplain,1.5\n\"a,b\",\n\"say \"\"x\"\"\nagain\",\n,\n");
}

TEST(Csv, NumbersReadBackExactly) {
  for (const double value : {0.1, 1.0 / 3, 6.02e23, -5e-324, 123456789.123456789, 0.0}) {
    const std::string text = csv({{{"v", "v"}}, {{value}}});
    EXPECT_EQ(std::strtod(text.c_str() + 2, nullptr), value) << text;
  }
}

TEST(Readable, HasFourSignificantDigitsAndNoIdleZeros) {
  EXPECT_EQ(readable(0), "0");
  EXPECT_EQ(readable(3), "3");
  EXPECT_EQ(readable(1234567), "1234567");
  EXPECT_EQ(readable(12.3456), "12.35");
  EXPECT_EQ(readable(-0.00123456), "-0.001235");
  EXPECT_EQ(readable(0.000012), "1.20e-05");
  EXPECT_EQ(readable(0.5), "0.5");
  EXPECT_EQ(readable(std::nan("")), "-");
}

}  // namespace
}  // namespace rinkaku::report

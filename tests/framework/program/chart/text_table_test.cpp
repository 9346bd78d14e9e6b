#include "framework/program/chart/text_table.hpp"

#include <gmock/gmock.h>

namespace cairn {
namespace {

using testing::ElementsAre;

const std::string kPage = R"(# Page

| key | meaning |
|---|---|

## recognition: odometry error

| share | worlds | F1 |
|---:|---:|---:|
| 0.01 | 1 | 1.000 (0.566 - 1.000) |
| 0.03 | 1 | |

text | with a bar

#### surfaces
| of | time |
|---|---:|
| smooth | 0.5 +- 0.1 |
)";

TEST(TextTables, AreReadWithTheHeadingOfTheirSection) {
  const std::vector<TextTable> tables = tables_of(kPage);
  ASSERT_EQ(tables.size(), 3U);
  EXPECT_TRUE(tables[0].rows.empty());
  EXPECT_EQ(tables[1].heading, "odometry error");
  EXPECT_THAT(tables[1].columns, ElementsAre("share", "worlds", "F1"));
  EXPECT_THAT(tables[1].rows,
              ElementsAre(ElementsAre("0.01", "1", "1.000 (0.566 - 1.000)"), ElementsAre("0.03", "1", "")));
  EXPECT_EQ(tables[2].heading, "surfaces");
  EXPECT_THAT(tables[2].rows, ElementsAre(ElementsAre("smooth", "0.5 +- 0.1")));
}

TEST(TextTables, CellsAreNumbersWithOrWithoutAnInterval) {
  EXPECT_EQ(value_of("0.25")->value, 0.25);
  EXPECT_FALSE(value_of("0.25")->interval);
  EXPECT_EQ(value_of("1.000 (0.566 - 0.9)")->value, 1.0);
  EXPECT_EQ(value_of("1.000 (0.566 - 0.9)")->interval, (std::pair{0.566, 0.9}));
  EXPECT_EQ(value_of("-2 (-3 - -1)")->interval, (std::pair{-3.0, -1.0}));
  EXPECT_EQ(value_of("0.5 +- 0.125")->interval, (std::pair{0.375, 0.625}));
  for (const char* none : {"", "smooth", "1 of 2", "0.5 (0.1)", "0.5 (a - b)", "0.5 +- x"})
    EXPECT_FALSE(value_of(none)) << none;
}

}  // namespace
}  // namespace cairn

// `cairn chart`: the charts of an experiment's tables, made again without the experiment.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::HasSubstr;

const std::string kTables = R"(## recognition: odometry error

| share | worlds | F1 |
|---:|---:|---:|
| 0.01 | 1 | 1.000 (0.566 - 1.000) |
| 0.03 | 1 | 0.800 (0.376 - 0.964) |

## recognition: surfaces

| smooth | F1 |
|---|---:|
| all | 0.5 |
| none | 0.9 |
)";

class ChartCommand : public ::testing::Test {
 protected:
  ChartCommand() { write_text(folder_ / "table.md", kTables); }
  [[nodiscard]] Finished draw(std::vector<std::string> more) const {
    more.insert(more.begin(), {"chart", (folder_ / "table.md").string(), "--out", (folder_ / "pictures").string()});
    return run_cairn(more);
  }
  const std::filesystem::path folder_ = fresh_folder("chart");
};

TEST_F(ChartCommand, DrawsEachTableIntoAPictureNamedAfterItsSection) {
  const Finished finished = draw({"--column", "F1", "--shares", "--prefix", "limits_"});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "pictures/limits_odometry_error.png"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "pictures/limits_surfaces.png"));
}

TEST_F(ChartCommand, AnUnknownColumnIsAnErrorWithTheNearestName) {
  const Finished finished = draw({"--column", "world"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("table.md: no table has a column \"world\" (did you mean \"worlds\"?)"));
}

TEST_F(ChartCommand, AFileWithoutATableOfNumbersIsAnError) {
  write_text(folder_ / "table.md", "# Nothing\n\n| a | b |\n|---|---|\n| x | y |\n");
  const Finished finished = draw({});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("table.md: holds no table with a column of numbers"));
  EXPECT_EQ(run_cairn({"chart", (folder_ / "none.md").string()}).exit_status, 2);
}

}  // namespace
}  // namespace cairn::testing_program

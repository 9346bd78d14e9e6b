// What a user sees whose recorded log is wrong: exit status 2 and a sentence with its line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string config(const std::string& path) {
  return source_folder() + "/config/" + path;
}

// Recorded tables that are wrong, each in its own way: two sonars, a time and a pose a line.
class BadLog : public testing::Test {
 protected:
  Finished run(const std::string& table) {
    write_text(folder_ / "log.txt", table);
    write_text(folder_ / "log.yaml",
               "mission: log\nrobot: " + config("robots/pioneer1.yaml") +
                   "\nsensor:\n  plugin: table_log\n  file: log.txt\n  time_column: 1\n  x_column: 2\n  y_column: 3\n"
                   "  heading_column: 4\n  first_range_column: 5\n  compass_from_pose: true\n"
                   "  sonars:\n    - {angle_deg: 90}\n    - {angle_deg: -90}\n"
                   "localizer: {plugin: odometry_compass}\nmap: {plugin: bayes}\n");
    return run_cairn({"run", (folder_ / "log.yaml").string(), "--out", (folder_ / "out").string()});
  }
  void expect_refused(const std::string& table, const std::string& line_and_column, const std::string& what) {
    const Finished finished = run(table);
    EXPECT_EQ(finished.exit_status, 2) << finished.out;
    EXPECT_THAT(finished.err, AllOf(HasSubstr("log.txt:" + line_and_column), HasSubstr(what)));
  }

  const std::string good_ = "0.0 0 0 0 1.0 1.2\n0.1 0.02 0 0 1.0 1.2\n";
  const std::filesystem::path folder_ = fresh_folder("bad_log");
};

TEST_F(BadLog, AGoodOneRuns) {
  EXPECT_EQ(run(good_).exit_status, 0);
}

TEST_F(BadLog, AnEmptyOneIsRefused) {
  expect_refused("", " ", "the log holds no observation");
}

TEST_F(BadLog, TimeThatGoesBackwardsIsRefusedWithItsLine) {
  expect_refused(good_ + "0.05 0.04 0 0 1.0 1.2\n", "3:1: ", "time goes backwards, from 0.1 s to 0.05 s");
}

TEST_F(BadLog, APoseThatIsNoNumberIsRefusedWithItsPlace) {
  expect_refused(good_ + "0.2 nan 0 0 1.0 1.2\n", "3:5: ", "must be finite");
}

TEST_F(BadLog, ALineCutShortIsRefusedWithItsLine) {
  expect_refused(good_ + "0.2 0.04 0 0 1.0\n", "3:", "the line has 5 columns, but column 6 is to be the range 2");
}

// A sonar that failed once is no reason to lose the drive.
TEST_F(BadLog, ARangeThatIsNoNumberIsAnInvalidReading) {
  const Finished finished = run(good_ + "0.2 0.04 0 0 nan 1.2\n");
  EXPECT_EQ(finished.exit_status, 0) << finished.err;
}

}  // namespace
}  // namespace cairn::testing_program

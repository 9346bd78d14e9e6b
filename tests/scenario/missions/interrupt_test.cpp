#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

// Paced to the clock the mission would last minutes: only the interrupt can end it.
TEST(Interrupt, CtrlCStopsTheRobotSavesTheMapAndSaysSo) {
  const auto out = fresh_folder("interrupt");
  const Finished run =
      interrupt_cairn({"run", source_folder() + "/config/missions/office.yaml", "--out", out.string(), "--realtime"});
  EXPECT_EQ(run.exit_status, 1) << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr("outcome     cancelled: cancelled by the user"));
  EXPECT_NO_THROW((void)load_map(out / "office.cairn"));
}

// The log's second line comes an hour after the first.
TEST(Interrupt, CtrlCEndsAPacedLogInTheMiddleOfAGap) {
  const auto folder = fresh_folder("interrupt_gap");
  const std::string header = "PARAM robot_frontlaser_offset 0\n";
  const std::string reading = "FLASER 3 1.0 1.0 1.0 0 0 0 0 0 0 ";
  write_text(folder / "gap.log", header + reading + "1000 here 0\n" + reading + "4600 here 3600\n");
  write_text(folder / "mission.yaml",
             "mission: gap\nrobot: " + source_folder() +
                 "/config/robots/pioneer1.yaml\nsensor: {plugin: carmen_log, file: gap.log}\n"
                 "localizer: {plugin: odometry_compass}\nmap: {plugin: bayes, cell_m: 0.05}\n");
  const Finished run =
      interrupt_cairn({"run", (folder / "mission.yaml").string(), "--out", folder.string(), "--realtime"});
  EXPECT_EQ(run.exit_status, 1) << run.out << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr("cancelled by the user"));
}

}  // namespace
}  // namespace cairn::testing_program

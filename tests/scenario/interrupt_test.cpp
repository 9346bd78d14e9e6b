#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/map_store.hpp"
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

}  // namespace
}  // namespace cairn::testing_program

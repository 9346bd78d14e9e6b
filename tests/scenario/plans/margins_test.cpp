// The margin that `cairn plan` keeps beside the robot, and what it says where a door leaves less.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class PlanMargins : public testing::Test {
 protected:
  // Two rooms of 3 x 4 m, joined by a door at the lower wall.
  void save_rooms(int door_cells) {
    SavedMap map;
    map.grid = OccupancyGrid(0.05);
    for (int y = 0; y < 80; ++y)
      for (int x = 0; x < 124; ++x) {
        const bool is_rim = x < 2 || x >= 122 || y < 2 || y >= 78;
        const bool is_wall = x >= 60 && x < 64 && y >= 2 + door_cells;
        map.grid.set_log_odds({x, y}, is_rim || is_wall ? LogOdds{900} : LogOdds{-900});
      }
    save_map(file(), map);
  }
  [[nodiscard]] Finished run(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"plan", file(), "--from", "1,3", "--to", "5,3"});
    return run_cairn(more);
  }
  [[nodiscard]] json asked(std::vector<std::string> more = {}) const {
    more.emplace_back("--json");
    return json::parse(run(std::move(more)).out, nullptr, false);
  }
  [[nodiscard]] std::string file() const { return (folder_ / "rooms.cairn").string(); }

  const std::filesystem::path folder_ = fresh_folder("plan_margins");
};

TEST_F(PlanMargins, ThroughAWideDoorAPathKeepsTheUsualOne) {
  save_rooms(24);  // 1.2 m
  const json answer = asked();
  EXPECT_EQ(answer.at("outcome"), "solved");
  EXPECT_EQ(answer.at("margin_m"), 0.12);
  EXPECT_GE(answer.at("clearance_m"), 0.12);
  EXPECT_THAT(run().out, HasSubstr(" (margin 0.12 m)"));
  const json without = asked({"--margin-m", "0"});
  EXPECT_EQ(without.at("margin_m"), 0.0);
  EXPECT_LT(without.at("clearance_m"), 0.03);
  EXPECT_THAT(run({"--margin-m", "0"}).out, Not(HasSubstr("margin")));
}

TEST_F(PlanMargins, ANarrowDoorRelaxesItAndTheAnswerSaysSo) {
  save_rooms(12);  // 0.6 m for 0.44 m
  const json answer = asked();
  EXPECT_EQ(answer.at("outcome"), "solved");
  EXPECT_EQ(answer.at("margin_m"), 0.06);
  EXPECT_GE(answer.at("clearance_m"), 0.06);
  EXPECT_THAT(answer.at("reason").get<std::string>(),
              HasSubstr("with a margin of 0.12 m beside the robot there is no path, so it keeps 0.06 m"));
  EXPECT_THAT(run().out, HasSubstr(" (margin 0.06 m)"));
  save_rooms(10);
  EXPECT_THAT(asked().at("reason").get<std::string>(), HasSubstr("so it keeps none"));
  save_rooms(8);
  EXPECT_EQ(run().exit_status, 1) << "the robot does not fit";
}

TEST_F(PlanMargins, OneThatIsAskedForIsNotRelaxed) {
  save_rooms(24);
  EXPECT_EQ(asked({"--margin-m", "0.3"}).at("margin_m"), 0.3);
  EXPECT_EQ(run({"--margin-m", "0.5"}).exit_status, 1);
  EXPECT_EQ(run({"--margin-m", "-1"}).exit_status, 2);
}

TEST_F(PlanMargins, ARadiusAndAMarginOfThePlannerAreTakenAsTheyAre) {
  save_rooms(24);
  EXPECT_EQ(asked({"--radius-m", "0.22"}).at("margin_m"), 0.0);
  EXPECT_EQ(asked({"--set", "route.margin_m=0.1"}).at("margin_m"), 0.0);
  EXPECT_GE(asked({"--set", "route.margin_m=0.1"}).at("clearance_m"), 0.1);
  EXPECT_EQ(asked({"--radius-m", "0.22", "--margin-m", "0.1"}).at("margin_m"), 0.1);
}

}  // namespace
}  // namespace cairn::testing_program

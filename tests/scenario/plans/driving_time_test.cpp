// Which legs `cairn plan` plans for driving time, and what it prints of them.

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

class DrivingTime : public testing::Test {
 protected:
  // 5 x 4 m with a wall from above that paths go round.
  void SetUp() override {
    map_.grid = OccupancyGrid(0.05);
    for (int y = 0; y < 80; ++y)
      for (int x = 0; x < 100; ++x) {
        const bool is_wall = x < 2 || x >= 98 || y < 2 || y >= 78 || (x >= 48 && x < 52 && y >= 40);
        map_.grid.set_log_odds({x, y}, is_wall ? LogOdds{900} : LogOdds{-900});
      }
    save_map(file("unknown.cairn"), map_);
    map_.properties["robot_radius_m"] = "0.22";
    save_map(file("known.cairn"), map_);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] Finished run(const std::string& map, std::vector<std::string> more) const {
    more.insert(more.begin(), {"plan", file(map), "--from", "1,3", "--to", "4,3", "--margin-m", "0"});
    return run_cairn(more);
  }
  [[nodiscard]] json asked(const std::string& map, std::vector<std::string> more = {}) const {
    more.emplace_back("--json");
    return json::parse(run(map, more).out, nullptr, false);
  }

  const std::filesystem::path folder_ = fresh_folder("driving_time");
  SavedMap map_;
};

TEST_F(DrivingTime, OnAMapThatAMissionSavedPathsKeepTheirDistanceAndPlanSaysHowLongTheyTake) {
  const json answer = asked("known.cairn");
  EXPECT_GT(answer.at("clearance_m"), 0.14);
  EXPECT_GE(answer.at("driving_time_s").get<double>(), answer.at("length_m").get<double>() / 0.4);
  EXPECT_THAT(run("known.cairn", {}).out, HasSubstr(" m between the robot and what is nearest, "));
  EXPECT_THAT(run("known.cairn", {}).out, HasSubstr(" s of driving, "));
}

TEST_F(DrivingTime, WhereNobodyKnowsTheRobotTheShortestPathIsTheAnswer) {
  const json answer = asked("unknown.cairn");
  EXPECT_TRUE(answer.at("driving_time_s").is_null());
  EXPECT_LT(answer.at("clearance_m"), 0.01);
  EXPECT_LT(answer.at("length_m"), asked("known.cairn").at("length_m"));
  EXPECT_THAT(run("unknown.cairn", {}).out, Not(HasSubstr("of driving")));
}

TEST_F(DrivingTime, ARobotFileMakesItKnown) {
  const json answer = asked("unknown.cairn", {"--robot", source_folder() + "/config/robots/pioneer1.yaml"});
  EXPECT_GT(answer.at("clearance_m"), 0.1);
  EXPECT_TRUE(answer.at("driving_time_s").is_number());
}

TEST_F(DrivingTime, AskedForTheShortestPathItGivesThatAndItsTime) {
  const json shortest = asked("known.cairn", {"--set", "route.objective=length"});
  const json fastest = asked("known.cairn");
  EXPECT_EQ(shortest.at("length_m"), asked("unknown.cairn").at("length_m"));
  EXPECT_GT(shortest.at("driving_time_s"), fastest.at("driving_time_s"));
}

TEST_F(DrivingTime, OfAPointThereIsNone) {
  const json answer = asked("known.cairn", {"--radius-m", "0"});
  EXPECT_TRUE(answer.at("driving_time_s").is_null());
  EXPECT_EQ(answer.at("length_m"), asked("unknown.cairn", {"--radius-m", "0"}).at("length_m"));
}

}  // namespace
}  // namespace cairn::testing_program

// `cairn map lint`: what it says of a map, to people and in JSON, and how it ends.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/maps/drawn_graph.hpp"
#include "tests/maps/drawn_grid.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// Two landmarks, 2 m apart in a corridor 0.3 m wide, joined both ways; the robot has 0.1 m radius.
SavedMap corridor() {
  SavedMap map;
  map.grid = drawn(
      {std::string(40, '#'), std::string(40, '.'), std::string(40, '.'), std::string(40, '.'), std::string(40, '#')});
  map.graph = drawn_graph("1 3");
  for (const LandmarkId id : {1, 3}) map.graph.find(id)->T_map_landmark.y_m = 0.25;
  map.graph.find(3)->name = "door";
  Route route;
  route.from = 1;
  route.to = 3;
  route.cost_m = 2.0;
  route.trajectory = {map.graph.find(1)->T_map_landmark, map.graph.find(3)->T_map_landmark};
  map.graph.add_route(route);
  std::swap(route.from, route.to);
  std::swap(route.trajectory.front(), route.trajectory.back());
  map.graph.add_route(route);
  map.properties["robot_radius_m"] = "0.1";
  return map;
}

class MapLint : public testing::Test {
 protected:
  Finished lint(const SavedMap& map, const std::vector<std::string>& more = {}) {
    save_map(file_, map);
    std::vector<std::string> arguments{"map", "lint", file_.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_cairn(arguments);
  }

  const std::filesystem::path file_ = fresh_folder("map_lint") / "corridor.cairn";
};

TEST_F(MapLint, ASoundMapIsClean) {
  const Finished finished = lint(corridor());
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  EXPECT_THAT(finished.out,
              HasSubstr("corridor.cairn: clean; 0 errors, 0 warnings, 0 notes, for a robot of 0.1 m radius"));
  const json answer = json::parse(lint(corridor(), {"--json"}).out);
  EXPECT_EQ(answer["outcome"], "clean");
  EXPECT_TRUE(answer["findings"].empty());
}

TEST_F(MapLint, ARouteThatIsBlockedNowSaysWhereAndWhatToDo) {
  SavedMap map = corridor();
  map.grid.set_log_odds({20, 2}, 1000);
  const Finished finished = lint(map, {"--json"});
  EXPECT_EQ(finished.exit_status, 1);
  const json answer = json::parse(finished.out);
  EXPECT_EQ(answer["outcome"], "findings");
  ASSERT_EQ(answer["findings"].size(), 2U);
  const json& finding = answer["findings"][0];
  EXPECT_EQ(finding["kind"], "blocked_route");
  EXPECT_EQ(finding["severity"], "error");
  EXPECT_EQ(finding["landmarks"], json::parse(R"([{"id": "L1", "name": ""}, {"id": "L3", "name": "door"}])"));
  EXPECT_EQ(finding["routes"], json({1}));
  EXPECT_NEAR(finding["x_m"].get<double>(), 2.05, 1e-9);
  EXPECT_NEAR(finding["y_m"].get<double>(), 0.25, 1e-9);
  EXPECT_THAT(lint(map).out, AllOf(StartsWith("error   blocked_route at (2.05, 0.25): route 1, L1 -> door (L3), is not "
                                              "free for a robot of 0.1 m radius: the cell at (2.05, 0.25) m is "
                                              "occupied\n        close it, or plan it anew"),
                                   HasSubstr("findings; 2 errors, 0 warnings, 0 notes")));
}

TEST_F(MapLint, AWiderRobotIsAskedAbout) {
  EXPECT_EQ(lint(corridor(), {"--radius-m", "0.14"}).exit_status, 0);
  EXPECT_EQ(lint(corridor(), {"--radius-m", "0.2"}).exit_status, 1);
}

TEST_F(MapLint, NotesAloneAreNoFailure) {
  SavedMap map = corridor();
  Route dear;
  dear.from = 1;
  dear.to = 3;
  dear.cost_m = 9.0;
  map.graph.set_closed(map.graph.add_route(dear), true);
  const Finished finished = lint(map);
  EXPECT_EQ(finished.exit_status, 0);
  EXPECT_THAT(finished.out,
              AllOf(HasSubstr("note    closed_route"), HasSubstr("clean; 0 errors, 0 warnings, 1 note,")));
}

TEST_F(MapLint, ManyOfAKindAreCutForPeopleOnly) {
  SavedMap map = corridor();
  for (int i = 0; i < 30; ++i) {
    Landmark lone;
    lone.T_map_landmark = {0.1 * i, 9.0, 0.0};
    map.graph.add(lone);
  }
  EXPECT_THAT(lint(map).out, HasSubstr("... and 10 more of the kind isolated; --json lists all\n"));
  EXPECT_EQ(json::parse(lint(map, {"--json"}).out)["findings"].size(), 30U);
}

TEST_F(MapLint, WhatIsNoMapIsRefused) {
  write_text(file_, "hello");
  const Finished finished = run_cairn({"map", "lint", file_.string()});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("corridor.cairn"));
}

}  // namespace
}  // namespace cairn::testing_program

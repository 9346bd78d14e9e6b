// Driving past people, carts and doors in the simulator, from outside.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;

// A room of 6 x 2 m, from its west to its east.
const std::string kRoom =
    "bounds_m: [[0, 0], [6, 2]]\n"
    "walls:\n  - {points_m: [[0, 0], [6, 0], [6, 2], [0, 2], [0, 0]], surface: rough}\n";
const std::string kWallWithDoor =
    "  - {points_m: [[3, 0], [3, 0.5]], surface: rough}\n  - {points_m: [[3, 1.5], [3, 2]], surface: rough}\n";

json run(const std::string& name, const std::string& world, const std::string& sensor = "",
         const std::string& seed = "1", const std::string& at_most_s = "300", const std::string& more_steps = "") {
  const auto folder = fresh_folder("driving_" + name);
  write_text(folder / "world.yaml", world);
  write_text(folder / "mission.yaml",
             "mission: there\nrobot: " + source_folder() +
                 "/config/robots/pioneer1.yaml\nworld: world.yaml\n"
                 "start: {at_m: [0.6, 1.0], angle_deg: 0}\nsensor: {plugin: simulated_robot" +
                 sensor +
                 "}\nlocalizer: {plugin: odometry_compass}\nmap: {plugin: muriel, cell_m: 0.05}\n"
                 "planner: {plugin: hybrid, route: {plugin: ompl}}\nsteps:\n"
                 "  - goto: {at_m: [5.2, 1.0], at_most_s: " +
                 at_most_s + "}\n" + more_steps);
  const Finished finished =
      run_cairn({"run", (folder / "mission.yaml").string(), "--seed", seed, "--out", folder.string(), "--json"});
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  return json::parse(text_of_file(folder / "report.json"));
}

void expect_no_hard_touch(const json& report) {
  for (const json& touch : report["contacts"])
    EXPECT_FALSE(touch["could_be_seen"].get<bool>() && touch["speed_mps"].get<double>() > 0.05) << touch;
}

TEST(Driving, GetsThroughARoomThatItDoesNotKnow) {
  const json report = run("open", kRoom);
  EXPECT_EQ(report["outcome"], "done") << report["reason"];
  EXPECT_EQ(report["collisions"], 0);
  EXPECT_LT(report["time_s"], 60.0);
}

TEST(Driving, PassesAPersonWhoWalksTowardsIt) {
  for (const std::string seed : {"1", "2", "3"}) {
    const json report = run("person",
                            kRoom +
                                "movers:\n  - {circle_diameter_m: 0.4, path_m: [[5.4, 1.0], [0.4, 1.0]], "
                                "speed_mps: 0.6, pause_s: 3}\n",
                            "", seed);
    EXPECT_EQ(report["outcome"], "done") << report["reason"];
    expect_no_hard_touch(report);
  }
}

TEST(Driving, MeetsSomebodyInACorridor) {
  // 1.4 m wide; who comes keeps to one side, and waits for what is in the way.
  const std::string corridor =
      "  - {points_m: [[1.6, 0], [1.6, 0.3], [4.4, 0.3], [4.4, 0]], surface: rough}\n"
      "  - {points_m: [[1.6, 2], [1.6, 1.7], [4.4, 1.7], [4.4, 2]], surface: rough}\n"
      "movers:\n  - {circle_diameter_m: 0.4, path_m: [[4.8, 1.35], [1.3, 1.35]], speed_mps: 0.5, pause_s: 2}\n";
  for (const std::string seed : {"1", "2"}) {
    const json report = run("corridor", kRoom + corridor, "", seed);
    EXPECT_EQ(report["outcome"], "done") << report["reason"];
    expect_no_hard_touch(report);
  }
}

TEST(Driving, ACartThatDoesNotWaitFindsItStanding) {
  for (const std::string speed : {"0.3", "0.6"}) {
    const json report = run("cart", kRoom +
                                        "movers:\n  - {polygon_m: [[0, 0], [0.6, 0], [0.6, 0.4], [0, 0.4]], path_m: "
                                        "[[5.2, 0.8], [2.2, 0.8]], speed_mps: " +
                                        speed + ", course: there_and_back, pause_s: 5, waits: false}\n");
    expect_no_hard_touch(report);
    EXPECT_EQ(report["outcome"], "done") << report["reason"];
  }
}

TEST(Driving, WaitsForADoorThatClosesOnItsRouteToOpenAgain) {
  const json report =
      run("door", kRoom + kWallWithDoor + "doors:\n  - {from_m: [3, 0.5], to_m: [3, 1.5], closed_s: [[4, 60]]}\n");
  EXPECT_EQ(report["outcome"], "done") << report["reason"];
  EXPECT_GT(report["time_s"], 60.0);
  EXPECT_LT(report["time_s"], 180.0) << "it has seen the door open";
  expect_no_hard_touch(report);
}

TEST(Driving, TakesTheOtherWayRoundWhenADoorStaysClosed) {
  const std::string two_doors =
      "  - {points_m: [[3, 0], [3, 0.1]], surface: rough}\n  - {points_m: [[3, 1.0], [3, 1.1]], surface: rough}\n"
      "  - {points_m: [[3, 1.9], [3, 2]], surface: rough}\n"
      "doors:\n  - {from_m: [3, 1.1], to_m: [3, 1.9], closed_s: [[3, 1000]]}\n";
  const json report = run("other_way", kRoom + two_doors);
  EXPECT_EQ(report["outcome"], "done") << report["reason"];
  expect_no_hard_touch(report);
}

// Sonars draw it narrower than the robot: it takes some looking.
TEST(Driving, PassesADoorOfSeventyCentimetres) {
  for (const std::string seed : {"1", "2", "3", "4"}) {
    const json report = run("narrow",
                            kRoom +
                                "  - {points_m: [[3, 0], [3, 0.65]], surface: rough}\n"
                                "  - {points_m: [[3, 1.35], [3, 2]], surface: rough}\n",
                            "", seed, "1200");
    EXPECT_EQ(report["outcome"], "done") << seed << report["reason"];
    EXPECT_EQ(report["collisions"], 0) << seed;
  }
}

bool has_event(const json& report, const std::string& text) {
  return std::ranges::any_of(
      report["events"], [&](const json& event) { return event.get<std::string>().find(text) != std::string::npos; });
}

// Deaf for a minute on its path back, where the map knows the walls.
TEST(Driving, ARingThatGoesDeafMeetsNothingFastAndGoesOnWhenItHearsAgain) {
  for (const std::string part : {"whole", "left", "right"}) {
    const json report =
        run("deaf_" + part, kRoom, ", faults: [{at_s: 25, for_s: 60, deaf: " + part + "}]", "1", "600",
            "  - goto: {at_m: [0.8, 1.0], at_most_s: 600}\n  - goto: {at_m: [5.2, 1.0], at_most_s: 600}\n");
    EXPECT_EQ(report["outcome"], "done") << report["reason"];
    for (const json& touch : report["contacts"]) EXPECT_LE(touch["speed_mps"].get<double>(), 0.1) << part << touch;
    EXPECT_TRUE(has_event(report, "the robot creeps")) << part << report["events"];
    EXPECT_TRUE(has_event(report, "again")) << part << report["events"];
    EXPECT_GT(report["collision_monitor"]["deaf_s"], 0.0) << part;
    EXPECT_NE(report["collision_monitor"]["deaf"], "") << part;
  }
}

TEST(Driving, StandsWhileItsSensorsAreSilentAndGoesOnAfter) {
  const json report = run("silent", kRoom, ", faults: [{at_s: 6, for_s: 8, silent: true}]");
  EXPECT_EQ(report["outcome"], "done") << report["reason"];
  EXPECT_GE(report["collision_monitor"]["stale_s"], 8.0 - 3 * 0.04) << "from the second missing reading on";
  const bool reported = std::ranges::any_of(
      report["stops"], [](const json& stop) { return stop["begin_s"] < 6.3 && stop["end_s"] > 13.7; });
  EXPECT_TRUE(reported) << report["stops"];
  EXPECT_EQ(report["collisions"], 0);
}

}  // namespace
}  // namespace cairn::testing_program

#include "plugins/behaviours/errands/search.hpp"

#include <gmock/gmock.h>

#include "plugins/behaviours/exploring/inspect.hpp"
#include "tests/plugins/behaviours/fake_host.hpp"
#include "tests/plugins/behaviours/written_config.hpp"

namespace cairn::behaviours {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// 4 x 4 m with a block of 0.4 m in the middle.
const std::string kRoom = R"(
  ########################################
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #.................####.................#
  #.................####.................#
  #.................####.................#
  #.................####.................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #.....R................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  ########################################
)";
const Point kBlock{2.0, 2.2};

// With a door of 1 m.
const std::string kTwoRooms = R"(
  ########################################
  #...................#..................#
  #...................#..................#
  #...................#..................#
  #...................#..................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #.....R................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #...................#..................#
  #...................#..................#
  #...................#..................#
  #...................#..................#
  ########################################
)";

Search search(const std::string& yaml, const std::vector<std::string>& categories = {"circle", "square"}) {
  return Search(config_of<SearchConfig>(yaml), 1, categories);
}

TEST(Search, EndsAsSoonAsEnoughLandmarksOfTheCategoryAreKnown) {
  FakeHost host(kRoom);
  Search step = search("{category: square, until: 2}");
  host.graph.add(landmark_at("square", {1.0, 3.0, 0.0}, {1.0, 3.0, 0.0}));
  host.graph.add(landmark_at("circle", {3.0, 3.0, 0.0}, {3.0, 3.0, 0.0}));
  EXPECT_EQ(host.run(step, 10.0).state, StepState::running);
  EXPECT_GT(host.driven_m, 0.0);
  host.graph.add(landmark_at("square", {3.0, 1.0, 0.0}, {3.0, 1.0, 0.0}));
  EXPECT_EQ(host.tick(step), (Status{StepState::success, "found square: L1, L3"}));
}

TEST(Search, FailsWhenAllIsExploredWithout) {
  FakeHost host(kRoom);
  Search step = search("{category: square, rounds: 1}");
  const Status status = host.run(step, 1500.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("0 of 1 square found in round 1 of 1: nothing left to explore: "))
      << host.picture();
  EXPECT_GT(known_ratio(host.grid), 0.9);
}

TEST(Search, LooksAtAllOnceMore) {
  const auto driven_m = [](const std::string& rounds) {
    FakeHost host(kRoom);
    Search step = search("{category: square, at_most_s: 4000, rounds: " + rounds + "}");
    EXPECT_EQ(host.run(step, 4100.0).state, StepState::failure);
    const auto reported = std::ranges::count_if(
        host.said, [](const std::string& text) { return text.starts_with("0 of 1 square found in round 1 of 2: "); });
    EXPECT_EQ(reported, rounds == "2" ? 1 : 0);
    return host.driven_m;
  };
  EXPECT_GT(driven_m("2"), 1.5 * driven_m("1"));
}

// It goes to see whether it can get to where it could not get to, and explores on there.
TEST(Search, GetsIntoARoomWhoseDoorHasOpened) {
  FakeHost host(kTwoRooms, {.sight_m = 1.0, .all_known = true});
  const auto shut_door = [&](bool shut) {
    for (double y = 0.55; y < 1.5; y += 0.1) host.solidify({2.05, y}, shut);
    // As it was when the robot last saw it.
    if (shut)
      for (double y = 0.525; y < 1.5; y += 0.05)
        for (const double x : {2.025, 2.075}) host.grid.set_log_odds(host.grid.cell_at({x, y}), 600);
  };
  shut_door(true);
  Search step = search("{category: square, at_most_s: 900, look_closer_m: 0}");
  Status status;
  while (host.time_s < 900.0 && (status = host.tick(step)).state == StepState::running) {
    if (host.said.size() == 1) shut_door(false);  // the first round is over
    if (host.T_map_robot.x_m > 2.6 && host.graph.landmarks().empty())
      host.graph.add(landmark_at("square", {3.0, 1.0, 0.0}, {3.0, 1.0, 0.0}));
  }
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
}

TEST(Search, FailsWhenItsTimeIsUp) {
  FakeHost host(kRoom);
  Search step = search("{category: square, at_most_s: 20, until: 2}");
  host.graph.add(landmark_at("square", {1.0, 3.0, 0.0}, {1.0, 3.0, 0.0}));
  const Status status = host.run(step, 60.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("1 of 2 square found (L1); time is up in round 1 of 3"));
}

TEST(Search, ReportsACategoryThatNoTemplateHas) {
  EXPECT_EQ(error_of([] { search("{category: sqare}"); }),
            "mission.yaml:1:12: search: the mission has no template of category \"sqare\" (did you mean \"square\"?); "
            "it has circle, square");
  EXPECT_EQ(error_of([] { search("anything", {}); }), "no error") << "where the templates are not known";
  EXPECT_THAT(error_of([] { search("{category: [1]}"); }), HasSubstr("mission.yaml:1:12: category must be"));
  EXPECT_THAT(error_of([] { search("{category: square, until: 0}"); }), HasSubstr("mission.yaml:1:27: until must be"));
  EXPECT_THAT(error_of([] { search("{catgory: square}"); }), HasSubstr("(did you mean \"category\"?)"));
}

Inspect inspect(const std::string& yaml) {
  return Inspect(config_of<InspectConfig>(yaml), 1);
}

FakeHost room_with_block() {
  FakeHost host(kRoom, {.all_known = true});
  host.graph.add(landmark_at("square", {kBlock.x(), kBlock.y(), 0.0}, {2.0, 1.4, 0.0}));
  host.graph.find(1)->degree = 0.7;
  return host;
}

// Radians round the block, without those of its first approach.
double turned_round_rad(const FakeHost& host) {
  double sum_rad = 0.0;
  double last_rad = 0.0;
  bool begun = false;
  for (const Pose2& pose : host.driven) {
    const Point from_block = pose.position() - kBlock;
    if (from_block.norm() > 1.2) continue;
    const double angle_rad = std::atan2(from_block.y(), from_block.x());
    if (begun) sum_rad += wrap_angle(angle_rad - last_rad);
    begun = true;
    last_rad = angle_rad;
  }
  return std::abs(sum_rad);
}

TEST(Inspect, CirclesOnceWhenTheDegreeDoesNotRise) {
  FakeHost host = room_with_block();
  Inspect step = inspect("L1");
  const Status status = host.run(step, 300.0);
  EXPECT_EQ(status, (Status{StepState::success, "L1 (square): degree 0.700 -> 0.700 in 1 orbit, it rises no more"}));
  EXPECT_GT(turned_round_rad(host), radians(300.0)) << host.picture();
  EXPECT_GT(host.nearest_solid_m, host.robot.radius_m);
}

TEST(Inspect, GoesOnAsLongAsTheDegreeRises) {
  FakeHost host = room_with_block();
  Inspect step = inspect("{landmark: nearest square, rounds_at_most: 4}");
  Status status;
  std::size_t orbits = 0;
  while (status.state == StepState::running && host.time_s < 600.0) {
    status = host.tick(step);
    if (host.said.size() == orbits) continue;
    orbits = host.said.size();
  }
  EXPECT_THAT(status.reason, HasSubstr("in 1 orbit"));

  FakeHost rising = room_with_block();
  Inspect again = inspect("{landmark: nearest square, rounds_at_most: 4}");
  status = {};
  while (status.state == StepState::running && rising.time_s < 900.0) {
    status = rising.tick(again);
    // Rises through the first two orbits.
    if (rising.said.size() < 2) rising.graph.find(1)->degree = std::min(0.9, 0.7 + 0.0005 * rising.time_s);
  }
  EXPECT_EQ(status.state, StepState::success) << status.reason;
  EXPECT_THAT(status.reason, AllOf(HasSubstr("degree 0.700 -> "), HasSubstr("it rises no more")));
  EXPECT_GE(rising.said.size(), 2U);
  EXPECT_GT(turned_round_rad(rising), radians(600.0)) << rising.picture();
}

TEST(Inspect, EndsAfterItsLastLapHoweverTheDegreeRises) {
  FakeHost host = room_with_block();
  Inspect step = inspect("{landmark: L1, rounds_at_most: 1, orbit_speed_mps: 0.2}");
  Status status;
  while (status.state == StepState::running && host.time_s < 600.0) {
    host.graph.find(1)->degree = 0.7 + 0.001 * host.time_s;
    status = host.tick(step);
  }
  EXPECT_EQ(status.state, StepState::success);
  EXPECT_THAT(status.reason, HasSubstr("in 1 orbit, that was the last orbit"));
}

TEST(Search, ReportsHowLongExploringStillTakes) {
  FakeHost host(kRoom);
  Search step = search("{category: square}");
  EXPECT_TRUE(host.first_left_s(step, 120.0));
}

TEST(Inspect, ReportsHowLongTheWayThereStillTakes) {
  FakeHost host = room_with_block();
  Inspect step = inspect("L1");
  EXPECT_GT(host.first_left_s(step, 20.0).value_or(0.0), 0.0);
}

TEST(Inspect, SaysSoWhenTheLandmarkIsUnknownOrGone) {
  FakeHost host = room_with_block();
  Inspect unknown = inspect("nearest cirle");
  EXPECT_THAT(host.run(unknown, 10.0).reason, HasSubstr("no landmark of category \"cirle\""));
  Inspect step = inspect("L1");
  EXPECT_EQ(host.run(step, 5.0).state, StepState::running);
  host.graph.retire(1, "seen free");
  EXPECT_EQ(host.tick(step), (Status{StepState::failure, "L1 is not a landmark any more: seen free"}));
  EXPECT_THAT(error_of([] { inspect("{landmark: L1, rounds_at_most: 0}"); }),
              HasSubstr("mission.yaml:1:32: rounds_at"));
  EXPECT_THAT(error_of([] { inspect("{landmrk: L1}"); }), HasSubstr("(did you mean \"landmark\"?)"));
}

}  // namespace
}  // namespace cairn::behaviours

#include "plugins/behaviours/errands/simple_steps.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "framework/contracts/module.hpp"
#include "tests/plugins/behaviours/fake_host.hpp"

namespace cairn::behaviours {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kHall = R"(
  ##############################
  #............................#
  #............................#
  #............................#
  #............................#
  #............................#
  #............................#
  #....R.......................#
  #............................#
  #............................#
  #............................#
  #............................#
  #............................#
  ##############################
)";

double nearest_m(const std::vector<Pose2>& driven, const Point& p) {
  double nearest = 1e9;
  for (const Pose2& pose : driven) nearest = std::min(nearest, (pose.position() - p).norm());
  return nearest;
}

ConfigValue scalar(const std::string& text) {
  ConfigValue value;
  value.kind = ConfigValue::Kind::scalar;
  value.scalar = text;
  value.place = {"mission.yaml", 7, 11};
  return value;
}

TEST(Drive, PassesEveryPointInOrder) {
  FakeHost host(kHall);
  const std::vector<Point> points{{1.5, 0.6}, {1.5, 1.0}, {2.4, 0.5}};
  DriveTo drive({.points_m = points}, 1);
  EXPECT_EQ(host.run(drive, 60.0), (Status{StepState::success, "drove all points"}));
  for (const Point& p : points) EXPECT_LT(nearest_m(host.driven, p), 0.06) << host.picture();
}

TEST(Drive, DrivesThroughGentleBendsWithoutStopping) {
  FakeHost host(kHall);
  std::vector<Point> points;
  for (int i = 0; i <= 36; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 36.0;
    points.push_back({1.2 + 0.3 * std::sin(a), 0.7 - 0.3 * std::cos(a)});
  }
  DriveTo drive({.points_m = points}, 1);
  EXPECT_EQ(host.run(drive, 60.0).state, StepState::success);
  EXPECT_LT(host.time_s, 2.0 * std::numbers::pi * 0.3 / 0.2 + 12.0);
}

TEST(Drive, FailsWhenItIsBlocked) {
  FakeHost host(kHall);
  DriveTo drive({.points_m = {{2.9, 0.65}}, .patience_s = 3.0}, 1);
  const Status status = host.run(drive, 60.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("on the way to (2.90, 0.65)"));
}

// A robot that stands with its back to the point, and must turn first.
TEST(Drive, FailsWhenItsTurnInPlaceIsHeld) {
  FakeHost host(kHall);
  host.collision_monitor = [](const Pose2&, const Twist&) { return Twist{}; };
  DriveTo drive({.points_m = {host.T_map_robot * Point(-0.3, 0.0)}, .patience_s = 3.0}, 1);
  const Status status = host.run(drive, 60.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_NEAR(host.time_s, 3.0, 0.2);
}

TEST(Drive, ScatteredPointsDifferBySeedAndStayNear) {
  const auto end_of = [](std::uint64_t seed) {
    FakeHost host(kHall);
    DriveTo drive({.points_m = {{1.6, 0.7}}, .scatter_m = 0.2}, seed);
    EXPECT_EQ(host.run(drive, 60.0).state, StepState::success);
    return host.driven.back().position();
  };
  for (const std::uint64_t seed : {1U, 2U, 3U})
    EXPECT_LT((end_of(seed) - Point(1.6, 0.7)).cwiseAbs().maxCoeff(), 0.26) << seed;
  EXPECT_EQ(end_of(1), end_of(1));
  EXPECT_GT((end_of(1) - end_of(2)).norm(), 0.01);
}

TEST(Drive, WithoutPointsIsDoneAtOnce) {
  FakeHost host(kHall);
  DriveTo drive(DriveConfig{}, 1);
  EXPECT_EQ(host.tick(drive).state, StepState::success);
}

TEST(Wait, StandsStillForItsTime) {
  FakeHost host(kHall);
  Wait wait({.for_s = 3.0});
  EXPECT_EQ(host.run(wait, 60.0).state, StepState::success);
  EXPECT_NEAR(host.time_s, 3.0, 0.1);
  EXPECT_EQ(host.driven_m, 0.0);
}

TEST(Wait, BeginsAfreshAfterAHalt) {
  FakeHost host(kHall);
  Wait wait({.for_s = 3.0});
  host.run(wait, 2.0);
  wait.halt();
  EXPECT_EQ(host.run(wait, 2.0).state, StepState::running);
}

TEST(Save, AsksForTheFileByName) {
  FakeHost host(kHall);
  Save save({.file = scalar("office.cairn")});
  EXPECT_EQ(host.tick(save), (Status{StepState::success, "saved office.cairn"}));
  EXPECT_THAT(host.saved, ElementsAre("office.cairn"));
}

TEST(Save, RefusesAnythingButAPlainName) {
  for (const char* name : {"maps/office.cairn", "../office.cairn", "/etc/passwd", "..", "", "a\\b", "a\nb"}) {
    try {
      Save save({.file = scalar(name)});
      ADD_FAILURE() << name;
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(), HasSubstr("mission.yaml:7:11"));
      EXPECT_THAT(error.what(), HasSubstr("plain file name"));
    }
  }
}

// What the run writes at its end (report.json, map.png) would take its place.
TEST(Save, RefusesWhatIsNoMapsName) {
  for (const char* name : {"report.json", "map.png", "office", ".cairn", "control.sock"}) {
    try {
      Save save({.file = scalar(name)});
      ADD_FAILURE() << name;
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(), HasSubstr("mission.yaml:7:11: file must end in .cairn")) << name;
    }
  }
  try {
    Save save({.file = scalar("office.autosave.cairn")});
    ADD_FAILURE();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("is a name of autosaves"));
  }
}

}  // namespace
}  // namespace cairn::behaviours

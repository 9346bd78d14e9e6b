#include "plugins/behaviours/errands/find_myself.hpp"

#include <gmock/gmock.h>

#include "tests/plugins/behaviours/fake_host.hpp"

namespace cairn::behaviours {
namespace {

using testing::HasSubstr;

// 2 x 2 m, as large as the robot sees.
const std::string kRoom = R"(
  ####################
  #..................#
  #..................#
  #..................#
  #..................#
  #..................#
  #..................#
  #..................#
  #..................#
  #..................#
  #..................#
  #..................#
  #....R.............#
  #..................#
  #..................#
  #..................#
  #..................#
  #..................#
  #..................#
  ####################
)";

TEST(FindMyself, SucceedsAtOnceWhereTheRobotKnowsItsPlace) {
  FakeHost host(kRoom);
  FindMyself step(FindMyselfConfig{});
  EXPECT_EQ(host.tick(step), (Status{StepState::success, "knows where it is"}));
}

TEST(FindMyself, DrivesUntilTheRobotHasFoundItself) {
  FakeHost host(kRoom);
  host.trust = PoseTrust::lost;
  FindMyself step(FindMyselfConfig{});
  EXPECT_EQ(host.run(step, 8.0).state, StepState::running);
  EXPECT_GT(host.driven.size(), 10U);
  host.trust = PoseTrust::tracking;
  const Status status = host.tick(step);
  EXPECT_EQ(status.state, StepState::success);
  EXPECT_THAT(status.reason, HasSubstr("found itself after"));
}

TEST(FindMyself, FailsWhenItsTimeIsUp) {
  FakeHost host(kRoom);
  host.trust = PoseTrust::lost;
  FindMyselfConfig config;
  config.at_most_s = 3.0;
  FindMyself step(config);
  EXPECT_EQ(host.run(step, 10.0), (Status{StepState::failure, "has not found itself in 3 s"}));
}

TEST(FindMyself, FailsWhenNothingIsLeftToSee) {
  FakeHost host(kRoom);
  host.trust = PoseTrust::lost;
  FindMyself step(FindMyselfConfig{});
  const Status status = host.run(step, 600.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("has not found itself: "));
}

TEST(FindMyself, NeedsNoPose) {
  EXPECT_FALSE(FindMyself(FindMyselfConfig{}).needs_pose());
}

}  // namespace
}  // namespace cairn::behaviours

#include "plugins/behaviours/local_map/recent_echoes.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/behaviours/fake_host.hpp"

namespace cairn::behaviours {
namespace {

const std::string kYard = R"(
  ##########
  #........#
  #........#
  #........#
  #....R...#
  #........#
  #........#
  #........#
  ##########
)";

// Turns on the spot and hears: echoes of a ring at 0.6 m as long as there are any.
class Hearing : public Behaviour {
 public:
  Status tick(const WorldView& world, BehaviourContext& context) override {
    context.drive({0.0, 1.0});
    if (forgets)
      echoes.forget(world);
    else
      echoes.see(world);
    return {StepState::running, ""};
  }
  void halt() override {}
  RecentEchoes echoes;
  bool forgets = false;
};

struct Ring : testing::Test {
  Ring() {
    host.observe = [this](const FakeHost&) {
      Observation seen;
      if (is_there) seen.ranges = {{{0.1, 0.0, 0.0}, radians(15.0), 0.1, 5.0, 0.5, 0}};
      return seen;
    };
    host.run(hearing, 10.0);
    on_ring = host.grid.cell_at(host.T_map_robot.position() + Point(0.6, 0.0));
  }
  FakeHost host{kYard};
  Hearing hearing;
  bool is_there = true;
  Cell on_ring;
};

TEST_F(Ring, IsKeptForFifteenSecondsAtLeastAndThirtyAtMost) {
  ASSERT_TRUE(hearing.echoes.now().is_solid(on_ring));
  is_there = false;
  host.run(hearing, 14.0);
  EXPECT_TRUE(hearing.echoes.now().is_solid(on_ring));
  host.run(hearing, 17.0);
  EXPECT_FALSE(hearing.echoes.now().is_solid(on_ring));
}

TEST_F(Ring, IsForgottenAtOnceButForWhereTheRobotStands) {
  is_there = false;
  hearing.forgets = true;
  host.tick(hearing);
  EXPECT_FALSE(hearing.echoes.now().is_solid(on_ring));
  EXPECT_TRUE(hearing.echoes.now().is_conservatively_free(host.grid.cell_at(host.T_map_robot.position())));
}

}  // namespace
}  // namespace cairn::behaviours

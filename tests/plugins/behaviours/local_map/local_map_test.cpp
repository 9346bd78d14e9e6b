#include "plugins/behaviours/local_map/local_map.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/behaviours/fake_host.hpp"

namespace cairn::behaviours {
namespace {

const std::string kOneDoor = R"(
  ##############################
  #..............#.............#
  #..............#.............#
  #............................#
  #............................#
  #....R.......................#
  #............................#
  #............................#
  #............................#
  #..............#.............#
  #..............#.............#
  ##############################
)";
const Point kDoor_m{1.575, 0.625};
const Point kBeyond_m{2.5, 0.6};

// Runs once, in the host's next tick.
class Once : public Behaviour {
 public:
  explicit Once(std::function<void(const WorldView&)> check) : check_(std::move(check)) {}
  Status tick(const WorldView& world, BehaviourContext&) override {
    check_(world);
    return {StepState::success, "checked"};
  }
  void halt() override {}

 private:
  std::function<void(const WorldView&)> check_;
};

TEST(LocalMap, WhatALookHasSeenThroughIsNoLongerShut) {
  FakeHost host(kOneDoor, {.all_known = true});
  Once once([](const WorldView& world) {
    LocalMap map;
    map.see(world);
    const auto leads_through = [&] {
      const FreeSpace space = map.space(world, 0.03, Optimism::unknown_free, kBeyond_m, {});
      return space.reaches(space.cell_at(kBeyond_m));
    };
    EXPECT_TRUE(leads_through());
    map.shut(kDoor_m, world.time_s + 200.0);
    EXPECT_FALSE(leads_through());
    map.reopen(world.grid, {});
    map.reopen(world.grid, {world.grid.cell_at(kDoor_m + Point(0.0, 0.3))});
    EXPECT_FALSE(leads_through()) << "that was something else";
    map.reopen(world.grid, {world.grid.cell_at(kDoor_m + Point(0.0, world.grid.cell_m()))});
    EXPECT_TRUE(leads_through());
  });
  EXPECT_EQ(host.tick(once).state, StepState::success);
}

}  // namespace
}  // namespace cairn::behaviours

#include "framework/reporting/run_track.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(RunTrack, HoldsPosesPlansAndLandmarksWithTheirTimes) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  const auto view = [&](double time_s) { return WorldView{grid, graph, robot, {{time_s, 0.0, 0.25}}, time_s}; };
  RunTrack track({.max_path_poses = 10, .max_samples = 10, .max_events = 2});
  PlanResult plan;
  plan.path = {{0.0, 0.0, 0.0}, {2.0, 1.0, 0.0}};
  track.on(TickDone{}, {view(1.0)});
  track.on(PlanDone{plan}, {view(1.0)});
  Landmark landmark;
  landmark.id = 3;
  track.on(LandmarkChanged{landmark, true}, {view(1.5)});
  track.on(LandmarkChanged{landmark, false}, {view(1.6)});
  track.on(TickDone{}, {view(2.0)});
  track.on(StepEnded{}, {view(2.0)});
  track.on(StepEnded{}, {view(2.5)});  // no plan is left
  track.on(LandmarkRetired{landmark, "freed"}, {view(3.0)});
  EXPECT_EQ(track.json(),
            R"({"poses_every":1,"poses":[[1.0,1.0,0.0,0.25],[2.0,2.0,0.0,0.25]],)"
            R"("plans":[{"time_s":1.0,"points":[[0.0,0.0],[2.0,1.0]]},{"time_s":2.0,"points":[]}],)"
            R"("landmarks":[{"time_s":1.5,"id":3,"change":"found"},{"time_s":3.0,"id":3,"change":"retired"}]})"
            "\n");
}

TEST(RunTrack, HasABoundedSize) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  RunTrack track({.max_path_poses = 10, .max_samples = 100, .max_events = 100});
  for (int i = 0; i < 100'000; ++i) track.on(TickDone{}, {WorldView{grid, graph, robot, {}, 0.1 * i}});
  EXPECT_LT(track.json().size(), 5000U);
}

}  // namespace
}  // namespace cairn

// Conformance of modules of kind `map`. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(MyMap, MapperConformance, testing::Values(module<cairn::Mapper>(FOLDER, "my_map")));
//   }
#pragma once

#include "tests/conformance/allocations.hpp"
#include "tests/conformance/fixtures.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/conformance/texts.hpp"

namespace cairn::conformance {

class MapperConformance : public Conformance<Mapper> {
 protected:
  [[nodiscard]] std::vector<DriveStep> drive() const { return drive_through_room(setup().robot); }

  static PoseEstimate at(const Pose2& T_map_robot) { return {T_map_robot, Eigen::Matrix3d::Zero()}; }
  static void follow(Mapper& mapper, const std::vector<DriveStep>& steps) {
    for (const DriveStep& step : steps) (void)mapper.integrate(step.observation, at(step.T_map_robot));
  }
  // One sonar at the robot's centre that looks along x, read `times` times.
  static void look_ahead(Mapper& mapper, double range_m, int times) {
    Observation seen;
    seen.ranges = {{{}, radians(10.0), 0.1, 5.0, range_m, 0}};
    for (int i = 0; i < times; ++i) {
      seen.stamp_s = 0.1 * i;
      (void)mapper.integrate(seen, at({}));
    }
  }
  static bool is_in(const CellChanges& changes, Cell cell) {
    for (const CellSpan& span : changes.spans)
      if (span.y == cell.y && cell.x >= span.x_begin && cell.x < span.x_end) return true;
    return false;
  }
  // The first cell that changed and is in no span, or empty.
  static std::string unreported(const OccupancyGrid& before, const OccupancyGrid& after, const CellChanges& changes) {
    const CellBox box = united(before.bounds(), after.bounds());
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x)
        if (before.log_odds({x, y}) != after.log_odds({x, y}) && !is_in(changes, {x, y}))
          return "cell " + text_of(Cell{x, y}) + " went from log-odds " + std::to_string(before.log_odds({x, y})) +
                 " to " + std::to_string(after.log_odds({x, y})) +
                 ", but no span of the answer holds it: report every cell that integrate() writes";
    return {};
  }
  static std::string untidy(const CellChanges& changes) {
    for (std::size_t i = 1; i < changes.spans.size(); ++i) {
      const CellSpan& last = changes.spans[i - 1];
      const CellSpan& next = changes.spans[i];
      if (next.y < last.y || (next.y == last.y && next.x_begin < last.x_end))
        return "span " + std::to_string(i) + " in row " + std::to_string(next.y) + " comes after one in row " +
               std::to_string(last.y) + " that it does not follow: sort spans by row, then x, and join what overlaps";
    }
    return {};
  }
};

TEST_P(MapperConformance, IsMadeTwiceAndDestroyedUnused) {
  const auto first = make();
  const auto second = make();
  EXPECT_NE(first, second) << "a factory makes a new object each time";
}

TEST_P(MapperConformance, OutlivesTheLibraryThatMadeIt) {
  const auto mapper = GetParam().make_outliving_library();
  follow(*mapper, drive());
  EXPECT_FALSE(mapper->grid().bounds().empty()) << "nothing was mapped on an orbit through a room";
}

TEST_P(MapperConformance, AnEchoIsMappedAndTheWayToItIsFree) {
  const auto mapper = make();
  look_ahead(*mapper, 1.5, 10);
  const OccupancyGrid& grid = mapper->grid();
  for (const double x_m : {0.5, 0.8, 1.1})
    EXPECT_LT(grid.log_odds(grid.cell_at({x_m, 0.0})), 0) << "the way to the echo is not free at " << x_m << " m";
  LogOdds best = 0;
  for (double x_m = 1.3; x_m <= 1.7; x_m += 0.5 * grid.cell_m())
    best = std::max(best, grid.log_odds(grid.cell_at({x_m, 0.0})));
  EXPECT_GT(best, 0) << "ten echoes at 1.5 m made no cell within 0.2 m of there more occupied than free";
}

TEST_P(MapperConformance, NoEchoMeansFreeGroundAndNothingOccupied) {
  const auto mapper = make();
  look_ahead(*mapper, kInfinity, 10);
  const OccupancyGrid& grid = mapper->grid();
  EXPECT_LT(grid.log_odds(grid.cell_at({1.0, 0.0})), 0) << "range +inf is no echo: the ground ahead is free";
  const CellBox box = grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      ASSERT_LE(grid.log_odds({x, y}), 0) << "cell " << text_of(Cell{x, y}) << " became occupied without an echo";
}

TEST_P(MapperConformance, EveryCellThatChangesIsReported) {
  const auto mapper = make();
  for (const DriveStep& step : drive()) {
    const OccupancyGrid before = mapper->grid();
    const CellChanges& changes = mapper->integrate(step.observation, at(step.T_map_robot));
    ASSERT_EQ(unreported(before, mapper->grid(), changes), "") << "at " << step.observation.stamp_s << " s";
  }
}

TEST_P(MapperConformance, SpansAreSortedAndDoNotOverlap) {
  const auto mapper = make();
  for (const DriveStep& step : drive())
    ASSERT_EQ(untidy(mapper->integrate(step.observation, at(step.T_map_robot))), "");
}

TEST_P(MapperConformance, TheGridKeepsItsPlaceAndNeverShrinks) {
  const auto mapper = make();
  const double cell_m = mapper->grid().cell_m();
  const Point origin_m = mapper->grid().origin_m();
  CellBox bounds = mapper->grid().bounds();
  for (const DriveStep& step : drive()) {
    (void)mapper->integrate(step.observation, at(step.T_map_robot));
    ASSERT_EQ(mapper->grid().cell_m(), cell_m);
    ASSERT_EQ(mapper->grid().origin_m(), origin_m);
    ASSERT_EQ(united(bounds, mapper->grid().bounds()), mapper->grid().bounds()) << "a cell's place was given up";
    bounds = mapper->grid().bounds();
  }
}

TEST_P(MapperConformance, TheSameDriveGivesTheSameGrid) {
  const auto first = make(7);
  const auto second = make(7);
  follow(*first, drive());
  follow(*second, drive());
  EXPECT_TRUE(first->grid() == second->grid()) << "the answer must depend on config, seed and input only";
}

TEST_P(MapperConformance, TwoObjectsShareNothing) {
  const std::vector<DriveStep> steps = drive();
  const auto alone = make(7);
  follow(*alone, steps);
  const auto mapper = make(7);
  const auto other = make(7);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    (void)mapper->integrate(steps[i].observation, at(steps[i].T_map_robot));
    const DriveStep& elsewhere = steps[steps.size() - 1 - i];
    (void)other->integrate(elsewhere.observation, at(elsewhere.T_map_robot));
  }
  EXPECT_TRUE(mapper->grid() == alone->grid()) << "another object of the module changed this one's map";
}

TEST_P(MapperConformance, GoesOnFromTheGridOfAnEarlierRun) {
  const std::vector<DriveStep> steps = drive();
  const auto half = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  const auto earlier = make(7);
  follow(*earlier, {steps.begin(), half});
  const OccupancyGrid so_far = earlier->grid();
  const auto mapper = GetParam().going_on_from(so_far).make(7);
  if (mapper->grid() != so_far)
    GTEST_SKIP() << "MapperContext::grid_so_far is not heeded: missions with this map cannot be gone on with";
  follow(*mapper, {half, steps.end()});
  const OccupancyGrid& grid = mapper->grid();
  EXPECT_FALSE(grid == so_far) << "nothing more is mapped";
  EXPECT_EQ(united(grid.bounds(), so_far.bounds()), grid.bounds()) << "a part of the earlier grid was given up";
}

TEST_P(MapperConformance, AnObservationWithoutRangesChangesNothing) {
  const auto mapper = make();
  follow(*mapper, drive());
  const OccupancyGrid before = mapper->grid();
  (void)mapper->integrate(Observation{}, at(kRoomStart));
  EXPECT_TRUE(mapper->grid() == before);
}

TEST_P(MapperConformance, ABadReadingChangesNothing) {
  const auto mapper = make();
  look_ahead(*mapper, 1.5, 3);
  const OccupancyGrid before = mapper->grid();
  look_ahead(*mapper, kNan, 3);
  EXPECT_TRUE(mapper->grid() == before) << "range NaN is a bad reading (REP-117): it says nothing";
}

TEST_P(MapperConformance, OddReadingsDoNotThrowAndAreReported) {
  const auto mapper = make();
  for (const auto& [what, reading] : odd_readings()) {
    Observation seen;
    seen.ranges = {reading, reading};
    const OccupancyGrid before = mapper->grid();
    const CellChanges* changes = nullptr;
    ASSERT_NO_THROW(changes = &mapper->integrate(seen, at(kRoomStart))) << "with " << what;
    ASSERT_LT(mapper->grid().bounds().width(), 10000) << "the grid exploded with " << what;
    ASSERT_EQ(unreported(before, mapper->grid(), *changes), "") << "with " << what;
    ASSERT_EQ(untidy(*changes), "") << "with " << what;
  }
}

TEST_P(MapperConformance, OddPosesDoNotThrow) {
  const auto mapper = make();
  const std::vector<DriveStep> steps = drive();
  for (const Pose2& pose : odd_poses())
    ASSERT_NO_THROW((void)mapper->integrate(steps.front().observation, at(pose))) << "under the pose " << text_of(pose);
}

TEST_P(MapperConformance, MapsOnAfterOddInput) {
  const auto mapper = make();
  Observation odd;
  for (const auto& [what, reading] : odd_readings()) odd.ranges.push_back(reading);
  for (const Pose2& pose : odd_poses()) (void)mapper->integrate(odd, at(pose));
  look_ahead(*mapper, 1.5, 20);
  const OccupancyGrid& grid = mapper->grid();
  EXPECT_LT(grid.log_odds(grid.cell_at({0.8, 0.0})), 0) << "good readings are no longer mapped after odd ones";
}

TEST_P(MapperConformance, TimeThatStandsStillOrGoesBackIsHarmless) {
  const auto mapper = make();
  std::vector<DriveStep> steps = drive();
  for (DriveStep& step : steps) step.observation.stamp_s = 3.0;
  steps.back().observation.stamp_s = -kHuge;
  ASSERT_NO_THROW(follow(*mapper, steps));
  EXPECT_FALSE(mapper->grid().bounds().empty());
}

TEST_P(MapperConformance, AllocatesNothingOnGroundThatItCovers) {
  const auto mapper = make();
  const std::vector<DriveStep> steps = drive();
  follow(*mapper, steps);
  follow(*mapper, steps);
  const AllocationCount allocations;
  follow(*mapper, steps);
  EXPECT_EQ(allocations.count(), 0) << "integrate() is hot: keep its buffers as members, and answer by reference";
}

}  // namespace cairn::conformance

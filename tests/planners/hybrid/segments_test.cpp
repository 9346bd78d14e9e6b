#include "planners/hybrid/segments.hpp"

#include <gmock/gmock.h>

#include "tests/planners/hybrid/hybrid_world.hpp"

namespace cairn {
namespace {

using test::Hybrid;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// "stored R1" ...
std::vector<std::string> names(const PlanResult& result) {
  std::vector<std::string> names;
  for (const PathSegment& piece : result.segments) {
    names.emplace_back(name_of(piece.origin));
    if (piece.route != 0) names.back() += " R" + std::to_string(piece.route);
  }
  return names;
}

using Pieces = Hybrid;

TEST_F(Pieces, WithoutShortcutsArePlainlyWhatWasJoined) {
  route(landmark('M'), landmark('N'), "MUN");
  config.shortcut = false;
  const PlanResult result = plan(request('A', 'D'));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(names(result), ElementsAre("straight", "stored R1", "planned"));
  EXPECT_NEAR(result.segments[0].length_m, 0.5, 1e-9);
  EXPECT_NEAR(result.segments[1].length_m, 1.3, 1e-9);
  expect_clear(result);
}

TEST_F(Pieces, WhatASegmentSpansSeveralOfIsACut) {
  route(landmark('M'), landmark('N'), "MUN");
  EXPECT_THAT(names(plan(request('A', 'B'))), ElementsAre("cut"));
  EXPECT_THAT(names(plan(request('M', 'N'))), ElementsAre("stored R1")) << "within one";
}

TEST_F(Pieces, APlannedLegIsItsRoutes) {
  const LandmarkId m = landmark('M');
  const LandmarkId q = landmark('Q');
  route(m, q, "", 2.2);
  const PlanResult result = plan(between(m, q));
  EXPECT_THAT(names(result), ElementsAre("planned R1"));
  expect_clear(result);
}

TEST_F(Pieces, OfADirectWayAreStraightOrPlanned) {
  EXPECT_THAT(names(plan(request('A', 'B'))), ElementsAre("straight"));
  EXPECT_THAT(names(plan(request('A', 'D'))), ElementsAre("planned"));
  EXPECT_THAT(names(plan(request('A', 'A'))), IsEmpty());
}

TEST_F(Pieces, AnEscapeComesFirst) {
  PlanRequest tight = request('A', 'B');
  tight.from.pose = Pose2{0.19, 1.3, 0.0};
  const PlanResult result = plan(tight);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_EQ(names(result).front(), "escape");
  expect_segments_add_up(result);
  const auto refuge = result.path[1];
  tight.to.pose = refuge;
  const PlanResult out = plan(tight);
  ASSERT_EQ(out.outcome, PlanOutcome::solved) << out.reason;
  EXPECT_THAT(names(out), ElementsAre("escape")) << "there is nothing behind it";
  EXPECT_EQ(out.path.size(), 2U);
  expect_segments_add_up(out);
}

TEST_F(Pieces, BehindAnEscapeAreWhatTheyWouldBeWithoutIt) {
  PlanRequest tight = request('A', 'D');
  tight.from.pose = Pose2{0.19, 1.0, 0.0};
  EXPECT_THAT(names(plan(tight)), ElementsAre("escape", "planned"));
  tight.to.pose = Pose2{0.45, 1.0, 0.0};
  EXPECT_THAT(names(plan(tight)), ElementsAre("escape", "straight"));
}

TEST_F(Pieces, OnAMapWithoutAGridAreTheRoutes) {
  const LandmarkId m = landmark('M');
  const LandmarkId n = landmark('N');
  const LandmarkId q = landmark('Q');
  route(m, n, "MUN");
  route(n, q, "");
  world.grid = OccupancyGrid(0.1);
  const PlanResult result = plan(between(m, q));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(names(result), ElementsAre("stored R1", "straight R2"));
  EXPECT_NEAR(result.segments[0].length_m + result.segments[1].length_m, result.length_m, 1e-9);
}

}  // namespace
}  // namespace cairn

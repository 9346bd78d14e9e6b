// Conformance of modules of kind `path_planner`. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(MyPlanner, PathPlannerConformance,
//                            testing::Values(module<cairn::PathPlanner>(FOLDER, "my_planner")));
//   }
#pragma once

#include "tests/conformance/planning_laws.hpp"

namespace cairn::conformance {

class PathPlannerConformance : public PathLaws<PathPlanner, PathRequest, PathResult> {};

TEST_P(PathPlannerConformance, IsMadeTwiceAndDestroyedUnused) {
  expect_new_objects();
}

TEST_P(PathPlannerConformance, OutlivesTheLibraryThatMadeIt) {
  expect_to_outlive_the_library();
}

TEST_P(PathPlannerConformance, SolvesTheWayThroughADoor) {
  expect_the_door_passed();
}

TEST_P(PathPlannerConformance, ASolvedPathStartsAndEndsWhereItWasAsked) {
  expect_the_ends_that_were_asked();
}

TEST_P(PathPlannerConformance, TheDiscTouchesNothingOnASolvedPath) {
  expect_clear_paths(0.0);
}

TEST_P(PathPlannerConformance, AHeadingThatMattersIsKept) {
  expect_headings_kept();
}

TEST_P(PathPlannerConformance, AGoalInsideAWallIsNeverSolved) {
  expect_walls_never_entered();
}

TEST_P(PathPlannerConformance, AGoalThatNothingLeadsToIsNeverSolved) {
  expect_closed_rooms_never_reached();
}

TEST_P(PathPlannerConformance, ADoorTooNarrowForTheRobotIsNotSolved) {
  expect_narrow_doors_refused();
}

TEST_P(PathPlannerConformance, ARadiusThatIsNoneIsRefused) {
  expect_bad_radii_refused();
}

TEST_P(PathPlannerConformance, PlacesThatAreNoneAreOutcomesNotExceptions) {
  expect_bad_places_as_outcomes();
}

TEST_P(PathPlannerConformance, AnEmptyMapIsAnOutcome) {
  expect_empty_maps_as_outcomes();
}

TEST_P(PathPlannerConformance, ARobotThatIsThereAlreadyHasNoWayToGo) {
  expect_no_detours_to_where_it_is();
}

TEST_P(PathPlannerConformance, AChangedMapIsPlannedAfresh) {
  expect_changed_worlds_planned_afresh();
}

TEST_P(PathPlannerConformance, TheSameRequestGivesTheSameAnswer) {
  expect_same_answers();
}

TEST_P(PathPlannerConformance, ManyThreadsGetTheAnswersOfOne) {
  expect_same_answers_on_many_threads(between(world_.left, world_.in_the_wall));
}

TEST_P(PathPlannerConformance, AUsedUpBudgetEndsACallPromptlyWithItsOutcome) {
  expect_prompt_ends_of_budgets();
}

TEST_P(PathPlannerConformance, TakesPosesAndLandmarksAsEnds) {
  EXPECT_EQ(requests_for(*make()).size(), easy_requests().size());
}

TEST_P(PathPlannerConformance, NamesTheLandmarksThatItEndsAt) {
  const auto planner = make();
  const PathResult landmarks = planner->plan(between(1, 2), world_.view(), Budget{});
  EXPECT_EQ(landmarks.from_landmark, 1);
  EXPECT_EQ(landmarks.to_landmark, 2);
  const PathResult poses = planner->plan(between(world_.left, world_.right), world_.view(), Budget{});
  EXPECT_EQ(poses.from_landmark, 0);
  EXPECT_EQ(poses.to_landmark, 0);
}

TEST_P(PathPlannerConformance, ItsTraitsStayWhatTheyAre) {
  const auto planner = make();
  const PlannerTraits before = planner->traits();
  EXPECT_TRUE(std::isfinite(before.margin_m) && before.margin_m >= 0.0) << "margin_m is " << before.margin_m;
  (void)planner->plan(between(world_.left, world_.right), world_.view(), Budget{});
  for (const PlannerTraits& traits : {planner->traits(), make()->traits()}) {
    EXPECT_EQ(traits.shape, before.shape);
    EXPECT_EQ(traits.kinematics, before.kinematics);
    EXPECT_EQ(traits.margin_m, before.margin_m);
    EXPECT_EQ(traits.unknown, before.unknown);
  }
}

TEST_P(PathPlannerConformance, ADiscKeepsTheMarginOfItsTraits) {
  const PlannerTraits traits = make()->traits();
  if (traits.shape == PlannerTraits::Shape::disc) expect_clear_paths(traits.margin_m);
}

TEST_P(PathPlannerConformance, UnknownCellsAreCrossedOnlyWhereItsTraitsAllowIt) {
  const auto planner = make();
  PlannerWorld unknown;
  unknown.forget_door();
  for (const PathRequest& request : easy_requests()) {
    const PathResult result = planner->plan(request, unknown.view(), Budget{});
    if (planner->traits().unknown == UnknownPolicy::allow)
      EXPECT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
    else
      EXPECT_NE(result.outcome, PlanOutcome::solved) << unknown.drawing(result.path);
  }
}

TEST_P(PathPlannerConformance, PreparingChangesNoAnswer) {
  const auto plain = make();
  const auto prepared = make();
  prepared->prepare(world_.view(), kRadius_m);
  for (const PathRequest& request : easy_requests())
    EXPECT_EQ(plan(*prepared, request, world_.view()), plan(*plain, request, world_.view()));
}

}  // namespace cairn::conformance

// Conformance of modules of kind `planner`: mission planners. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(MyPlanner, PlannerConformance,
//                            testing::Values(module<cairn::Planner>(FOLDER, "my_planner")));
//   }
//
// A planner need not take every kind of place: one that only knows landmarks answers poses with
// unsupported, or unknown_place, and the other way round. One of the two it must take.
#pragma once

#include "tests/conformance/planning_laws.hpp"

namespace cairn::conformance {

class PlannerConformance : public PathLaws<Planner, PlanRequest, PlanResult> {
 protected:
  [[nodiscard]] std::string fault_of(const PlanResult& result) const override {
    if (result.time_ms.total_ms < 0.0) return "a negative time";
    return PathLaws::fault_of(result);
  }
};

TEST_P(PlannerConformance, IsMadeTwiceAndDestroyedUnused) {
  expect_new_objects();
}

TEST_P(PlannerConformance, OutlivesTheLibraryThatMadeIt) {
  expect_to_outlive_the_library();
}

TEST_P(PlannerConformance, SolvesTheWayThroughADoor) {
  expect_the_door_passed();
}

TEST_P(PlannerConformance, ASolvedPathStartsAndEndsWhereItWasAsked) {
  expect_the_ends_that_were_asked();
}

TEST_P(PlannerConformance, TheDiscTouchesNothingOnASolvedPath) {
  expect_clear_paths(0.0);
}

TEST_P(PlannerConformance, AHeadingThatMattersIsKept) {
  expect_headings_kept();
}

TEST_P(PlannerConformance, AGoalInsideAWallIsNeverSolved) {
  expect_walls_never_entered();
}

TEST_P(PlannerConformance, AGoalThatNothingLeadsToIsNeverSolved) {
  expect_closed_rooms_never_reached();
}

TEST_P(PlannerConformance, ADoorTooNarrowForTheRobotIsNotSolved) {
  expect_narrow_doors_refused();
}

TEST_P(PlannerConformance, ARadiusThatIsNoneIsRefused) {
  expect_bad_radii_refused();
}

TEST_P(PlannerConformance, PlacesThatAreNoneAreOutcomesNotExceptions) {
  expect_bad_places_as_outcomes();
}

TEST_P(PlannerConformance, AnEmptyMapIsAnOutcome) {
  expect_empty_maps_as_outcomes();
}

TEST_P(PlannerConformance, ARobotThatIsThereAlreadyHasNoWayToGo) {
  expect_no_detours_to_where_it_is();
}

TEST_P(PlannerConformance, AChangedMapIsPlannedAfresh) {
  expect_changed_worlds_planned_afresh();
}

TEST_P(PlannerConformance, TheSameRequestGivesTheSameAnswer) {
  expect_same_answers();
}

TEST_P(PlannerConformance, ManyThreadsGetTheAnswersOfOne) {
  expect_same_answers_on_many_threads(between(world_.left, world_.in_the_wall));
}

TEST_P(PlannerConformance, AUsedUpBudgetEndsACallPromptlyWithItsOutcome) {
  expect_prompt_ends_of_budgets();
}

}  // namespace cairn::conformance

// What planners of every kind promise alike: path planners, route planners and mission planners.
#pragma once

#include <set>
#include <thread>
#include <tuple>

#include "tests/conformance/fixtures.hpp"
#include "tests/conformance/planner_world.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/conformance/texts.hpp"

namespace cairn::conformance {

template <class Interface, class Request, class Result>
class PlanningLaws : public Conformance<Interface> {
 protected:
  static constexpr double kRadius_m = 0.22;

  // Through the door, each way.
  [[nodiscard]] virtual std::vector<Request> easy_requests() const = 0;
  // What is wrong with a result whatever its outcome, or empty.
  [[nodiscard]] virtual std::string fault_of(const Result& result) const = 0;
  [[nodiscard]] virtual std::string drawing_of(const Result& result) const = 0;

  // The easy ones that this planner takes.
  [[nodiscard]] std::vector<Request> requests_for(const Interface& planner) const {
    std::vector<Request> taken;
    for (const Request& request : easy_requests())
      if (!is_refusal(planner.plan(request, world_.view(), Budget{}).outcome)) taken.push_back(request);
    return taken;
  }
  static std::string plan(const Interface& planner, const Request& request, const WorldView& world) {
    return text_of(planner.plan(request, world, Budget{}));
  }
  void expect_never_solved(const Request& request, const WorldView& world, const std::string& why) const {
    const Result result = this->make()->plan(request, world, Budget{});
    EXPECT_NE(result.outcome, PlanOutcome::solved) << why << "; " << text_of(result) << drawing_of(result);
    EXPECT_EQ(fault_of(result), "") << why;
  }

  void expect_new_objects() const {
    const auto first = this->make();
    const auto second = this->make();
    EXPECT_NE(first, second) << "a factory makes a new object each time";
  }
  void expect_to_outlive_the_library() const {
    const auto planner = this->GetParam().make_outliving_library();
    EXPECT_FALSE(requests_for(*planner).empty());
  }
  void expect_changed_worlds_planned_afresh() const {
    const auto planner = this->make();
    const std::vector<Request> requests = requests_for(*planner);
    PlannerWorld changed;
    for (const Request& request : requests)
      ASSERT_EQ(planner->plan(request, changed.view(), Budget{}).outcome, PlanOutcome::solved);
    changed.close_door();
    for (const Request& request : requests) {
      const Result result = planner->plan(request, changed.view(), Budget{});
      EXPECT_NE(result.outcome, PlanOutcome::solved)
          << "the door has been walled up since the last call; what is kept between calls must be compared with the map"
          << drawing_of(result);
    }
  }
  void expect_same_answers() const {
    const auto first = this->make();
    const auto second = this->make();
    for (const Request& request : requests_for(*first)) {
      const std::string answer = plan(*first, request, world_.view());
      EXPECT_EQ(plan(*first, request, world_.view()), answer) << "the same planner, asked again";
      EXPECT_EQ(plan(*second, request, world_.view()), answer) << "another planner";
    }
  }
  void expect_same_answers_on_many_threads(const Request& unsolvable) const {
    constexpr int kThreads = 6;
    const auto planner = this->make();
    std::vector<Request> requests = requests_for(*planner);
    requests.push_back(unsolvable);
    std::vector<std::string> expected;
    for (const Request& request : requests) expected.push_back(plan(*planner, request, world_.view()));
    std::vector<std::vector<std::string>> answers(kThreads);
    {
      std::vector<std::jthread> threads;
      for (int i = 0; i < kThreads; ++i)
        threads.emplace_back([&, i] {
          for (std::size_t k = 0; k < requests.size(); ++k)
            answers[i].push_back(plan(*planner, requests[(k + i) % requests.size()], world_.view()));
        });
    }
    for (int i = 0; i < kThreads; ++i)
      for (std::size_t k = 0; k < requests.size(); ++k)
        EXPECT_EQ(answers[i][k], expected[(k + i) % requests.size()]) << "plan() is const and thread-safe";
  }
  void expect_prompt_ends_of_budgets() const {
    const auto planner = this->make();
    const UsedUpBudget used_up;
    const std::pair<Budget, PlanOutcome> cases[] = {{used_up.cancelled(), PlanOutcome::cancelled},
                                                    {UsedUpBudget::past_deadline(), PlanOutcome::out_of_budget}};
    for (const Request& request : requests_for(*planner)) {
      for (const auto& [budget, outcome] : cases) {
        Result result;
        EXPECT_LT(seconds_of([&, &budget = budget] { result = planner->plan(request, world_.view(), budget); }),
                  kPromptly_s);
        EXPECT_EQ(name_of(result.outcome), name_of(outcome)) << "look at the budget before the work begins";
        EXPECT_EQ(fault_of(result), "");
      }
      EXPECT_EQ(planner->plan(request, world_.view(), Budget{}).outcome, PlanOutcome::solved)
          << "a call with a new budget after one that was cut off";
    }
  }

  PlannerWorld world_;
};

// What planners that answer with a path promise besides: mission planners and path planners.
template <class Interface, class Request, class Result>
class PathLaws : public PlanningLaws<Interface, Request, Result> {
 protected:
  using Laws = PlanningLaws<Interface, Request, Result>;
  using Laws::kRadius_m;
  using Laws::world_;

  static Request between(const Pose2& from, const Pose2& to) {
    Request request;
    request.from.pose = from;
    request.to.pose = to;
    request.radius_m = kRadius_m;
    return request;
  }
  static Request between(LandmarkId from, LandmarkId to) {
    Request request;
    request.from.landmarks = {from};
    request.to.landmarks = {to};
    request.radius_m = kRadius_m;
    return request;
  }
  // As poses and as landmarks.
  [[nodiscard]] std::vector<Request> easy_requests() const override {
    return {between(world_.left, world_.right), between(world_.right, world_.left), between(1, 2), between(2, 1)};
  }
  [[nodiscard]] std::string fault_of(const Result& result) const override {
    if (result.reason.empty()) return "no sentence for people in `reason`";
    const bool has_path = result.outcome == PlanOutcome::solved || result.outcome == PlanOutcome::approximate;
    if (has_path == result.path.empty()) return has_path ? "no path" : "a path, though the outcome is a refusal";
    for (const Pose2& pose : result.path)
      if (!is_finite(pose)) return "the path is not finite at " + text_of(pose);
    if (!std::isfinite(result.cost_m) || result.cost_m < 0.0) return "cost_m is " + text_of(result.cost_m);
    if (std::abs(result.length_m - length_of(result.path)) > 1e-6)
      return "length_m is " + text_of(result.length_m) + ", the path's length " + text_of(length_of(result.path));
    if (!(result.clearance_m >= 0.0)) return "clearance_m is " + text_of(result.clearance_m);
    return {};
  }
  [[nodiscard]] std::string drawing_of(const Result& result) const override { return world_.drawing(result.path); }
  // How far an end of a path is from what was asked.
  static double off_by_m(const Pose2& end, const Place& place, const LandmarkGraph& graph) {
    const Pose2 wanted = place.pose ? *place.pose : *graph.find(place.landmarks.front())->access;
    return (end.position() - wanted.position()).norm();
  }

  void expect_the_door_passed() const {
    const auto planner = this->make();
    const std::vector<Request> requests = this->requests_for(*planner);
    ASSERT_FALSE(requests.empty()) << "neither a request between poses nor one between landmarks is taken";
    for (const Request& request : requests) {
      const Result result = planner->plan(request, world_.view(), Budget{});
      ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason << world_.drawing({});
      EXPECT_EQ(this->fault_of(result), "");
    }
  }
  void expect_the_ends_that_were_asked() const {
    const auto planner = this->make();
    for (const Request& request : this->requests_for(*planner)) {
      const Result result = planner->plan(request, world_.view(), Budget{});
      ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
      EXPECT_LT(off_by_m(result.path.front(), request.from, world_.graph), 1e-6) << world_.drawing(result.path);
      EXPECT_LT(off_by_m(result.path.back(), request.to, world_.graph), 1e-6) << world_.drawing(result.path);
    }
  }
  void expect_clear_paths(double margin_m) const {
    const auto planner = this->make();
    for (const Request& request : this->requests_for(*planner)) {
      const Result result = planner->plan(request, world_.view(), Budget{});
      EXPECT_GE(distance_to_occupied_m(world_.grid, result.path), kRadius_m + margin_m - 1e-6)
          << "a disc of radius_m, and the planner's margin, must fit all along a solved path"
          << world_.drawing(result.path);
    }
  }
  void expect_headings_kept() const {
    const auto planner = this->make();
    Request request = between(world_.left, {world_.right.x_m, world_.right.y_m, 2.0});
    request.to.heading_matters = true;
    const Result result = planner->plan(request, world_.view(), Budget{});
    if (result.outcome != PlanOutcome::solved) return;  // it may refuse, but not ignore
    EXPECT_NEAR(wrap_angle(result.path.back().theta_rad - 2.0), 0.0, 1e-6)
        << "heading_matters: the last pose has the heading that was asked for";
  }
  void expect_walls_never_entered() const {
    this->expect_never_solved(between(world_.left, world_.in_the_wall), world_.view(), "the goal is inside a wall");
    this->expect_never_solved(between(world_.in_the_wall, world_.left), world_.view(), "the start is inside a wall");
  }
  void expect_closed_rooms_never_reached() const {
    this->expect_never_solved(between(world_.left, world_.behind_walls), world_.view(), "the room has no door");
    this->expect_never_solved(between(1, 3), world_.view(), "no path and no route leads to the landmark");
    this->expect_never_solved(between(world_.left, world_.outside), world_.view(), "the goal is off the map");
  }
  void expect_narrow_doors_refused() const {
    Request request = between(world_.left, world_.right);
    for (const double radius_m : {0.35, 3.0, 1e4}) {
      request.radius_m = radius_m;
      this->expect_never_solved(request, world_.view(), "radius_m is " + text_of(radius_m) + ", the door 0.6 m wide");
    }
  }
  void expect_bad_radii_refused() const {
    const auto planner = this->make();
    Request request = between(world_.left, world_.right);
    for (const double radius_m : {kNan, kInfinity, -1.0, kHuge}) {
      request.radius_m = radius_m;
      try {
        const Result result = planner->plan(request, world_.view(), Budget{});
        EXPECT_NE(result.outcome, PlanOutcome::solved) << "radius_m is " << radius_m;
      } catch (const std::exception& error) {
        EXPECT_STRNE(error.what(), "") << "say what was wrong";
      }
    }
    for (const Request& good : this->requests_for(*planner))
      EXPECT_EQ(planner->plan(good, world_.view(), Budget{}).outcome, PlanOutcome::solved)
          << "a good call after a refused one";
  }
  void expect_bad_places_as_outcomes() const {
    const auto planner = this->make();
    for (const Pose2& odd : odd_poses()) {
      if (odd.theta_rad != 0.0 && std::isfinite(odd.theta_rad)) continue;  // a full turn more is no fault
      for (const Request& request : {between(world_.left, odd), between(odd, world_.left)}) {
        Result result;
        ASSERT_NO_THROW(result = planner->plan(request, world_.view(), Budget{})) << "place " << text_of(odd);
        EXPECT_NE(result.outcome, PlanOutcome::solved) << "place " << text_of(odd);
        EXPECT_EQ(this->fault_of(result), "") << "place " << text_of(odd);
      }
    }
    Request nowhere = between(1, 2);
    nowhere.to = {};
    for (const Request& request : {nowhere, between(1, 77), between(77, 1)})
      EXPECT_EQ(planner->plan(request, world_.view(), Budget{}).outcome, PlanOutcome::unknown_place);
  }
  void expect_empty_maps_as_outcomes() const {
    const OccupancyGrid grid(0.1);
    const LandmarkGraph graph;
    const WorldView empty{grid, graph, world_.robot, {}, 0.0, nullptr, 0.0};
    this->expect_never_solved(between(world_.left, world_.right), empty, "the grid is empty");
    this->expect_never_solved(between(1, 2), empty, "there are no landmarks");
  }
  void expect_no_detours_to_where_it_is() const {
    const auto planner = this->make();
    for (const Request& request : {between(world_.left, world_.left), between(1, 1)}) {
      const Result result = planner->plan(request, world_.view(), Budget{});
      EXPECT_EQ(this->fault_of(result), "");
      EXPECT_TRUE(result.outcome != PlanOutcome::solved || result.length_m < 0.1) << world_.drawing(result.path);
    }
  }
};

}  // namespace cairn::conformance

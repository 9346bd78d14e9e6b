#include "tests/conformance/behaviour_host.hpp"

#include <algorithm>
#include <cmath>

#include "maps/geometry/segments.hpp"
#include "maps/grid/travel_field.hpp"
#include "tests/conformance/fixtures.hpp"
#include "tests/conformance/texts.hpp"

namespace cairn::conformance {

BehaviourHost::BehaviourHost()
    : robot(eight_sonar_robot()), grid(grid_of_room(0.05)), T_map_robot(kRoomStart), room_(grid), exchanged_(grid) {
  Landmark landmark;
  landmark.category = "square";
  landmark.T_map_landmark = {4.5, 4.0, 0.0};
  landmark.access = {4.5, 3.5, 0.0};
  graph.add(landmark);
}

void BehaviourHost::drive(const Twist& wanted) {
  if (fault_.empty() && !(std::isfinite(wanted.v_mps) && std::isfinite(wanted.w_radps)))
    fault_ = "drive(" + text_of(wanted) + ") at " + text_of(time_s) + " s";
  wanted_ = wanted;
  record_ += "drive " + text_of(wanted) + "\n";
}

ControlResult BehaviourHost::control(const ControlRequest& request) {
  ControlResult result;
  result.state = ControlState::arrived;
  result.progress = request.progress;
  if (request.path.empty() || !is_finite(T_map_robot)) return result;
  double begin_m = 0.0;
  Point aim = request.path.back();
  bool has_aim = false;
  for (std::size_t i = 0; i + 1 < request.path.size(); ++i) {
    begin_m += (request.path[i + 1] - request.path[i]).norm();
    if (has_aim || begin_m < request.progress.along_m + 0.2) continue;
    aim = request.path[i + 1];
    has_aim = true;
  }
  const Point to_aim = inverse(T_map_robot) * aim;
  const double to_end_m = (request.path.back() - T_map_robot.position()).norm();
  result.left_m = std::max(0.0, begin_m - request.progress.along_m);
  if (!has_aim && to_end_m <= request.tolerance_m) return result;
  result.state = ControlState::following;
  const double error_rad = to_aim.norm() < 1e-9 ? 0.0 : std::atan2(to_aim.y(), to_aim.x());
  const double max_radps = std::min(1.0, robot.max_w_radps);
  const double v_mps = std::min({request.speed_mps, request.speed_limit_mps, robot.max_v_mps, to_end_m / 0.1});
  result.twist = {std::abs(error_rad) < 0.5 ? v_mps : 0.0, std::clamp(2.0 * error_rad, -max_radps, max_radps)};
  if (!std::isfinite(result.twist.v_mps) || !std::isfinite(result.twist.w_radps)) result.twist = {};
  result.unhindered = result.twist;
  // As far as the robot can have come.
  if (std::abs(error_rad) < 0.5 || to_aim.norm() < 0.2) result.progress.along_m += v_mps * std::abs(tick_s);
  result.progress.along_m = std::min(result.progress.along_m, begin_m);
  return result;
}

std::optional<Place> BehaviourHost::input(const std::string& name) {
  record_ += "input " + name + "\n";
  const auto found = values_.find(name);
  return found == values_.end() ? std::nullopt : std::optional(found->second);
}

void BehaviourHost::output(const std::string& name, const Place& place) {
  record_ += "output " + name + "\n";
  values_[name] = place;
}

PlanResult BehaviourHost::plan(const PlanRequest& request) {
  record_ += "plan, seed " + std::to_string(request.seed) + "\n";
  PlanResult result;
  result.reason = "no way leads there";
  if (finds_no_route || !request.from.pose) return result;
  result.outcome = PlanOutcome::solved;
  if (finds_empty_paths) return result;
  Pose2 to = request.to.pose.value_or(Pose2{});
  if (!request.to.landmarks.empty()) {
    const Landmark* const landmark = graph.find(request.to.landmarks.front());
    if (landmark != nullptr) to = landmark->access.value_or(landmark->T_map_landmark);
    result.landmarks = request.to.landmarks;
  }
  const DistanceField space(grid, UnknownPolicy::avoid);
  const TravelField travel(space, request.from.pose->position(), request.radius_m + grid.cell_m());
  for (const Cell cell : travel.path_to(space.cell_at(to.position())))
    result.path.push_back({space.centre_of(cell).x(), space.centre_of(cell).y(), 0.0});
  if (result.path.empty()) result.outcome = PlanOutcome::no_route;
  return result;
}

Status BehaviourHost::save(const std::string& file_name) {
  record_ += "save " + file_name + "\n";
  return {StepState::success, "saved " + file_name};
}

Status BehaviourHost::answer(const PlanQuestion& question, const std::string& file_name) {
  record_ += "answer " + question.from + " to " + question.to + " into " + file_name + "\n";
  if (finds_no_route) return {StepState::failure, "no way leads there"};
  return {StepState::success, "answered into " + file_name};
}

Status BehaviourHost::write(const OutputText& output) {
  record_ += (output.append ? "append to " : "write ") + output.file_name + "\n" + output.text;
  return {StepState::success, "wrote " + output.file_name};
}

void BehaviourHost::report(const std::string& sentence) {
  record_ += "say " + sentence + "\n";
}

Status BehaviourHost::name_landmark(LandmarkId id, const std::string& name) {
  record_ += "name L" + std::to_string(id) + " " + name + "\n";
  Landmark* const landmark = graph.find(id);
  if (landmark == nullptr) return {StepState::failure, "there is no landmark L" + std::to_string(id)};
  landmark->name = name;
  return {StepState::success, "L" + std::to_string(id) + " is now " + name};
}

Status BehaviourHost::name_cluster(const std::string& cluster, const std::string& name) {
  record_ += "name " + cluster + " " + name + "\n";
  return {StepState::failure, "there is no cluster " + cluster};
}

void BehaviourHost::answer_order(const Status& answer) {
  record_ += "answer " + answer.reason + "\n";
  if (fault_.empty()) fault_ = "answered an order that nobody gave";
}

// By less than a cell, so that the robot stays where it is in the room.
void BehaviourHost::exchange_map() {
  const Pose2 moved = Pose2{0.01, -0.01, 0.002} * T_map_robot;
  last_map_move_.reset();
  if (knows_map_moves) last_map_move_.emplace(std::vector<Pose2>{T_map_robot}, std::vector<Pose2>{moved});
  T_map_robot = moved;
  ++map_moves_;
  exchanged_ = grid;
  is_exchanged_ = !is_exchanged_;
}

Status BehaviourHost::tick(Behaviour& behaviour) {
  wanted_ = {};
  if (ticks_to_exchange > 0 && ++ticks_ % ticks_to_exchange == 0) exchange_map();
  Observation seen = seen_in_room(T_map_robot, time_s, robot);
  if (sees_oddly)
    for (const auto& [what, reading] : odd_readings()) seen.ranges.push_back(reading);
  WorldView world{is_exchanged_ ? exchanged_ : grid,
                  graph,
                  robot,
                  {T_map_robot, 1e-4 * Eigen::Matrix3d::Identity()},
                  time_s,
                  sees ? &seen : nullptr,
                  speed_reduction_ratio_};
  world.map_moves = map_moves_;
  world.last_map_move = last_map_move_ ? &*last_map_move_ : nullptr;
  const Status status = behaviour.tick(world, *this);
  record_ += text_of(status) + "\n";
  speed_reduction_ratio_ = holds_back && wanted_.v_mps != 0.0 ? 1.0 : 0.0;
  if (!holds_back && is_finite(T_map_robot)) {
    const double v_mps = std::clamp(wanted_.v_mps, -robot.max_v_mps, robot.max_v_mps);
    const double w_radps = std::clamp(wanted_.w_radps, -robot.max_w_radps, robot.max_w_radps);
    const Pose2 next = T_map_robot * Pose2{v_mps * tick_s, 0.0, w_radps * tick_s};
    if (room_.state(room_.cell_at(next.position())) == CellState::free) T_map_robot = next;
  }
  time_s += tick_s;
  return status;
}

Status BehaviourHost::run(Behaviour& behaviour, double at_most_s) {
  Status status;
  for (int ticks = static_cast<int>(at_most_s / 0.05); ticks > 0 && status.state == StepState::running; --ticks)
    status = tick(behaviour);
  return status;
}

}  // namespace cairn::conformance

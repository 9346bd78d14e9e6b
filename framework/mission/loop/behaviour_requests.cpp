#include "framework/mission/loop/behaviour_requests.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/planning/landmark_names.hpp"
#include "framework/planning/margins.hpp"
#include "framework/planning/plan_answer.hpp"
#include "framework/planning/plan_task.hpp"
#include "framework/planning/tour.hpp"

namespace cairn {
namespace {

constexpr std::size_t kQuestionSeed = 2;  // 0: the planner itself, 1: joining landmarks

}  // namespace

void BehaviourRequests::begin(const TreeNode& leaf) {
  asking_ = &leaf;
  (void)take();
}

void BehaviourRequests::drive(const Twist& wanted) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  if (!host_.monitor.has_drive())
    throw std::runtime_error("wants to drive, but the sensor " + host_.mission.config.sensor.name +
                             " cannot be driven");
  if (!is_finite(wanted)) throw std::runtime_error("asked for a velocity that is not finite");
  asked_.wanted = wanted;
}

ControlResult BehaviourRequests::control(const ControlRequest& request) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  if (!host_.controller)
    throw std::runtime_error("wants to follow a path, but there is no controller: no module " +
                             host_.mission.config.controller.name + " was found");
  ControlRequest asked = request;
  asked.is_new_path = request.is_new_path || controlled_ != asking_;
  controlled_ = asking_;
  if (asked.is_new_path && !asked.path.empty())
    host_.publisher.publish(PathStarted{{asked.path.begin(), asked.path.end()}});
  const WorldView world = host_.world.view();
  const ControlResult result =
      host_.controller.call([&](Controller& controller) { return controller.control(asked, world); });
  if (!is_finite(result.twist) || !is_finite(result.unhindered) || !std::isfinite(result.progress.along_m))
    throw host_.controller.fault("returned a velocity that is not finite");
  return result;
}

PlanResult BehaviourRequests::plan(const PlanRequest& request) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  if (!host_.planning.has_planner()) {
    PlanResult none;
    none.reason = "the mission names no planner";
    return none;
  }
  PlanResult result = host_.planning.plan(request, host_.world.view());
  host_.publisher.publish(PlanDone{result});
  return result;
}

Status BehaviourRequests::answer(const PlanQuestion& question, const std::string& file_name) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  host_.monitor.stand();
  const ClusterTree clusters = host_.planning.clusters(*host_.world.grid);
  PlanTask task;
  try {
    task = task_of(question, host_.world.graph, clusters, host_.world.pose.T_map_robot);
  } catch (const std::exception& error) {
    return {StepState::failure, error.what()};
  }
  task.request.radius_m = host_.mission.robot.radius_m;
  task.request.seed = module_seed(host_.mission.config.seed, PluginKind::planner, kQuestionSeed);
  const std::vector<double> margins_m = usual_margins_m(host_.mission.robot, *host_.world.grid);
  const auto ask = [&](const PlanRequest& request) { return plan(request); };
  const PlanResult result = plan_tour(
      [&](const PlanRequest& request) { return plan_with_margins(ask, request, margins_m); }, task.request, task.via);
  Status written = write({file_name,
                          json_text_of({.question = question,
                                        .result = result,
                                        .graph = host_.world.graph,
                                        .clusters = clusters,
                                        .with_times = false}) +
                              "\n",
                          true});
  if (written.state != StepState::success) return written;
  if (result.outcome == PlanOutcome::solved) return {StepState::success, fmt::format("{:.2f} m", result.length_m)};
  return {StepState::failure, std::string(name_of(result.outcome)) + ": " + result.reason};
}

Status BehaviourRequests::save(const std::string& file_name) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  host_.monitor.stand();
  if (std::string refusal = host_.saving.refusal_of(file_name); !refusal.empty())
    return {StepState::failure, std::move(refusal)};
  Status saved = host_.saving.save(file_name);
  asked_.has_failed_to_save |= saved.state != StepState::success;
  return saved;
}

Status BehaviourRequests::write(const OutputText& output) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  return texts_.write(output);
}

void BehaviourRequests::report(const std::string& sentence) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  host_.publisher.publish(Message{sentence});
}

std::optional<Place> BehaviourRequests::input(const std::string& name) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  const auto found = values_.find(name);
  return found == values_.end() ? std::nullopt : std::optional(found->second);
}

void BehaviourRequests::output(const std::string& name, const Place& place) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  if (!values_.contains(name) && values_.size() >= kMaxNamedValues)
    throw std::runtime_error("gives more than " + std::to_string(kMaxNamedValues) + " named values");
  values_[name] = place;
}

void BehaviourRequests::move_places(const MapMove& move) {
  for (auto& [name, place] : values_)
    if (place.pose) place.pose = move.near(place.pose->position()) * *place.pose;
}

Status BehaviourRequests::name_landmark(LandmarkId id, const std::string& name) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  const LandmarkGraph& graph = host_.tracker.graph();
  const Landmark* const landmark = graph.find(id);
  if (landmark == nullptr) return {StepState::failure, fmt::format("there is no landmark L{}", id)};
  const ClusterTree clusters = host_.planning.hierarchies().last_tree();
  if (const std::string refusal = refusal_of_name(name, graph, clusters, &landmark->name); !refusal.empty())
    return {StepState::failure, "the name " + in_quotes(name) + " cannot be given: " + refusal};
  const std::string before = label_of(*landmark);
  host_.tracker.name(id, name);
  return {StepState::success, before + " is now " + name};
}

Status BehaviourRequests::name_cluster(const std::string& cluster, const std::string& name) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  const LandmarkGraph& graph = host_.tracker.graph();
  const ClusterTree clusters = host_.planning.hierarchies().last_tree();
  const Cluster* const found = find_cluster(clusters, graph, cluster);
  if (found == nullptr) return {StepState::failure, "there is no cluster " + in_quotes(cluster)};
  if (const std::string refusal = refusal_of_name(name, graph, clusters, &found->name); !refusal.empty())
    return {StepState::failure, "the name " + in_quotes(name) + " cannot be given: " + refusal};
  host_.planning.name_cluster(found->id, name);
  return {StepState::success, label_of(*found, graph) + " is now " + name};
}

std::optional<Order> BehaviourRequests::next_order() {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  return host_.orders.next();
}

void BehaviourRequests::answer_order(const Status& answer) {
  const StageClock::Visit visit(host_.clock, StageClock::kHost);
  host_.orders.answer(answer);
}

}  // namespace cairn

// The steps of a mission: a tree each, ticked one after the other.

#include "framework/mission/loop.hpp"

namespace cairn {

void MissionLoop::build_trees() {
  const std::vector<const TreeNode*> nodes = behaviours_of(mission_.steps);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    behaviours_[nodes[i]] = {modules_.behaviours[i].get(), clock_.add("behaviour", nodes[i]->choice.name)};
  for (const TreeNode& step : mission_.steps) trees_.emplace_back(step, static_cast<TreeHost&>(*this));
}

void MissionLoop::behave() {
  wanted_ = Twist{};
  if (step_ >= trees_.size() || paused_) return;
  const TreeNode& step = mission_.steps[step_];
  if (!step_begun_) begin_step(step.name);
  const Status status = trees_[step_].tick(result_.time_s);
  wanted_ = trees_[step_].wanted().value_or(Twist{});
  if (status.progress != Progress::running) end_step(step, status);
}

void MissionLoop::begin_step(const std::string& name) {
  step_begun_ = true;
  result_.steps.push_back({name, {}, result_.time_s, result_.time_s});
  publish(StepStarted{static_cast<int>(step_), name});
}

void MissionLoop::end_step(const TreeNode& step, const Status& status) {
  result_.steps.back().status = status;
  result_.steps.back().end_s = result_.time_s;
  publish(StepEnded{static_cast<int>(step_), step.name, status});
  step_begun_ = false;
  ++step_;
  const bool is_forgiven = step.kind == NodeKind::behaviour && save_failed_;
  failed_step_ = status.progress == Progress::failure && !is_forgiven;
  failure_ = "step " + std::to_string(step_) + " (" + step.name + "): " + status.reason;
  connect_landmarks();
}

void MissionLoop::halt_step() {
  const std::string reason = result_.reason;
  tree_left_ = trees_[step_].state();
  result_.steps.back().status = {Progress::failure, "halted: " + reason};
  result_.steps.back().end_s = result_.time_s;
  while (trees_[step_].is_running()) {
    try {
      trees_[step_].halt(result_.time_s, reason);
    } catch (const ModuleFault& fault) {
      result_.reason += std::string("; ") + fault.what();
    }
  }
}

void MissionLoop::note_nodes() {
  result_.nodes.clear();
  for (const TreeRunner& tree : trees_)
    for (const NodeReport& report : tree.reports()) result_.nodes.push_back(report);
}

LeafTick MissionLoop::tick_leaf(const TreeNode& leaf) {
  if (is_condition(leaf.kind)) return {check_(leaf, view())};
  Leaf& asked = behaviours_.at(&leaf);
  // Only halt() promises that it begins afresh.
  if (asked.has_ended) halt_leaf(leaf);
  ordered_.reset();
  ticked_ = &leaf;
  save_failed_ = false;
  const Status status = in_stage(asked.stage, [&] { return asked.behaviour->tick(view(), *this); });
  asked.has_ended = status.progress != Progress::running;
  return {status, ordered_, save_failed_ && status.progress == Progress::failure};
}

void MissionLoop::halt_leaf(const TreeNode& leaf) {
  Leaf& asked = behaviours_.at(&leaf);
  asked.has_ended = false;
  in_stage(asked.stage, [&] { asked.behaviour->halt(); });
}

void MissionLoop::started(const TreeNode& node) {
  publish(NodeStarted{node.path, node.name, node.kind});
}

void MissionLoop::ended(const TreeNode& node, const NodeReport& how) {
  publish(NodeEnded{node.path, node.name, node.kind, how.status, how.is_halted});
}

void MissionLoop::ran(const TreeNode& node, const NodeReport& how, double begun_s) {
  result_.node_runs.add(node, how, begun_s);
  if (node.kind == NodeKind::behaviour && !how.is_halted) node_times_.add(how.kind, how.end_s - begun_s);
}

}  // namespace cairn

#include "framework/mission/loop/steps.hpp"

#include <algorithm>

namespace cairn {

Steps::Steps(const HostParts& host, const std::vector<Staged<Behaviour>>& behaviours, TextFiles texts)
    : steps_(host.mission.steps), publisher_(host.publisher), leaves_(host, behaviours, std::move(texts)) {
  for (const TreeNode& step : steps_) trees_.emplace_back(step, leaves_);
}

void Steps::restore(const SavedMap& map) {
  step_ = static_cast<std::size_t>(map.progress->step);
  leaves_.restore(saved_named_values(map));
  restore_tree(map);
}

// Only into the tree that it is of: with another one the step begins afresh.
void Steps::restore_tree(const SavedMap& map) {
  if (are_done()) return;
  const std::optional<SavedTree> saved = saved_tree(map);
  if (!saved) return;
  if (saved->fingerprint != tree_fingerprint(steps_[step_])) {
    not_restored_ = "step " + std::to_string(step_ + 1) + " (" + steps_[step_].name +
                    ") is not written as when the map was saved: it begins afresh";
    return;
  }
  try {
    trees_[step_].restore(saved->state, map.progress->time_s);
  } catch (const std::invalid_argument& error) {
    throw StoreError(std::string("cannot be resumed: its property ") + kTreeStateProperty + ": " + error.what());
  }
}

void Steps::recover_by(Staged<Behaviour> behaviour, const std::string& name) {
  recovery_node_.name = recovery_node_.choice.name = name;
  recovery_node_.path = "0";  // before the first step of the file
  leaves_.add(recovery_node_, std::move(behaviour));
  recovery_.emplace(recovery_node_, leaves_);
}

void Steps::lose() {
  if (is_under_way_) trees_[step_].begin_leaves_afresh();
  is_recovering_ = recovery_.has_value();
  if (!recovery_) failure_ = "the robot does not know where it is, and no module can find out";
}

// It ends itself in the tick after the robot was found.
StepsTick Steps::recover(double time_s) {
  const Status status = recovery_->tick(time_s);
  if (status.state == StepState::running) return {recovery_->wanted().value_or(Twist{}), false};
  is_recovering_ = false;
  if (status.state == StepState::failure) failure_ = recovery_node_.name + ": " + status.reason;
  return {};
}

StepsTick Steps::tick(double time_s) {
  if (is_recovering_) return recover(time_s);
  if (are_done()) return {};
  const TreeNode& step = steps_[step_];
  TreeRunner& tree = trees_[step_];
  if (!is_under_way_) begin(step.name, time_s);
  const Status status = tree.tick(time_s);
  const Twist wanted = tree.wanted().value_or(Twist{});
  if (status.state == StepState::running) return {wanted, false};
  end(step, status, time_s);
  return {wanted, true};
}

void Steps::begin(const std::string& name, double time_s) {
  is_under_way_ = true;
  reports_.push_back({name, {}, time_s, time_s});
  publisher_.publish(StepStarted{static_cast<int>(step_), name});
}

void Steps::end(const TreeNode& step, const Status& status, double time_s) {
  reports_.back().status = status;
  reports_.back().end_s = time_s;
  publisher_.publish(StepEnded{static_cast<int>(step_), step.name, status});
  is_under_way_ = false;
  ++step_;
  const bool is_forgiven = step.kind == NodeKind::behaviour && leaves_.has_failed_to_save();
  if (status.state == StepState::failure && !is_forgiven)
    failure_ = "step " + std::to_string(step_) + " (" + step.name + "): " + status.reason;
}

void Steps::close_report(double time_s, const std::string& reason) {
  tree_left_ = trees_[step_].state();
  reports_.back().status = {StepState::failure, reason};
  reports_.back().end_s = time_s;
}

std::vector<std::string> Steps::halt(double time_s, const std::string& reason) {
  std::vector<std::string> faults;
  if (is_recovering_) {
    try {
      recovery_->halt(time_s, reason);
    } catch (const ModuleFault& fault) {
      faults.emplace_back(fault.what());
    }
  }
  if (!is_under_way_) return faults;
  close_report(time_s, "halted: " + reason);
  while (trees_[step_].is_running()) {
    try {
      trees_[step_].halt(time_s, reason);
    } catch (const ModuleFault& fault) {
      faults.emplace_back(fault.what());
    }
  }
  return faults;
}

void Steps::abandon(double time_s, const std::string& reason) {
  if (is_recovering_) recovery_->abandon(time_s, "given up: " + reason);
  if (!is_under_way_) return;
  close_report(time_s, "given up: " + reason);
  trees_[step_].abandon(time_s, reports_.back().status.reason);
}

std::vector<NodeReport> Steps::node_reports() const {
  std::vector<NodeReport> all;
  if (recovery_) all = recovery_->reports();
  for (const TreeRunner& tree : trees_)
    for (const NodeReport& report : tree.reports()) all.push_back(report);
  return all;
}

// A step that has failed is done once more.
void Steps::describe(MissionProgress& progress) const {
  const std::size_t step = failure_ ? step_ - 1 : step_;
  progress.step = static_cast<int>(step);
  if (step < steps_.size()) progress.step_name = steps_[step].name;
}

void Steps::describe(SavedMap& map) const {
  add_named_values(map, leaves_.values());
  if (!are_done() && is_under_way_)
    add_tree(map, {tree_fingerprint(steps_[step_]), tree_left_ ? *tree_left_ : trees_[step_].state()});
}

void Steps::describe(RunStatus& status) const {
  status.steps = steps_.size();
  status.step = std::min(step_ + 1, status.steps);
  if (!are_done()) status.step_name = steps_[step_].name;
}

void Steps::describe_doing(RunStatus& status) const {
  if (are_done() && !is_recovering_) return;
  const auto doing = is_recovering_ ? recovery_->doing() : trees_[step_].doing();
  if (!doing) return;
  status.node = doing->path;
  status.doing = doing->reason;
}

std::optional<TimeLeft> Steps::time_left(double time_s, double max_s) const {
  if (trees_.empty()) return std::nullopt;
  TimeLeft left{0.0, 0.0, {}};
  for (std::size_t i = step_; i < trees_.size(); ++i)
    left = one_after_other(std::move(left), trees_[i].time_left(time_s, leaves_.times()));
  return cut(std::move(left), max_s);
}

}  // namespace cairn

// The steps of a mission: a behaviour tree each, ticked one after the other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/mission/loop/leaves.hpp"
#include "framework/mission/resume.hpp"
#include "framework/mission/runner.hpp"

namespace cairn {

// What the steps make of one tick.
struct StepsTick {
  Twist wanted{};               // velocity
  bool has_ended_step = false;  // with this tick
};

class Steps {
 public:
  Steps(const HostParts& host, const std::vector<Staged<Behaviour>>& behaviours, TextFiles texts);

  // Goes on from there. Throws StoreError when the map's tree state cannot be.
  void restore(const SavedMap& map);
  // For people: why the step under way begins afresh although the map holds where it was. Empty: it does not.
  [[nodiscard]] const std::string& not_restored() const { return not_restored_; }

  // While the robot is lost, that behaviour is ticked in the place of the steps. At most once, before all below.
  void recover_by(Staged<Behaviour> behaviour, const std::string& name);
  // The robot does not know where it is any more. The step under way waits, and what it does then begins afresh.
  void lose();

  // The map has been drawn anew: places that behaviours hand over move along.
  void move_places(const MapMove& move) { leaves_.move_places(move); }

  // Throws ModuleFault.
  StepsTick tick(double time_s);
  // The step under way, if any, is left. Sentences on modules that failed meanwhile.
  std::vector<std::string> halt(double time_s, const std::string& reason);
  // The same, but no module is called any more.
  void abandon(double time_s, const std::string& reason);

  [[nodiscard]] bool are_done() const { return step_ == trees_.size(); }
  [[nodiscard]] const std::optional<std::string>& failure() const { return failure_; }  // that ends the mission
  [[nodiscard]] const std::vector<StepReport>& reports() const { return reports_; }
  [[nodiscard]] const NodeRuns& node_runs() const { return leaves_.runs(); }
  [[nodiscard]] std::vector<NodeReport> node_reports() const;

  // For a saved map: the step to go on with, and where in its tree the mission is.
  void describe(MissionProgress& progress) const;
  void describe(SavedMap& map) const;
  // For people: which step is under way, and what it does.
  void describe(RunStatus& status) const;
  void describe_doing(RunStatus& status) const;
  // About how long all of them still take, at most max_s; nothing without steps.
  [[nodiscard]] std::optional<TimeLeft> time_left(double time_s, double max_s) const;

 private:
  void begin(const std::string& name, double time_s);
  void end(const TreeNode& step, const Status& status, double time_s);
  void close_report(double time_s, const std::string& reason);
  StepsTick recover(double time_s);
  void restore_tree(const SavedMap& map);

  const std::vector<TreeNode>& steps_;
  Publisher& publisher_;
  Leaves leaves_;
  std::vector<TreeRunner> trees_;  // one a step
  TreeNode recovery_node_;
  std::optional<TreeRunner> recovery_;
  bool is_recovering_ = false;
  std::vector<StepReport> reports_;
  std::size_t step_ = 0;
  bool is_under_way_ = false;
  std::optional<std::string> failure_;
  std::optional<TreeState> tree_left_;  // of the step under way, before it was halted
  std::string not_restored_;
};

}  // namespace cairn

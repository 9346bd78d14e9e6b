// The leaves of the mission's trees: calls their behaviours, checks their conditions, and counts what its nodes do.
#pragma once

#include <map>
#include <vector>

#include "framework/behaviour_tree/condition.hpp"
#include "framework/behaviour_tree/node_runs.hpp"
#include "framework/behaviour_tree/runner.hpp"
#include "framework/mission/loop/behaviour_requests.hpp"
#include "framework/mission/loop/staged_modules.hpp"

namespace cairn {

class Leaves final : public TreeHost {
 public:
  // behaviours: in the order of behaviours_of() of the mission's steps.
  Leaves(const HostParts& host, const std::vector<Staged<Behaviour>>& behaviours, TextFiles texts);

  // One that is in no step.
  void add(const TreeNode& node, Staged<Behaviour> behaviour) { leaves_[&node] = {std::move(behaviour)}; }

  LeafTick tick_leaf(const TreeNode& leaf) override;
  void halt_leaf(const TreeNode& leaf) override;
  void started(const TreeNode& node) override;
  void ended(const TreeNode& node, const NodeReport& how) override;
  void ran(const TreeNode& node, const NodeReport& how, double begun_s) override;

  // Places that behaviours hand to later ones.
  [[nodiscard]] const NamedValues& values() const { return requests_.values(); }
  void restore(NamedValues values) { requests_.restore(std::move(values)); }
  void move_places(const MapMove& move) { requests_.move_places(move); }
  [[nodiscard]] const NodeRuns& runs() const { return runs_; }
  [[nodiscard]] const NodeTimes& times() const { return times_; }
  // The behaviour that was ticked last has asked for a save that failed: how it ends matters less than where it drives.
  [[nodiscard]] bool has_failed_to_save() const { return has_failed_to_save_; }

 private:
  struct Leaf {
    Staged<Behaviour> behaviour;
    bool has_ended = false;
  };
  [[nodiscard]] bool waits(const Leaf& leaf) const;

  const WorldState& world_;
  Publisher& publisher_;
  BehaviourRequests requests_;
  std::map<const TreeNode*, Leaf> leaves_;  // the behaviours
  ConditionCheck check_;
  NodeRuns runs_;
  NodeTimes times_;
  bool has_failed_to_save_ = false;
};

}  // namespace cairn

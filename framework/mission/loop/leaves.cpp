#include "framework/mission/loop/leaves.hpp"

namespace cairn {

Leaves::Leaves(const HostParts& host, const std::vector<Staged<Behaviour>>& behaviours, TextFiles texts)
    : world_(host.world), publisher_(host.publisher), requests_(host, std::move(texts)) {
  const std::vector<const TreeNode*> nodes = behaviours_of(host.mission.steps);
  for (std::size_t i = 0; i < nodes.size(); ++i) leaves_[nodes[i]] = {behaviours[i]};
}

LeafTick Leaves::tick_leaf(const TreeNode& node) {
  if (is_condition(node.kind)) return {check_(node, world_.view())};
  Leaf& leaf = leaves_.at(&node);
  if (waits(leaf)) return {{StepState::running, "waits: the robot does not know where it is"}};
  // Only halt() promises that it begins afresh.
  if (leaf.has_ended) halt_leaf(node);
  requests_.begin(node);
  const Status status =
      leaf.behaviour.call([&](Behaviour& behaviour) { return behaviour.tick(world_.view(), requests_); });
  leaf.has_ended = status.state != StepState::running;
  const LeafRequests asked = requests_.take();
  has_failed_to_save_ = asked.has_failed_to_save;
  return {status, asked.wanted, has_failed_to_save_ && status.state == StepState::failure};
}

bool Leaves::waits(const Leaf& leaf) const {
  return world_.is_lost() && leaf.behaviour.call([](const Behaviour& behaviour) { return behaviour.needs_pose(); });
}

void Leaves::halt_leaf(const TreeNode& node) {
  Leaf& leaf = leaves_.at(&node);
  leaf.has_ended = false;
  leaf.behaviour.call([](Behaviour& behaviour) { behaviour.halt(); });
}

void Leaves::started(const TreeNode& node) {
  publisher_.publish(NodeStarted{node.path, node.name, node.kind});
}

void Leaves::ended(const TreeNode& node, const NodeReport& how) {
  publisher_.publish(NodeEnded{node.path, node.name, node.kind, how.status, how.is_halted});
}

void Leaves::ran(const TreeNode& node, const NodeReport& how, double begun_s) {
  runs_.add(node, how, begun_s);
  if (node.kind == NodeKind::behaviour && !how.is_halted) times_.add(how.kind, how.end_s - begun_s);
}

}  // namespace cairn

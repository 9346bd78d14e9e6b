// The memory of a tree as data, there and back.

#include <stdexcept>

#include "framework/behaviour_tree/runner.hpp"
#include "maps/base/spelling.hpp"

namespace cairn {
namespace {

constexpr double kSlack_s = 1e-6;

[[noreturn]] void fail(const NodeState& saved, const std::string& what) {
  throw std::invalid_argument("node " + in_quotes(saved.path) + " " + what);
}

bool has_memory(NodeKind kind) {
  return kind == NodeKind::sequence || kind == NodeKind::mission || kind == NodeKind::fallback;
}

bool counts(NodeKind kind) {
  return kind == NodeKind::repeat || kind == NodeKind::retry;
}

}  // namespace

std::optional<TreeRunner::Doing> TreeRunner::doing() const {
  if (!doing_ || !states_[*doing_].is_running) return std::nullopt;
  const State& state = states_[*doing_];
  return Doing{state.report.path, state.report.name, state.reported.reason};
}

TreeState TreeRunner::state() const {
  TreeState all;
  for (const State& state : states_) {
    if (!state.is_running || is_leaf(state.node->kind)) continue;
    all.running.push_back({state.node->path, state.next, state.rounds, state.begun_s, state.failures, state.outcomes});
  }
  return all;
}

void TreeRunner::restore(const TreeState& saved, double time_s) {
  std::map<std::string, std::size_t> by_path;
  for (std::size_t i = 0; i < states_.size(); ++i) by_path[states_[i].node->path] = i;
  for (const NodeState& node : saved.running) {
    const auto found = by_path.find(node.path);
    if (found == by_path.end()) fail(node, "is not in this step");
    State& state = states_[found->second];
    if (is_leaf(state.node->kind)) fail(node, "is not a node that remembers");
    if (state.is_running) fail(node, "is there twice");
    const State& parent = states_[state.parent];
    if (found->second != 0 && !parent.is_running) fail(node, "is under way, but the node above it is not");
    if (found->second != 0 && has_memory(parent.node->kind) && parent.children[parent.next] != found->second)
      fail(node, "is under way, but it is not its turn");
    restore(state, node, time_s);
  }
}

void TreeRunner::restore(State& state, const NodeState& saved, double time_s) {
  const TreeNode& node = *state.node;
  if (saved.next >= (has_memory(node.kind) ? node.children.size() : 1)) fail(saved, "has no such child");
  const bool ends = counts(node.kind) && node.times > 0 && saved.rounds >= node.times;
  if (saved.rounds < 0 || ends || (!counts(node.kind) && saved.rounds > 0)) fail(saved, "cannot have done such rounds");
  if (saved.begun_s < 0.0 || saved.begun_s > time_s + kSlack_s) fail(saved, "has begun at a time that has not come");
  const std::size_t most = node.kind == NodeKind::parallel ? node.children.size() : 0;
  if (!saved.outcomes.empty() && saved.outcomes.size() != most) fail(saved, "has outcomes of other children");
  state.is_running = true;
  state.next = saved.next;
  state.rounds = saved.rounds;
  state.begun_s = saved.begun_s;
  state.failures = saved.failures;
  state.outcomes = saved.outcomes;
  state.report.runs = 1;
  state.report.begin_s = saved.begun_s;
}

}  // namespace cairn

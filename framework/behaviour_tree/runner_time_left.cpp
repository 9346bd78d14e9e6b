// How long a tree still takes: what its leaves say, and how long its nodes took before.

#include <algorithm>
#include <cmath>

#include "framework/behaviour_tree/runner.hpp"

namespace cairn {
namespace {

constexpr double kForEver_s = std::numeric_limits<double>::infinity();

TimeLeft nothing() {
  return {0.0, 0.0, {}};
}

TimeLeft side_by_side(TimeLeft a, const TimeLeft& b) {
  a.about_s = std::max(a.about_s, b.about_s);
  a.max_s = std::max(a.max_s, b.max_s);
  for (const std::string& what : b.without) add_unknown(a, what);
  return a;
}

TimeLeft again(TimeLeft one, double times) {
  one.about_s *= times;
  one.max_s *= times;
  return one;
}

bool asks_only(const TreeNode& node) {
  if (node.children.empty()) return is_condition(node.kind);
  return std::all_of(node.children.begin(), node.children.end(), asks_only);
}

}  // namespace

void NodeTimes::add(const std::string& kind, double took_s) {
  Sum& sum = sums_[kind];
  sum.took_s += took_s;
  ++sum.count;
}

std::optional<double> NodeTimes::mean_s(const std::string& kind) const {
  const auto found = sums_.find(kind);
  if (found == sums_.end()) return std::nullopt;
  return found->second.took_s / static_cast<double>(found->second.count);
}

TimeLeft TreeRunner::time_left(double time_s, const NodeTimes& times) const {
  return left_of(0, {time_s, times});
}

TimeLeft TreeRunner::left_of(std::size_t at, const Reckoning& reckoning) const {
  const State& state = states_[at];
  if (!state.is_running) return whole_of(at, reckoning);
  const auto child = [&](std::size_t i) { return left_of(state.children[i], reckoning); };
  TimeLeft left = nothing();
  switch (state.node->kind) {
    case NodeKind::sequence:
    case NodeKind::mission:
      for (std::size_t i = state.next; i < state.children.size(); ++i)
        left = one_after_other(std::move(left), child(i));
      return left;
    case NodeKind::fallback:
      return state.next < state.children.size() ? child(state.next) : left;
    case NodeKind::reactive_sequence:
      return in_order_from_running(state, reckoning);
    case NodeKind::reactive_fallback:
      for (const std::size_t index : state.children)
        if (states_[index].is_running) return left_of(index, reckoning);
      return left;
    case NodeKind::parallel:
      for (std::size_t i = 0; i < state.children.size(); ++i)
        if (i >= state.outcomes.size() || state.outcomes[i].state == StepState::running)
          left = side_by_side(std::move(left), child(i));
      return left;
    case NodeKind::repeat:
      return rounds_left(state, reckoning);
    case NodeKind::timeout:
      return cut(child(0), state.node->after_s - (reckoning.time_s - state.begun_s));
    case NodeKind::retry:
    case NodeKind::inverse:
    case NodeKind::force_success:
      return child(0);
    default:
      return leaf_left(state, reckoning);
  }
}

TimeLeft TreeRunner::leaf_left(const State& state, const Reckoning& reckoning) const {
  TimeLeft left;
  const std::optional<double> mean_s = reckoning.times.mean_s(state.report.kind);
  if (state.reported.left_s && std::isfinite(*state.reported.left_s))
    left.about_s = std::max(0.0, *state.reported.left_s);
  else if (mean_s)
    left.about_s = std::max(0.0, *mean_s - (reckoning.time_s - state.begun_s));
  else if (!is_condition(state.node->kind))
    left.without.push_back(state.report.kind);
  return left;
}

TimeLeft TreeRunner::in_order_from_running(const State& state, const Reckoning& reckoning) const {
  TimeLeft left = nothing();
  bool has_come = false;
  for (const std::size_t index : state.children) {
    has_come = has_come || states_[index].is_running;
    if (has_come) left = one_after_other(std::move(left), left_of(index, reckoning));
  }
  return left;
}

// The first round is taken to be as long as it has lasted and still will.
TimeLeft TreeRunner::rounds_left(const State& state, const Reckoning& reckoning) const {
  const std::size_t child = state.children.front();
  const State& round = states_[child];
  const TimeLeft now = left_of(child, reckoning);
  TimeLeft left = now;
  if (state.node->times == 0) {
    left.max_s = kForEver_s;
    add_unknown(left, "rounds without end");
    return left;
  }
  TimeLeft whole = whole_of(child, reckoning);
  if (round.done == 0 && round.is_running) {
    whole.about_s = reckoning.time_s - round.begun_s + now.about_s;
    whole.without = now.without;
  }
  const auto more = static_cast<double>(std::max<std::int64_t>(0, state.node->times - state.rounds - 1));
  return more > 0.0 ? one_after_other(std::move(left), again(std::move(whole), more)) : left;
}

// Of a node that is still to come.
TimeLeft TreeRunner::whole_of(std::size_t at, const Reckoning& reckoning) const {
  const State& state = states_[at];
  TimeLeft left = nothing();
  if (is_condition(state.node->kind)) return left;
  if (state.done > 0) return {state.done_s / static_cast<double>(state.done), kForEver_s, {}};
  const auto child = [&](std::size_t i) { return whole_of(state.children[i], reckoning); };
  switch (state.node->kind) {
    case NodeKind::sequence:
    case NodeKind::mission:
    case NodeKind::reactive_sequence:
      for (std::size_t i = 0; i < state.children.size(); ++i) left = one_after_other(std::move(left), child(i));
      return left;
    case NodeKind::fallback:
    case NodeKind::reactive_fallback:
      for (const std::size_t index : state.children)
        if (!asks_only(*states_[index].node)) return whole_of(index, reckoning);
      return left;
    case NodeKind::parallel:
      for (std::size_t i = 0; i < state.children.size(); ++i) left = side_by_side(std::move(left), child(i));
      return left;
    case NodeKind::repeat:
      left = again(child(0), std::max(1, state.node->times));
      if (state.node->times == 0) {
        left.max_s = kForEver_s;
        add_unknown(left, "rounds without end");
      }
      return left;
    case NodeKind::timeout:
      return cut(child(0), state.node->after_s);
    case NodeKind::retry:
    case NodeKind::inverse:
    case NodeKind::force_success:
      return child(0);
    default:
      left.max_s = kForEver_s;
      if (const auto mean_s = reckoning.times.mean_s(state.report.kind))
        left.about_s = *mean_s;
      else
        left.without.push_back(state.report.kind);
      return left;
  }
}

}  // namespace cairn

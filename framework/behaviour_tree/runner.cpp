#include "framework/behaviour_tree/runner.hpp"

#include <utility>

namespace cairn {
namespace {

std::string after(const std::string& reason) {
  return reason.empty() ? "" : ": " + reason;
}

std::string rounds_text(std::int64_t rounds, int times) {
  return times == 0 ? std::to_string(rounds) : std::to_string(rounds) + " of " + std::to_string(times);
}

}  // namespace

TreeRunner::TreeRunner(const TreeNode& root, TreeHost& host) : host_(host) {
  add(root, 0);
}

std::size_t TreeRunner::add(const TreeNode& node, std::size_t parent) {
  const std::size_t at = states_.size();
  State state;
  state.node = &node;
  state.report.path = node.path;
  state.report.kind = node.choice.name;
  state.report.name = node.name;
  state.parent = parent;
  states_.push_back(std::move(state));
  for (const TreeNode& child : node.children) {
    const std::size_t index = add(child, at);
    states_[at].children.push_back(index);
  }
  return at;
}

Status TreeRunner::tick(double time_s) {
  now_s_ = time_s;
  driver_.reset();
  wanted_.reset();
  return tick_node(0);
}

Status TreeRunner::tick_node(std::size_t at) {
  State& state = states_[at];
  if (!state.is_running) begin(at);
  ++state.report.ticks;
  Status status = tick_kind(at);
  if (status.state == StepState::running) {
    report_start(at);
    return status;
  }
  end(at, status);
  if (state.is_forgiven && at != 0) status.state = StepState::success;
  return status;
}

Status TreeRunner::tick_kind(std::size_t at) {
  State& state = states_[at];
  switch (state.node->kind) {
    case NodeKind::sequence:
    case NodeKind::mission:
      return tick_sequence(state);
    case NodeKind::fallback:
      return tick_fallback(state);
    case NodeKind::reactive_sequence:
      return tick_reactive(state, StepState::success);
    case NodeKind::reactive_fallback:
      return tick_reactive(state, StepState::failure);
    case NodeKind::parallel:
      return tick_parallel(state);
    case NodeKind::repeat:
      return tick_repeat(state);
    case NodeKind::retry:
      return tick_retry(state);
    case NodeKind::timeout:
      return tick_timeout(state);
    case NodeKind::inverse: {
      Status status = tick_node(state.children.front());
      if (status.state == StepState::running) return status;
      const bool has_failed = status.state == StepState::failure;
      status.state = has_failed ? StepState::success : StepState::failure;
      return status;
    }
    case NodeKind::force_success: {
      Status status = tick_node(state.children.front());
      if (status.state == StepState::failure) status.state = StepState::success;
      return status;
    }
    default:
      break;
  }
  if (state.node->kind == NodeKind::behaviour) doing_ = at;
  LeafTick leaf = host_.tick_leaf(*state.node);
  state.reported = leaf.status;
  state.is_forgiven = leaf.is_forgiven;
  if (leaf.wanted && leaf.status.state == StepState::running) {
    driver_ = at;
    wanted_ = leaf.wanted;
  }
  return std::move(leaf.status);
}

std::string TreeRunner::failure_of(std::size_t at, const std::string& reason) const {
  return states_[at].node->name + after(reason);
}

Status TreeRunner::tick_sequence(State& state) {
  Status status{StepState::success, ""};
  while (state.next < state.children.size()) {
    const std::size_t child = state.children[state.next];
    status = tick_node(child);
    if (status.state == StepState::running) return status;
    if (status.state == StepState::failure) return {StepState::failure, failure_of(child, status.reason)};
    ++state.next;
  }
  return status;
}

Status TreeRunner::tick_fallback(State& state) {
  while (state.next < state.children.size()) {
    const std::size_t child = state.children[state.next];
    Status status = tick_node(child);
    if (status.state != StepState::failure) return status;
    state.failures += (state.failures.empty() ? "" : "; ") + failure_of(child, status.reason);
    ++state.next;
  }
  return {StepState::failure, state.failures};
}

Status TreeRunner::tick_reactive(State& state, StepState go_on) {
  Status status{go_on, ""};
  std::string failures;
  for (std::size_t i = 0; i < state.children.size(); ++i) {
    status = tick_node(state.children[i]);
    if (status.state == StepState::failure)
      failures += (failures.empty() ? "" : "; ") + failure_of(state.children[i], status.reason);
    if (status.state == go_on) continue;
    halt_children(state, i + 1, "an earlier child of " + state.node->name + " comes first");
    break;
  }
  if (status.state == StepState::failure) status.reason = failures;
  return status;
}

// Driving is one robot's: the last order of two would win in silence.
Status TreeRunner::tick_parallel(State& state) {
  state.outcomes.resize(state.children.size());
  std::optional<std::size_t> driver;
  std::optional<Twist> wanted;
  for (std::size_t i = 0; i < state.children.size(); ++i) {
    if (state.outcomes[i].state != StepState::running) continue;
    driver_.reset();
    state.outcomes[i] = tick_node(state.children[i]);
    if (!driver_) continue;
    if (driver) {
      const auto called = [&](std::size_t at) { return states_[at].node->name + " (" + states_[at].node->path + ")"; };
      const std::string reason = called(*driver) + " and " + called(*driver_) + " drive at the same time";
      halt_children(state, 0, reason);
      driver_.reset();
      wanted_.reset();
      return {StepState::failure, reason};
    }
    driver = driver_;
    wanted = wanted_;
  }
  driver_ = driver;
  wanted_ = wanted;
  const std::optional<Status> status = decided(state);
  if (!status) return {};
  halt_children(state, 0, state.node->name + " is decided");
  return *status;
}

std::optional<Status> TreeRunner::decided(const State& state) const {
  std::size_t succeeded = 0;
  std::size_t failed = 0;
  std::string failures;
  for (std::size_t i = 0; i < state.children.size(); ++i) {
    const Status& outcome = state.outcomes[i];
    succeeded += outcome.state == StepState::success ? 1 : 0;
    if (outcome.state != StepState::failure) continue;
    ++failed;
    failures += (failures.empty() ? "" : "; ") + failure_of(state.children[i], outcome.reason);
  }
  const TreeNode& node = *state.node;
  if (failed >= node.fail_at || state.children.size() - failed < node.succeed_at)
    return Status{StepState::failure, failures};
  if (succeeded >= node.succeed_at)
    return Status{StepState::success,
                  std::to_string(succeeded) + " of " + std::to_string(state.children.size()) + " done"};
  return std::nullopt;
}

// The next round begins with the next tick, so that no tick is without end.
Status TreeRunner::tick_repeat(State& state) {
  const std::size_t child = state.children.front();
  Status status = tick_node(child);
  if (status.state == StepState::running) return status;
  const int times = state.node->times;
  ++state.rounds;
  if (status.state == StepState::failure)
    return {StepState::failure, failure_of(child, status.reason) + " (round " + rounds_text(state.rounds, times) + ")"};
  if (state.rounds == times) return {StepState::success, "did all " + std::to_string(times) + " rounds"};
  return {StepState::running, "did round " + rounds_text(state.rounds, times)};
}

Status TreeRunner::tick_retry(State& state) {
  const std::size_t child = state.children.front();
  Status status = tick_node(child);
  if (status.state != StepState::failure) return status;
  const int times = state.node->times;
  ++state.rounds;
  if (state.rounds == times)
    return {StepState::failure,
            failure_of(child, status.reason) + " (attempt " + rounds_text(state.rounds, times) + ")"};
  return {StepState::running, "attempt " + rounds_text(state.rounds, times) + " failed"};
}

Status TreeRunner::tick_timeout(State& state) {
  const std::size_t child = state.children.front();
  if (now_s_ - state.begun_s < state.node->after_s) return tick_node(child);
  const std::string reason =
      states_[child].node->name + " has not ended within " + config_detail::number_text(state.node->after_s) + " s";
  halt_children(state, 0, reason);
  return {StepState::failure, reason};
}

void TreeRunner::begin(std::size_t at) {
  State& state = states_[at];
  state.is_running = true;
  state.is_reported = state.is_forgiven = false;
  state.next = 0;
  state.rounds = 0;
  state.begun_s = now_s_;
  state.outcomes.clear();
  state.failures.clear();
  state.reported = {};
  if (state.report.runs++ == 0) state.report.begin_s = now_s_;
  if (state.node->kind == NodeKind::behaviour) report_start(at);
}

// Parents first.
void TreeRunner::report_start(std::size_t at) {
  State& state = states_[at];
  if (at == 0 || state.is_reported) return;
  report_start(state.parent);
  state.is_reported = true;
  host_.started(*state.node);
}

void TreeRunner::end(std::size_t at, const Status& status) {
  State& state = states_[at];
  NodeReport& report = state.report;
  const bool has_changed = state.is_reported || report.is_halted || report.status.state != status.state;
  state.is_running = false;
  report.status = status;
  report.is_halted = false;
  report.end_s = now_s_;
  state.done_s += now_s_ - state.begun_s;
  ++state.done;
  host_.ran(*state.node, report, state.begun_s);
  if (at == 0 || !has_changed) return;
  report_start(at);
  host_.ended(*state.node, report);
}

void TreeRunner::halt(double time_s, const std::string& reason) {
  now_s_ = time_s;
  halt_node(0, reason);
}

void TreeRunner::halt_children(const State& state, std::size_t from, const std::string& reason) {
  for (std::size_t i = state.children.size(); i > from; --i) halt_node(state.children[i - 1], reason);
}

// A leaf whose halt() throws has been halted; those that are left still run.
void TreeRunner::halt_node(std::size_t at, const std::string& reason) {
  State& state = states_[at];
  if (!state.is_running) return;
  halt_children(state, 0, reason);
  state.is_running = false;
  state.report.status = {StepState::failure, reason};
  state.report.is_halted = true;
  state.report.end_s = now_s_;
  if (driver_ == at) {
    driver_.reset();
    wanted_.reset();
  }
  host_.ran(*state.node, state.report, state.begun_s);
  if (state.node->kind == NodeKind::behaviour) host_.halt_leaf(*state.node);
  if (state.is_reported) host_.ended(*state.node, state.report);
}

void TreeRunner::begin_leaves_afresh() {
  driver_.reset();
  wanted_.reset();
  for (const State& state : states_)
    if (state.is_running && state.node->kind == NodeKind::behaviour) host_.halt_leaf(*state.node);
}

void TreeRunner::abandon(double time_s, const std::string& reason) {
  for (State& state : states_) {
    if (!state.is_running) continue;
    state.is_running = false;
    state.report.status = {StepState::failure, reason};
    state.report.is_halted = true;
    state.report.end_s = time_s;
    host_.ran(*state.node, state.report, state.begun_s);
  }
}

std::vector<NodeReport> TreeRunner::reports() const {
  std::vector<NodeReport> reports;
  for (const State& state : states_)
    if (state.report.ticks > 0) {
      reports.push_back(state.report);
      reports.back().is_running = state.is_running;
      if (state.is_running) reports.back().doing = state.reported.reason;
    }
  return reports;
}

}  // namespace cairn

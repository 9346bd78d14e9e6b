#include "framework/behaviour_tree/node_runs.hpp"

namespace cairn {
namespace {

constexpr double kAtOnce_s = 1e-9;
constexpr double kAgainWithin_s = 1.0;  // more than a tick

}  // namespace

std::string_view name_of(RunEnd end) {
  return end == RunEnd::halted ? "halted" : end == RunEnd::success ? "success" : "failure";
}

void NodeRuns::add(const TreeNode& node, const NodeReport& how, double begun_s) {
  const RunEnd end = how.is_halted                            ? RunEnd::halted
                     : how.status.state == StepState::success ? RunEnd::success
                                                              : RunEnd::failure;
  const bool at_once = how.end_s - begun_s < kAtOnce_s;
  const auto last = last_.find(node.path);
  if (at_once && last != last_.end()) {
    NodeRun& before = runs_[last->second];
    const bool was_at_once = before.runs > 1 || before.end_s - before.begin_s < kAtOnce_s;
    if (was_at_once && before.end == end && begun_s - before.end_s < kAgainWithin_s) {
      before.end_s = how.end_s;
      ++before.runs;
      return;
    }
  }
  if (runs_.size() >= kMaxNodeRuns) {
    ++left_out_;
    return;
  }
  last_[node.path] = runs_.size();
  runs_.push_back({node.path, begun_s, how.end_s, end});
}

}  // namespace cairn

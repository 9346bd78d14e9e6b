// Leaves that do what a test has written down, and everything that a tree asks of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/behaviour_tree/runner.hpp"

namespace cairn::testing_tree {

// The tree of YAML text: `- a`, `- fallback: [a, b]`. Leaves are behaviours with one-word names. Throws the first
// error.
inline std::vector<TreeNode> steps_of(const std::string& yaml) {
  MissionTree tree = read_mission_tree(parse_config_text(yaml, "tree.yaml"), "tree.yaml");
  if (!tree.errors.empty()) throw tree.errors.front();
  return std::move(tree.steps);
}

// A script: what the leaf answers in its first, second, ... tick; the last letter again and again. R running, S
// success, F failure; small letters drive. After an end it goes on in the script, after halt() too.
class ScriptedLeaves : public TreeHost {
 public:
  explicit ScriptedLeaves(std::map<std::string, std::string> scripts) : scripts_(std::move(scripts)) {}

  LeafTick tick_leaf(const TreeNode& leaf) override {
    log += (log.empty() || log.ends_with("| ") ? "" : " ") + leaf.name;
    const std::string& script = scripts_.at(leaf.name);
    const std::size_t at = std::min(ticks_[leaf.name]++, script.size() - 1);
    LeafTick tick;
    const char letter = script[at];
    if (letter >= 'a' && letter <= 'z') tick.wanted = Twist{static_cast<double>(leaf.name.front()), 0.0};
    tick.status.state = letter == 'R' || letter == 'r'   ? StepState::running
                        : letter == 'S' || letter == 's' ? StepState::success
                                                         : StepState::failure;
    tick.is_forgiven = letter == 'X';
    tick.status.reason = tick.status.state == StepState::failure ? "no " + leaf.name : "";
    return tick;
  }
  void halt_leaf(const TreeNode& leaf) override {
    log += (log.empty() || log.ends_with("| ") ? "!" : " !") + leaf.name;
    if (leaf.name == throws_in_halt) throw std::runtime_error("halt of " + leaf.name);
  }
  void started(const TreeNode& node) override { reported += "+" + node.path + " "; }
  void ended(const TreeNode& node, const NodeReport& how) override {
    reported += (how.is_halted ? "H" : how.status.state == StepState::success ? "S" : "F") + node.path + " ";
  }

  std::string log;       // leaves in the order in which they were ticked, !leaf halted
  std::string reported;  // +path started, Spath, Fpath and Hpath ended
  std::string throws_in_halt;

 private:
  std::map<std::string, std::string> scripts_;
  std::map<std::string, std::size_t> ticks_;
};

inline char letter_of(StepState state) {
  return state == StepState::running ? 'R' : state == StepState::success ? 'S' : 'F';
}

}  // namespace cairn::testing_tree

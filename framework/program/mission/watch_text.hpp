// What one who watches gets, as lines of JSON (docs/view.md, "The stream of a run").
#pragma once

#include <map>
#include <string>
#include <utility>

#include "framework/behaviour_tree/tree.hpp"
#include "framework/reporting/watching/watch_frame.hpp"

namespace cairn {

class WatchText {
 public:
  // The first line: the mission, its tree and its robot.
  [[nodiscard]] static std::string first_line(const std::string& mission, const std::vector<TreeNode>& steps,
                                              double robot_radius_m);

  // Of nodes, plan and bounds only what has changed since the frame before.
  [[nodiscard]] std::string line_of(const WatchFrame& frame);
  // Nothing has come for a while.
  [[nodiscard]] static std::string alive_line(const RunStatus& status);
  // The last line.
  [[nodiscard]] static std::string end_line(const RunStatus& status);

 private:
  using NodeState = std::pair<std::string, std::string>;  // and reason
  std::map<std::string, NodeState> nodes_;                // by path
  std::shared_ptr<const WatchPlan> plan_;
  CellBox bounds_;
};

}  // namespace cairn

// Every time that a node of the tree ran, for the report and the picture of the run.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "framework/behaviour_tree/runner.hpp"

namespace cairn {

enum class RunEnd : std::uint8_t { success, failure, halted };
[[nodiscard]] std::string_view name_of(RunEnd end);

struct NodeRun {
  std::string path{};
  double begin_s = 0.0;  // by the mission's clock
  double end_s = 0.0;
  RunEnd end = RunEnd::success;
  std::int64_t runs = 1;  // of a node that was asked again and again and answered the same at once: how often
};

inline constexpr std::size_t kMaxNodeRuns = 10000;

class NodeRuns {
 public:
  void add(const TreeNode& node, const NodeReport& how, double begun_s);
  [[nodiscard]] const std::vector<NodeRun>& runs() const { return runs_; }
  [[nodiscard]] std::int64_t left_out() const { return left_out_; }  // that came when there were too many

 private:
  std::vector<NodeRun> runs_;  // in the order in which they ended
  std::map<std::string, std::size_t> last_;
  std::int64_t left_out_ = 0;
};

}  // namespace cairn

#include "framework/behaviour_tree/tree.hpp"

namespace cairn {
namespace {

// How a node may end, for all that is known without running it.
struct Ends {
  bool success = true;
  bool failure = true;
};

class Reachability {
 public:
  std::vector<ConfigError> errors;

  Ends check_order(const std::vector<TreeNode>& nodes, bool Ends::*go_on, const char* never) {
    Ends ends{};
    ends.*go_on = true;
    bool Ends::*const leave = go_on == &Ends::success ? &Ends::failure : &Ends::success;
    ends.*leave = false;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!(ends.*go_on)) {
        errors.emplace_back(nodes[i].place,
                            in_quotes(nodes[i].name) + " is never reached: " + in_quotes(nodes[i - 1].name) +
                                " before it (line " + std::to_string(nodes[i - 1].place.line) + ") never " + never);
        break;
      }
      const Ends child = of(nodes[i]);
      ends.*go_on = child.*go_on;
      ends.*leave = ends.*leave || child.*leave;
    }
    return ends;
  }

 private:
  Ends of(const TreeNode& node) {
    switch (node.kind) {
      case NodeKind::sequence:
      case NodeKind::reactive_sequence:
      case NodeKind::mission:
        return check_order(node.children, &Ends::success, "succeeds");
      case NodeKind::fallback:
      case NodeKind::reactive_fallback:
        return check_order(node.children, &Ends::failure, "fails");
      case NodeKind::parallel:
        return of_parallel(node);
      case NodeKind::repeat: {
        const Ends child = of(node.children.front());
        return {child.success && node.times > 0, child.failure};
      }
      case NodeKind::retry: {
        const Ends child = of(node.children.front());
        return {child.success, child.failure && node.times > 0};
      }
      case NodeKind::timeout:
        return {of(node.children.front()).success, true};
      case NodeKind::inverse: {
        const Ends child = of(node.children.front());
        return {child.failure, child.success};
      }
      case NodeKind::force_success: {
        const Ends child = of(node.children.front());
        return {child.success || child.failure, false};
      }
      default:
        return {};
    }
  }

  Ends of_parallel(const TreeNode& node) {
    std::size_t may_succeed = 0;
    bool may_fail = node.children.size() > 1;  // when two of them drive
    for (const TreeNode& child : node.children) {
      const Ends ends = of(child);
      may_succeed += ends.success ? 1 : 0;
      may_fail = may_fail || ends.failure;
    }
    return {may_succeed >= node.succeed_at, may_fail};
  }
};

}  // namespace

std::vector<ConfigError> unreachable_nodes(const std::vector<TreeNode>& steps) {
  Reachability reachability;
  (void)reachability.check_order(steps, &Ends::success, "succeeds");
  return reachability.errors;
}

}  // namespace cairn

// Ticks a behaviour tree: which leaf is asked in which tick, which is halted, and what has come of each node.
//
// Knows no module: leaves are behind an interface. docs/missions.md says what each node does. Bounded work: one
// tick ticks each node at most once.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/behaviour_tree/state.hpp"
#include "framework/behaviour_tree/time_left.hpp"
#include "framework/behaviour_tree/tree.hpp"
#include "framework/contracts/behaviour.hpp"

namespace cairn {

struct LeafTick {
  Status status;
  std::optional<Twist> wanted{};  // the velocity that it ordered in this tick
  bool is_forgiven = false;       // its failure is published, but the nodes above go on as after a success
};

// A node that was ticked, over the whole run.
struct NodeReport {
  std::string path{};
  std::string kind{};  // as the file calls it: "retry", "goto"
  std::string name{};
  Status status{};         // how it ended the last time; running: it has not
  bool is_halted = false;  // the last time it was halted: a failure, with the reason why
  double begin_s = 0.0;    // first begun
  double end_s = 0.0;      // last ended
  std::int64_t ticks = 0;
  std::int64_t runs = 0;  // how often it was begun
  bool is_running = false;
  std::string doing{};  // of a running leaf: what it says that it is doing
};

// How long behaviours have taken in this run, by their kind.
class NodeTimes {
 public:
  void add(const std::string& kind, double took_s);
  [[nodiscard]] std::optional<double> mean_s(const std::string& kind) const;

 private:
  struct Sum {
    double took_s = 0.0;
    int count = 0;
  };
  std::map<std::string, Sum> sums_;
};

class TreeHost {
 public:
  virtual ~TreeHost() = default;
  virtual LeafTick tick_leaf(const TreeNode& leaf) = 0;
  // Of a behaviour that has not ended; once.
  virtual void halt_leaf(const TreeNode& leaf) = 0;
  // Never the root: whoever ticks knows. A node that begins and ends in one tick, as it did the last time, is not
  // published again: conditions below reactive nodes would be published in every tick.
  virtual void started(const TreeNode& node) = 0;
  virtual void ended(const TreeNode& node, const NodeReport& how) = 0;
  // Of every node, the root too, each time that it has ended or was halted.
  virtual void ran(const TreeNode& /*node*/, const NodeReport& /*how*/, double /*begun_s*/) {}
};

class TreeRunner {
 public:
  // Both must outlive it.
  TreeRunner(const TreeNode& root, TreeHost& host);

  // The root's status, as published: also a forgiven failure is a failure. A tick after its end begins afresh. What the
  // host throws passes; then only halt() or abandon() make sense.
  Status tick(double time_s);
  // Ordered in the last tick by a leaf that has not ended.
  [[nodiscard]] const std::optional<Twist>& wanted() const { return wanted_; }
  // Leaves under way get halt(), the last first.
  void halt(double time_s, const std::string& reason);
  // As halt(), but no leaf is called any more.
  void abandon(double time_s, const std::string& reason);

  // The leaves under way begin afresh with their next tick; the nodes above them stay where they are.
  void begin_leaves_afresh();

  [[nodiscard]] bool is_running() const { return states_.front().is_running; }
  // Of the nodes that were ticked, in the order of the file.
  [[nodiscard]] std::vector<NodeReport> reports() const;
  struct Doing {
    std::string path{};
    std::string name{};
    std::string reason{};  // what it says that it is doing
  };
  // The behaviour that was ticked last, unless it has ended.
  [[nodiscard]] std::optional<Doing> doing() const;

  // Between two ticks, or while a leaf is ticked. Leaves have no state here: gone on with, they begin afresh.
  [[nodiscard]] TreeState state() const;
  // Of a tree that has not begun: goes on from there with its next tick. Throws std::invalid_argument when the state
  // cannot be of this tree at that time.
  void restore(const TreeState& state, double time_s);

  [[nodiscard]] TimeLeft time_left(double time_s, const NodeTimes& times) const;

 private:
  struct State {
    const TreeNode* node = nullptr;
    std::size_t parent = 0;
    std::vector<std::size_t> children{};
    bool is_running = false;
    bool is_reported = false;  // that it has started
    bool is_forgiven = false;  // how it ended the last time
    std::size_t next = 0;      // of nodes with memory: the child to tick
    std::int64_t rounds = 0;   // of repeat and retry: that have ended
    double begun_s = 0.0;
    std::vector<Status> outcomes{};  // of parallel: of each child
    std::string failures{};          // of fallback: of the children so far
    NodeReport report{};
    Status reported{};    // of a leaf: in its last tick
    double done_s = 0.0;  // of all times that it has ended, not halted
    std::int64_t done = 0;
  };
  struct Reckoning {
    double time_s;
    const NodeTimes& times;
  };

  std::size_t add(const TreeNode& node, std::size_t parent);
  Status tick_node(std::size_t at);
  Status tick_kind(std::size_t at);
  Status tick_sequence(State& state);
  Status tick_fallback(State& state);
  Status tick_reactive(State& state, StepState go_on);
  Status tick_parallel(State& state);
  std::optional<Status> decided(const State& state) const;
  Status tick_repeat(State& state);
  Status tick_retry(State& state);
  Status tick_timeout(State& state);
  [[nodiscard]] TimeLeft left_of(std::size_t at, const Reckoning& reckoning) const;
  [[nodiscard]] TimeLeft whole_of(std::size_t at, const Reckoning& reckoning) const;
  [[nodiscard]] TimeLeft leaf_left(const State& state, const Reckoning& reckoning) const;
  [[nodiscard]] TimeLeft in_order_from_running(const State& state, const Reckoning& reckoning) const;
  [[nodiscard]] TimeLeft rounds_left(const State& state, const Reckoning& reckoning) const;
  void restore(State& state, const NodeState& saved, double time_s);
  void begin(std::size_t at);
  void end(std::size_t at, const Status& status);
  void report_start(std::size_t at);
  void halt_node(std::size_t at, const std::string& reason);
  void halt_children(const State& state, std::size_t from, const std::string& reason);
  [[nodiscard]] std::string failure_of(std::size_t at, const std::string& reason) const;

  std::vector<State> states_;  // in the order of the file; the root first
  TreeHost& host_;
  double now_s_ = 0.0;
  std::optional<std::size_t> driver_;  // the leaf that wanted_ is from
  std::optional<std::size_t> doing_;   // the behaviour that was ticked last
  std::optional<Twist> wanted_;
};

}  // namespace cairn

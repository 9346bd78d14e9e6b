// Random trees of scripted leaves against a small oracle that is written as the field draws such trees: an object a
// node, each with its own memory.

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <set>
#include <sstream>

#include "tests/framework/behaviour_tree/scripted_leaves.hpp"

namespace cairn {
namespace {

using testing_tree::letter_of;
using testing_tree::ScriptedLeaves;

using Random = std::mt19937_64;

int pick(Random& chance, int below) {
  return static_cast<int>(chance() % static_cast<std::uint64_t>(below));
}

class Oracle {
 public:
  virtual ~Oracle() = default;
  char tick(double time_s) {
    const char answer = step(time_s);
    busy = answer == 'R';
    if (!busy) forget();
    return answer;
  }
  void stop() {
    if (!busy) return;
    for (auto child = kids.rbegin(); child != kids.rend(); ++child) (*child)->stop();
    halted();
    busy = false;
    forget();
  }
  std::vector<std::unique_ptr<Oracle>> kids;

 protected:
  virtual char step(double time_s) = 0;
  virtual void forget() {}
  virtual void halted() {}
  bool busy = false;
};

class Leaf : public Oracle {
 public:
  Leaf(const TreeNode& node, ScriptedLeaves& leaves) : node_(node), leaves_(leaves) {}
  char step(double) override { return letter_of(leaves_.tick_leaf(node_).status.state); }
  void halted() override { leaves_.halt_leaf(node_); }

 private:
  const TreeNode& node_;
  ScriptedLeaves& leaves_;
};

// Sequence and fallback, with and without memory: they go on after one letter and leave with the other.
class InOrder : public Oracle {
 public:
  InOrder(char go_on, bool remembers) : go_on_(go_on), remembers_(remembers) {}
  char step(double time_s) override {
    for (std::size_t i = remembers_ ? at_ : 0; i < kids.size(); ++i) {
      const char answer = kids[i]->tick(time_s);
      at_ = i;
      if (answer == go_on_) continue;
      if (!remembers_)
        for (std::size_t later = kids.size() - 1; later > i; --later) kids[later]->stop();
      return answer;
    }
    return go_on_;
  }
  void forget() override { at_ = 0; }

 private:
  char go_on_;
  bool remembers_;
  std::size_t at_ = 0;
};

class Together : public Oracle {
 public:
  Together(std::size_t succeed_at, std::size_t fail_at) : succeed_at_(succeed_at), fail_at_(fail_at) {}
  char step(double time_s) override {
    answers_.resize(kids.size(), 'R');
    for (std::size_t i = 0; i < kids.size(); ++i)
      if (answers_[i] == 'R') answers_[i] = kids[i]->tick(time_s);
    const auto of = [&](char letter) {
      return static_cast<std::size_t>(std::count(answers_.begin(), answers_.end(), letter));
    };
    const char answer = of('F') >= fail_at_ || of('S') + of('R') < succeed_at_ ? 'F'
                        : of('S') >= succeed_at_                               ? 'S'
                                                                               : 'R';
    if (answer != 'R')
      for (auto child = kids.rbegin(); child != kids.rend(); ++child) (*child)->stop();
    return answer;
  }
  void forget() override { answers_.clear(); }

 private:
  std::size_t succeed_at_;
  std::size_t fail_at_;
  std::string answers_;
};

class Again : public Oracle {
 public:
  Again(char after, int times) : after_(after), times_(times) {}
  char step(double time_s) override {
    const char answer = kids.front()->tick(time_s);
    if (answer != after_) return answer;
    return ++done_ == times_ ? answer : 'R';
  }
  void forget() override { done_ = 0; }

 private:
  char after_;
  int times_;
  int done_ = 0;
};

class InTime : public Oracle {
 public:
  explicit InTime(double after_s) : after_s_(after_s) {}
  char step(double time_s) override {
    if (!since_s_) since_s_ = time_s;
    if (time_s - *since_s_ < after_s_) return kids.front()->tick(time_s);
    kids.front()->stop();
    return 'F';
  }
  void forget() override { since_s_.reset(); }

 private:
  double after_s_;
  std::optional<double> since_s_;
};

class Changed : public Oracle {
 public:
  Changed(char for_success, char for_failure) : success_(for_success), failure_(for_failure) {}
  char step(double time_s) override {
    const char answer = kids.front()->tick(time_s);
    return answer == 'R' ? 'R' : answer == 'S' ? success_ : failure_;
  }

 private:
  char success_;
  char failure_;
};

std::unique_ptr<Oracle> own_of(const TreeNode& node, ScriptedLeaves& leaves) {
  switch (node.kind) {
    case NodeKind::sequence:
      return std::make_unique<InOrder>('S', true);
    case NodeKind::reactive_sequence:
      return std::make_unique<InOrder>('S', false);
    case NodeKind::fallback:
      return std::make_unique<InOrder>('F', true);
    case NodeKind::reactive_fallback:
      return std::make_unique<InOrder>('F', false);
    case NodeKind::parallel:
      return std::make_unique<Together>(node.succeed_at, node.fail_at);
    case NodeKind::repeat:
      return std::make_unique<Again>('S', node.times);
    case NodeKind::retry:
      return std::make_unique<Again>('F', node.times);
    case NodeKind::timeout:
      return std::make_unique<InTime>(node.after_s);
    case NodeKind::inverse:
      return std::make_unique<Changed>('F', 'S');
    case NodeKind::force_success:
      return std::make_unique<Changed>('S', 'S');
    default:
      return std::make_unique<Leaf>(node, leaves);
  }
}

std::unique_ptr<Oracle> oracle_of(const TreeNode& node, ScriptedLeaves& leaves) {
  std::unique_ptr<Oracle> oracle = own_of(node, leaves);
  for (const TreeNode& child : node.children) oracle->kids.push_back(oracle_of(child, leaves));
  return oracle;
}

TreeNode random_tree(Random& chance, int depth, std::map<std::string, std::string>& scripts) {
  TreeNode node;
  if (depth == 0 || pick(chance, 4) == 0) {
    node.name = "l" + std::to_string(scripts.size());
    std::string& script = scripts[node.name];
    for (int i = 0; i < 12; ++i) script += "RRSF"[pick(chance, 4)];
    return node;
  }
  node.kind = static_cast<NodeKind>(pick(chance, static_cast<int>(NodeKind::mission)));
  node.name = name_of(node.kind);
  const int children = node.kind >= NodeKind::repeat ? 1 : 1 + pick(chance, 4);
  for (int i = 0; i < children; ++i) node.children.push_back(random_tree(chance, depth - 1, scripts));
  node.times = pick(chance, 4);
  node.after_s = 1 + pick(chance, 4);
  node.succeed_at = static_cast<std::size_t>(1 + pick(chance, children));
  node.fail_at = static_cast<std::size_t>(1 + pick(chance, children));
  return node;
}

TEST(RandomTrees, TickAndHaltTheirLeavesAsTheOracleDoes) {
  int ended = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Random chance(seed);
    std::map<std::string, std::string> scripts;
    const TreeNode root = random_tree(chance, 4, scripts);
    ScriptedLeaves of_runner(scripts);
    ScriptedLeaves of_oracle(scripts);
    TreeRunner runner(root, of_runner);
    const std::unique_ptr<Oracle> oracle = oracle_of(root, of_oracle);
    for (int tick = 0; tick < 40; ++tick) {
      const char answer = letter_of(runner.tick(tick).state);
      ended += answer == 'R' ? 0 : 1;
      ASSERT_EQ(answer, oracle->tick(tick)) << "seed " << seed << ", tick " << tick;
      if (pick(chance, 15) == 0) {
        runner.halt(tick, "test");
        oracle->stop();
      }
      ASSERT_EQ(of_runner.log, of_oracle.log) << "seed " << seed << ", tick " << tick;
    }
  }
  EXPECT_GT(ended, 10000) << "most trees must end now and then";
}

void number(TreeNode& node, const std::string& path) {
  node.path = path;
  for (std::size_t i = 0; i < node.children.size(); ++i) number(node.children[i], path + "/" + std::to_string(i + 1));
}

// Without halts of leaves that have not been ticked: what is gone on with has fresh leaves.
std::string without_halts_of_fresh_leaves(const std::string& log) {
  std::istringstream words(log);
  std::set<std::string> ticked;
  std::string left;
  for (std::string word; words >> word;) {
    if (word.front() == '!' && !ticked.contains(word.substr(1))) continue;
    ticked.insert(word);
    left += word + " ";
  }
  return left;
}

TEST(RandomTrees, GoOnFromTheirSavedStateAsTheUninterruptedTreeDoes) {
  int under_way = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Random chance(seed);
    std::map<std::string, std::string> scripts;
    TreeNode root = random_tree(chance, 4, scripts);
    number(root, "1");
    ScriptedLeaves leaves(scripts);
    TreeRunner runner(root, leaves);
    const int killed_at = 1 + pick(chance, 20);
    for (int tick = 0; tick < killed_at; ++tick) (void)runner.tick(tick);
    const TreeState saved = runner.state();
    ASSERT_EQ(tree_state_of(text_of(saved)), saved) << "seed " << seed;
    under_way += saved.running.size() > 1 ? 1 : 0;
    ScriptedLeaves fresh = leaves;
    leaves.log = fresh.log = "";
    TreeRunner restored(root, fresh);
    restored.restore(saved, killed_at - 1);
    for (int tick = killed_at; tick < killed_at + 20; ++tick) {
      ASSERT_EQ(letter_of(runner.tick(tick).state), letter_of(restored.tick(tick).state))
          << "seed " << seed << ", killed at " << killed_at << ", tick " << tick;
      ASSERT_EQ(without_halts_of_fresh_leaves(leaves.log), without_halts_of_fresh_leaves(fresh.log))
          << "seed " << seed << ", killed at " << killed_at << ", tick " << tick;
      ASSERT_EQ(runner.state(), restored.state()) << "seed " << seed << ", tick " << tick;
    }
  }
  EXPECT_GT(under_way, 500) << "many trees must be killed inside";
}

}  // namespace
}  // namespace cairn

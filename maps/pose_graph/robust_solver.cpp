#include "maps/pose_graph/robust_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maps/pose_graph/left_out_fits.hpp"

namespace cairn {
namespace {

constexpr double kFirstControl = 1e-6;
constexpr double kLastControl = 1e3;
constexpr double kControlGrowth = 1.4;
constexpr int kIterationsInRound = 2;
constexpr int kIterationsInTurn = 30;
constexpr int kMaxSettlings = 20;
constexpr double kWorstPart = 0.25;
constexpr std::size_t kFewestTaken = 10;
constexpr std::size_t kPartTaken = 3;  // of those that fit, one in so many in a turn
constexpr double kHopeless = 30.0;     // chi2 of so many limits: not asked again for some turns
constexpr int kRest = 3;
constexpr int kMaxDrops = 3;  // an edge that left so often stays out

using Weights = std::vector<double>;

Weights weights_of(const std::vector<bool>& is_believed) {
  return {is_believed.begin(), is_believed.end()};
}

double weight_of(double chi2, double limit, double control) {
  if (chi2 <= control / (control + 1.0) * limit) return 1.0;
  if (chi2 >= (control + 1.0) / control * limit) return 0.0;
  return std::sqrt(limit * control * (control + 1.0) / chi2) - control;
}

class RobustSolver {
 public:
  RobustSolver(const PoseGraph& graph, std::span<const PoseEdge> doubtful, const RobustSettings& settings,
               const std::function<bool()>& cancelled)
      : graph_(graph), doubtful_(doubtful), settings_(settings), cancelled_(cancelled) {}

  RobustSolution run() {
    const std::vector<Pose2> T_odom =
        solved(Weights(doubtful_.size(), 0.0), graph_.T_map_node, settings_.solver.max_iterations, true).T_map_node;
    return grown(settled(graduated(have_witnesses(doubtful_, graph_, T_odom, settings_.witnesses), T_odom)));
  }

 private:
  struct State {
    PoseGraphSolution solution;
    std::vector<bool> is_believed;
  };
  struct Turn {
    std::vector<std::size_t> leaving;  // the worst first
    std::vector<std::size_t> coming;   // the surest first
    double worst_chi2 = 0.0;
    bool has_asked_all = true;
  };

  [[nodiscard]] PoseGraphSolution solved(const Weights& weights, std::vector<Pose2> T_map_node, int iterations,
                                         bool linear_start);
  [[nodiscard]] std::vector<bool> fitting(const std::vector<Pose2>& T_map_node) const;
  [[nodiscard]] std::vector<Pose2> graduated(const std::vector<bool>& is_part, std::vector<Pose2> T_map_node);
  [[nodiscard]] State settled(std::vector<Pose2> T_map_node);
  [[nodiscard]] Turn turn_of(const State& state);
  [[nodiscard]] RobustSolution grown(State state);

  PoseGraph graph_;  // with the sensors' errors as last found
  std::span<const PoseEdge> doubtful_;
  const RobustSettings& settings_;
  const std::function<bool()>& cancelled_;
  std::vector<int> rest_;   // turns
  std::vector<int> drops_;  // how often an edge left
};

PoseGraphSolution RobustSolver::solved(const Weights& weights, std::vector<Pose2> T_map_node, int iterations,
                                       bool linear_start) {
  constexpr double kNone = 1e-9;
  PoseGraph whole{std::move(T_map_node), graph_.edges, graph_.headings, graph_.expected, graph_.errors};
  for (std::size_t i = 0; i < doubtful_.size(); ++i) {
    if (weights[i] <= kNone) continue;
    whole.edges.push_back(doubtful_[i]);
    whole.edges.back().information *= weights[i];
  }
  PoseGraphSettings settings = settings_.solver;
  settings.max_iterations = std::min(iterations, settings.max_iterations);
  settings.linear_start = linear_start;
  PoseGraphSolution solution = solve(whole, settings, cancelled_);
  graph_.errors = solution.errors;
  return solution;
}

std::vector<bool> RobustSolver::fitting(const std::vector<Pose2>& T_map_node) const {
  std::vector<bool> fits(doubtful_.size());
  for (std::size_t i = 0; i < fits.size(); ++i) fits[i] = chi2_of(doubtful_[i], T_map_node) <= settings_.chi2_limit;
  return fits;
}

std::vector<Pose2> RobustSolver::graduated(const std::vector<bool>& is_part, std::vector<Pose2> T_map_node) {
  T_map_node = solved(weights_of(is_part), std::move(T_map_node), settings_.solver.max_iterations, true).T_map_node;
  double worst = 0.0;
  for (std::size_t i = 0; i < doubtful_.size(); ++i)
    if (is_part[i]) worst = std::max(worst, chi2_of(doubtful_[i], T_map_node));
  const double limit = settings_.chi2_limit;
  if (worst <= limit) return T_map_node;
  double control = std::max(limit / (2.0 * worst - limit), kFirstControl);
  for (bool is_between = true; control < kLastControl && (is_between || control <= 1.0); control *= kControlGrowth) {
    Weights weights(doubtful_.size(), 0.0);
    is_between = false;
    for (std::size_t i = 0; i < doubtful_.size(); ++i) {
      if (!is_part[i]) continue;
      weights[i] = weight_of(chi2_of(doubtful_[i], T_map_node), limit, control);
      is_between = is_between || (weights[i] > 0.0 && weights[i] < 1.0);
    }
    T_map_node = solved(weights, std::move(T_map_node), kIterationsInRound, false).T_map_node;
  }
  return T_map_node;
}

RobustSolver::State RobustSolver::settled(std::vector<Pose2> T_map_node) {
  State state;
  state.is_believed = fitting(T_map_node);
  for (int i = 0; i < kMaxSettlings; ++i) {
    state.solution =
        solved(weights_of(state.is_believed), std::move(T_map_node), settings_.solver.max_iterations, false);
    T_map_node = state.solution.T_map_node;
    std::vector<bool> next = fitting(T_map_node);
    if (next == state.is_believed) break;
    if (i + 1 < kMaxSettlings) state.is_believed = std::move(next);
  }
  return state;
}

RobustSolver::Turn RobustSolver::turn_of(const State& state) {
  std::vector<bool> is_asked(doubtful_.size());
  for (std::size_t i = 0; i < is_asked.size(); ++i) is_asked[i] = rest_[i]-- <= 0;
  const std::vector<LeftOutFit> fits =
      left_out_fits(graph_, doubtful_, state.is_believed, is_asked, state.solution.T_map_node);
  const auto left_out = std::ranges::count(state.is_believed, false);
  const double by_chance = std::log(std::max(3.0, static_cast<double>(left_out)));
  Turn turn;
  turn.has_asked_all = std::ranges::find(is_asked, false) == is_asked.end();
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!is_asked[i]) continue;
    const bool fits_rest = fits[i].chi2 <= settings_.left_out_chi2_limit;
    if (state.is_believed[i] && !fits_rest) turn.leaving.push_back(i);
    if (state.is_believed[i]) continue;
    if (fits_rest && fits[i].log_odds >= by_chance && drops_[i] < kMaxDrops) turn.coming.push_back(i);
    if (fits[i].chi2 > kHopeless * settings_.left_out_chi2_limit) rest_[i] = kRest;
  }
  for (const std::size_t i : turn.leaving) turn.worst_chi2 = std::max(turn.worst_chi2, fits[i].chi2);
  std::erase_if(turn.leaving, [&](std::size_t i) { return fits[i].chi2 < kWorstPart * turn.worst_chi2; });
  std::ranges::stable_sort(turn.coming, std::greater{}, [&](std::size_t i) { return fits[i].log_odds; });
  turn.coming.resize(std::min(turn.coming.size(), std::max(kFewestTaken, turn.coming.size() / kPartTaken)));
  return turn;
}

RobustSolution RobustSolver::grown(State state) {
  rest_.assign(doubtful_.size(), 0);
  drops_.assign(doubtful_.size(), 0);
  bool is_settled = false;
  for (int i = 0; i < settings_.max_turns && !(cancelled_ && cancelled_()); ++i) {
    const Turn turn = turn_of(state);
    is_settled = turn.leaving.empty() && turn.coming.empty();
    if (is_settled && turn.has_asked_all) break;
    if (is_settled) {
      rest_.assign(doubtful_.size(), 0);
      continue;
    }
    for (const std::size_t edge : turn.leaving) {
      state.is_believed[edge] = false;
      ++drops_[edge];
    }
    if (turn.leaving.empty())
      for (const std::size_t edge : turn.coming) state.is_believed[edge] = true;
    state.solution =
        solved(weights_of(state.is_believed), std::move(state.solution.T_map_node), kIterationsInTurn, false);
  }
  state.solution = solved(weights_of(state.is_believed), std::move(state.solution.T_map_node),
                          settings_.solver.max_iterations, false);
  return {std::move(state.solution.T_map_node), std::move(state.is_believed), state.solution.chi2,
          is_settled && state.solution.converged, std::move(state.solution.errors)};
}

}  // namespace

DividedGraph odometry_and_closures(const PoseGraph& graph) {
  DividedGraph divided{{graph.T_map_node, {}, graph.headings, graph.expected, graph.errors}, {}};
  std::vector<bool> has_step(graph.T_map_node.size(), false);
  for (const PoseEdge& edge : graph.edges) {
    const bool is_step = edge.to == edge.from + 1 && !has_step[edge.from];
    if (is_step) has_step[edge.from] = true;
    (is_step ? divided.odometry.edges : divided.closures).push_back(edge);
  }
  return divided;
}

RobustSolution solve_robustly(const PoseGraph& graph, std::span<const PoseEdge> doubtful,
                              const RobustSettings& settings, const std::function<bool()>& cancelled) {
  return RobustSolver(graph, doubtful, settings, cancelled).run();
}

}  // namespace cairn

#include "maps/pose_graph/solver.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "maps/pose_graph/linear_start.hpp"
#include "maps/pose_graph/normal_equations.hpp"

namespace cairn {
namespace {

constexpr double kFirstDamping = 1e-6;
constexpr double kMaxDamping = 1e12;

void check(const PoseGraph& graph) {
  const auto refuse = [](const std::string& sentence) { throw std::invalid_argument("pose graph: " + sentence); };
  const std::size_t nodes = graph.T_map_node.size();
  if (nodes == 0) refuse("it has no node");
  for (std::size_t i = 0; i < nodes; ++i)
    if (!is_finite(graph.T_map_node[i])) refuse("node " + std::to_string(i) + " has no finite pose");
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const PoseEdge& edge = graph.edges[i];
    const std::string name = "edge " + std::to_string(i);
    if (edge.from >= nodes || edge.to >= nodes || edge.from == edge.to) refuse(name + " does not join two nodes");
    if (!is_finite(edge.T_from_to) || !edge.information.allFinite()) refuse(name + " is not finite");
    if ((edge.information.diagonal().array() < 0.0).any()) refuse(name + " has a negative information");
  }
  for (const HeadingPrior& prior : graph.headings)
    if (prior.node >= nodes || !std::isfinite(prior.heading_rad) || !(prior.information >= 0.0) ||
        (prior.is_biased() && prior.group >= graph.headings.size()))
      refuse("a heading of node " + std::to_string(prior.node) + " is none");
  if (!is_valid(graph.expected)) refuse("what is expected of its sensors' errors is no deviation");
}

std::vector<Pose2> moved(std::vector<Pose2> T_map_node, const Eigen::VectorXd& step) {
  for (std::size_t i = 0; i < T_map_node.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 * i);
    Pose2& pose = T_map_node[i];
    pose = {pose.x_m + step[row], pose.y_m + step[row + 1], wrap_angle(pose.theta_rad + step[row + 2])};
  }
  return T_map_node;
}

void move(SensorErrors& errors, const Eigen::VectorXd& step, const ErrorRows& rows) {
  if (rows.length >= 0) errors.length_ratio += step[rows.length];
  if (rows.turn >= 0) errors.turn_ratio += step[rows.turn];
  if (rows.compass >= 0) errors.compass_rad += step[rows.compass];
  if (rows.first_local < 0) return;
  for (std::size_t group = 0; group < errors.local_compass_rad.size(); ++group)
    errors.local_compass_rad[group] += step[rows.of_group(group)];
}

class Descent {
 public:
  Descent(const PoseGraph& graph, const PoseGraphSettings& settings, const std::function<bool()>& cancelled)
      : graph_(graph), settings_(settings), cancelled_(cancelled), equations_(graph) {}

  // From the solution's poses to the nearest minimum; is_convex: of the headings' loss.
  void run(PoseGraphSolution& solution, bool is_convex) {
    double damping = kFirstDamping;
    solution.chi2 = chi2_of(graph_, solution.T_map_node, solution.errors, is_convex);
    solution.converged = false;
    equations_.fill(solution.T_map_node, solution.errors, is_convex);
    for (int i = 0; i < settings_.max_iterations && !solution.converged && !is_cancelled(); ++i) {
      ++solution.iterations;
      const auto step = step_with(damping);
      const std::vector<Pose2> there = step ? moved(solution.T_map_node, *step) : std::vector<Pose2>{};
      SensorErrors errors = solution.errors;
      if (step) move(errors, *step, equations_.error_rows());
      const double chi2 = step ? chi2_of(graph_, there, errors, is_convex) : solution.chi2;
      if (step && chi2 <= solution.chi2) {
        solution.converged = solution.chi2 - chi2 <= settings_.relative_change * solution.chi2;
        solution.T_map_node = there;
        solution.errors = std::move(errors);
        solution.chi2 = chi2;
        damping = std::max(damping / 10.0, 1e-12);
        if (!solution.converged) equations_.fill(solution.T_map_node, solution.errors, is_convex);
      } else {
        damping *= 10.0;
        solution.converged = damping > kMaxDamping;  // no step goes down any more
      }
    }
  }
  [[nodiscard]] bool is_cancelled() const { return cancelled_ && cancelled_(); }

 private:
  std::optional<Eigen::VectorXd> step_with(double damping) {
    Eigen::SparseMatrix<double> damped = equations_.hessian();
    for (Eigen::Index i = 0; i < damped.rows(); ++i) {
      double& diagonal = damped.coeffRef(i, i);
      diagonal += damping * std::max(diagonal, 1e-9);
    }
    if (!is_analyzed_) solver_.analyzePattern(damped);
    is_analyzed_ = true;
    solver_.factorize(damped);
    if (solver_.info() != Eigen::Success) return std::nullopt;
    Eigen::VectorXd step = solver_.solve(-equations_.gradient());
    return step.allFinite() ? std::optional(std::move(step)) : std::nullopt;
  }

  const PoseGraph& graph_;
  const PoseGraphSettings& settings_;
  const std::function<bool()>& cancelled_;
  NormalEquations equations_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool is_analyzed_ = false;
};

void take_better_start(const PoseGraph& graph, PoseGraphSolution& solution) {
  auto start = linear_start(graph);
  if (!start) return;
  const double so_far = chi2_of(graph, solution.T_map_node, solution.errors);
  if (chi2_of(graph, *start, solution.errors) < so_far) solution.T_map_node = std::move(*start);
}

// Damping lets the tie of node 0 give way: all poses are put back with it, which changes no chi2. Graphs without
// headings and unknown errors are left as they are.
void put_back(const PoseGraph& graph, std::vector<Pose2>& T_map_node) {
  const bool has_headings = !graph.headings.empty();
  if (!has_headings && graph.expected.length_ratio <= 0.0 && graph.expected.turn_ratio <= 0.0) return;
  const Pose2 first = graph.T_map_node.front();
  const Pose2 moved = T_map_node.front();
  const Pose2 T_back = has_headings ? Pose2{first.x_m - moved.x_m, first.y_m - moved.y_m, 0.0} : first * inverse(moved);
  for (Pose2& pose : T_map_node) pose = T_back * pose;
}

}  // namespace

PoseGraphSolution solve(const PoseGraph& graph, const PoseGraphSettings& settings,
                        const std::function<bool()>& cancelled) {
  check(graph);
  PoseGraphSolution solution;
  solution.T_map_node = graph.T_map_node;
  solution.errors = graph.errors;
  solution.errors.local_compass_rad.resize(groups_of(graph));
  if (settings.linear_start) take_better_start(graph, solution);
  Descent descent(graph, settings, cancelled);
  // The bounded loss has minima of its own wherever a reading is beyond its limit: it begins where the convex one ends.
  if (std::ranges::any_of(graph.headings, [](const HeadingPrior& prior) { return prior.limit_sigmas > 0.0; }))
    descent.run(solution, true);
  descent.run(solution, false);
  put_back(graph, solution.T_map_node);
  return solution;
}

std::vector<double> deviations_of(const PoseGraph& graph, const PoseGraphSolution& solution) {
  NormalEquations equations(graph);
  equations.fill(solution.T_map_node, solution.errors);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(equations.hessian());
  if (solver.info() != Eigen::Success) return {};
  const Eigen::Index rows = equations.gradient().size();
  std::vector<double> deviations;
  for (auto row = static_cast<Eigen::Index>(3 * graph.T_map_node.size()); row < rows; ++row)
    deviations.push_back(std::sqrt(solver.solve(Eigen::VectorXd::Unit(rows, row))[row]));
  return deviations;
}

}  // namespace cairn

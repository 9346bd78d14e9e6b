#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/interrupt.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/output_file.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/pose_graphs/g2o.hpp"
#include "maps/exchange/pose_graphs/stamped_poses.hpp"
#include "maps/pose_graph/robust_solver.hpp"
#include "maps/pose_graph/solver.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const MeanError& error) {
  return {{"mean", error.mean}, {"deviation", error.deviation}, {"greatest", error.greatest}};
}

std::string text_of(const MeanError& error, const char* unit) {
  return fmt::format("{:.4f} +- {:.4f} {}, at most {:.4f}", error.mean, error.deviation, unit, error.greatest);
}

struct Solved {
  std::vector<Pose2> T_map_node;
  double chi2 = 0.0;  // of the edges that are believed
  bool converged = false;
  std::optional<int> iterations;
  std::vector<PoseEdge> left_out;
};

Solved solve_believing(const PoseGraph& graph) {
  const std::atomic<bool>& end = cancel_on_interrupt();
  PoseGraphSolution solution = solve(graph, {}, [&end] { return end.load(); });
  return {std::move(solution.T_map_node), solution.chi2, solution.converged, solution.iterations, {}};
}

Solved solve_in_doubt(const PoseGraph& graph) {
  const std::atomic<bool>& end = cancel_on_interrupt();
  const DividedGraph divided = odometry_and_closures(graph);
  RobustSolution solution = solve_robustly(divided.odometry, divided.closures, {}, [&end] { return end.load(); });
  Solved solved{std::move(solution.T_map_node), solution.chi2, solution.converged, std::nullopt, {}};
  for (std::size_t i = 0; i < divided.closures.size(); ++i)
    if (!solution.is_believed[i]) solved.left_out.push_back(divided.closures[i]);
  return solved;
}

}  // namespace

int slam_eval(const SlamEvalCommand& command, const CommonOptions& common) {
  const std::vector<StatedRelation> relations =
      parse_relations(exchange::text_of_file(command.relations), command.relations.string());
  const RelationErrors errors =
      relation_errors(relations, parse_stamped_poses(exchange::text_of_file(command.poses), command.poses.string()),
                      command.tolerance_s);
  if (errors.used == 0)
    throw std::runtime_error(command.poses.string() + ": no relation of " + command.relations.string() +
                             " has poses of both its stamps; --tolerance-s widens what counts as the same stamp");
  print({{"relations", relations.size()},
         {"used", errors.used},
         {"without_pose", errors.without_pose},
         {"translation_m", json_of(errors.translation_m)},
         {"rotation_deg", json_of(errors.rotation_deg)}},
        fmt::format("{} of {} relations have poses of both stamps\n  translation: {}\n  rotation:    {}\n", errors.used,
                    relations.size(), text_of(errors.translation_m, "m"), text_of(errors.rotation_deg, "deg")),
        common);
  return kExitDone;
}

int slam_solve(const SlamSolveCommand& command, const CommonOptions& common) {
  const G2oGraph read = parse_g2o(exchange::text_of_file(command.graph), command.graph.string());
  const Solved solved = command.robust ? solve_in_doubt(read.graph) : solve_believing(read.graph);
  if (!command.out.empty()) write_file(command.out, g2o_of(read, solved.T_map_node));
  const double before = chi2_of(read.graph, read.graph.T_map_node);
  ordered_json json = {{"nodes", read.ids.size()}, {"edges", read.graph.edges.size()}, {"chi2_before", before},
                       {"chi2", solved.chi2},      {"converged", solved.converged},    {"file", command.out.string()}};
  if (solved.iterations) json["iterations"] = *solved.iterations;
  ordered_json& left_out = json["left_out"] = ordered_json::array();
  for (const PoseEdge& edge : solved.left_out) left_out.push_back({read.ids[edge.from], read.ids[edge.to]});
  const std::string how = solved.iterations ? " in " + counted(*solved.iterations, "iteration")
                                            : ", " + counted(solved.left_out.size(), "edge") + " left out";
  print(json,
        fmt::format("{}, {}: chi2 {:g} -> {:.6f}{}{}\n", counted(read.ids.size(), "node"),
                    counted(read.graph.edges.size(), "edge"), before, solved.chi2, how,
                    solved.converged ? "" : ", not converged"),
        common);
  return solved.converged ? kExitDone : kExitNotSolved;
}

}  // namespace cairn

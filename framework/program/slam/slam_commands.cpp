#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/interrupt.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/output_file.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/pose_graphs/g2o.hpp"
#include "maps/exchange/pose_graphs/stamped_poses.hpp"
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
  const std::atomic<bool>& end = cancel_on_interrupt();
  const G2oGraph read = parse_g2o(exchange::text_of_file(command.graph), command.graph.string());
  const double before = chi2_of(read.graph, read.graph.T_map_node);
  const PoseGraphSolution solution = solve(read.graph, {}, [&end] { return end.load(); });
  if (!command.out.empty()) write_file(command.out, g2o_of(read, solution.T_map_node));
  print({{"nodes", read.ids.size()},
         {"edges", read.graph.edges.size()},
         {"chi2_before", before},
         {"chi2", solution.chi2},
         {"iterations", solution.iterations},
         {"converged", solution.converged},
         {"file", command.out.string()}},
        fmt::format("{}, {}: chi2 {:g} -> {:.6f} in {}{}\n", counted(read.ids.size(), "node"),
                    counted(read.graph.edges.size(), "edge"), before, solution.chi2,
                    counted(solution.iterations, "iteration"), solution.converged ? "" : ", not converged"),
        common);
  return solution.converged ? kExitDone : kExitNotSolved;
}

}  // namespace cairn

#include "framework/program/plan/plan_query.hpp"

#include <fmt/format.h>

namespace cairn {
namespace {

void report_search(std::string& out, const RouteExplanation& explanation) {
  out += fmt::format("  answered by {} on ", explanation.search);
  out += explanation.search_level == 0 ? "the landmark graph" : fmt::format("level {}", explanation.search_level);
  out += ": " + explanation.search_reason + "\n";
}

void report_explanation(std::string& out, const RouteExplanation& explanation, CostKind kind, const SavedMap& map,
                        const ClusterTree& clusters) {
  if (!explanation.search.empty()) report_search(out, explanation);
  const std::string cost = explanation.cost ? fmt::format("{:.2f} {}", *explanation.cost, unit_of(kind)) : "no route";
  out += fmt::format("  by {}: {}; settled", name_of(kind), cost);
  for (std::size_t level = 0; level < explanation.settled_of_level.size(); ++level) {
    const std::int64_t settled = explanation.settled_of_level[level];
    if (level == 0)
      out += fmt::format(" {} landmark{}", settled, settled == 1 ? "" : "s");
    else
      out += fmt::format(", {} at clusters of level {}", settled, level);
  }
  out += "\n";
  for (std::size_t level = explanation.clusters.size(); level-- > 0;) {
    out += fmt::format("  level {}:", level + 1);
    const char* between = " ";
    for (const ClusterId id : explanation.clusters[level]) {
      out += between + label_of(clusters.clusters.at(id), map.graph);
      between = ", ";
    }
    out += "\n";
  }
  if (!explanation.cost_with_closed_open) return;
  out += fmt::format("  with every closed route open it would be {:.2f} {}, over", *explanation.cost_with_closed_open,
                     unit_of(kind));
  for (const RouteId id : explanation.closed_on_cheaper_path) out += fmt::format(" R{}", id);
  out += "\n";
}

// What the path is made of, in its order.
void report_segments(std::string& out, const PlanResult& result, bool on_grid) {
  if (result.segments.empty()) return;
  const char* between = "  path:";
  double length_m = 0.0;
  for (const PathSegment& piece : result.segments) {
    out += fmt::format("{} {:.2f} m {}", between, piece.length_m, name_of(piece.origin));
    if (piece.route != 0) out += fmt::format(" (R{})", piece.route);
    length_m += piece.length_m;
    between = ",";
  }
  if (!on_grid)
    out += fmt::format("; {:.2f} m in all, which the costs of the routes put at {:.2f} m", length_m, result.cost_m);
  if (result.length_lower_bound_m)
    out += fmt::format("; no path{} can be shorter than {:.2f} m", result.margin_m > 0.0 ? " with this margin" : "",
                       *result.length_lower_bound_m);
  out += "\n";
}

}  // namespace

std::string text_of(const PlanQuery& query, const PlanResult& result, const SavedMap& map,
                    const ClusterTree& clusters) {
  std::string out = fmt::format("{} -> {}: {}", query.question.from, query.question.to, name_of(result.outcome));
  const bool on_grid = !map.grid.bounds().empty();
  if (result.outcome == PlanOutcome::solved && on_grid) {
    out +=
        fmt::format(", {:.2f} m, {:.2f} m between the robot and what is nearest", result.length_m, result.clearance_m);
    if (result.margin_m > 0.0) out += fmt::format(" (margin {:g} m)", result.margin_m);
    if (result.driving_time_s) out += fmt::format(", {:.1f} s of driving", *result.driving_time_s);
    out += fmt::format(", {:.1f} ms", result.time_ms.total_ms);
  } else if (result.outcome == PlanOutcome::solved) {
    out += fmt::format(", cost {:.2f} m, {:.3f} ms", result.cost_m, result.time_ms.total_ms);
  }
  const auto list = [&](const std::vector<LandmarkId>& landmarks) {
    for (const LandmarkId id : landmarks) out += fmt::format(" L{}", id);
  };
  if (!result.routes.empty()) {
    out += on_grid ? ", planned over" : ", by way of";  // corners that are cut may leave landmarks aside
    list(result.landmarks);
  } else if (!result.landmarks.empty()) {
    out += result.landmarks.size() == 1 ? ", one end at" : ", from and to";
    list(result.landmarks);
  }
  if (!result.reason.empty()) out += "\n  " + result.reason;
  out += "\n";
  for (const RouteAlternative& other : result.alternatives) {
    out += fmt::format("  or by routes of {:.2f} m in all:", other.cost_m);
    list(other.landmarks);
    out += "\n";
  }
  if (query.question.explain) report_segments(out, result, on_grid);
  if (result.explanation)
    report_explanation(out, *result.explanation, cost_kind_of(query.question.cost), map, clusters);
  return out;
}

}  // namespace cairn

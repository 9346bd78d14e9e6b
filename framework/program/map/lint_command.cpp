#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "framework/planning/saved_map/saved_radius.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/text.hpp"
#include "maps/edit/graph_lint.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const LintFinding& finding, const LandmarkGraph& graph) {
  ordered_json landmarks = ordered_json::array();
  for (const LandmarkId id : finding.landmarks)
    landmarks.push_back({{"id", "L" + std::to_string(id)}, {"name", graph.find(id)->name}});
  return {{"kind", finding.kind},         {"severity", name_of(finding.severity)},
          {"landmarks", landmarks},       {"routes", finding.routes},
          {"x_m", finding.at_m.x()},      {"y_m", finding.at_m.y()},
          {"sentence", finding.sentence}, {"advice", finding.advice}};
}

void print(const std::vector<LintFinding>& findings) {
  constexpr int kMaxOfAKind = 20;
  std::map<std::string, int> of_kind;
  for (const LintFinding& finding : findings) {
    if (++of_kind[finding.kind] > kMaxOfAKind) continue;
    std::cout << fmt::format("{:<7} {} at ({:.2f}, {:.2f}): {}\n        {}\n", name_of(finding.severity), finding.kind,
                             finding.at_m.x(), finding.at_m.y(), finding.sentence, finding.advice);
  }
  for (const auto& [kind, times] : of_kind)
    if (times > kMaxOfAKind)
      std::cout << fmt::format("... and {} more of the kind {}; --json lists all\n", times - kMaxOfAKind, kind);
}

}  // namespace

int map_lint(const LintCommand& command, const CommonOptions& common) {
  const SavedMap map = load_map(command.map);
  LintOptions options;
  options.radius_m = command.radius_m ? *command.radius_m : saved_radius_m(map, command.map);
  options.near_m = command.near_m;
  const std::vector<LintFinding> findings = lint_graph(map.graph, map.grid, options);
  const auto count = [&](LintSeverity severity) {
    return static_cast<std::size_t>(std::ranges::count(findings, severity, &LintFinding::severity));
  };
  const auto errors = count(LintSeverity::error);
  const auto warnings = count(LintSeverity::warning);
  const bool clean = errors + warnings == 0;
  if (common.json) {
    ordered_json list = ordered_json::array();
    for (const LintFinding& finding : findings) list.push_back(json_of(finding, map.graph));
    print_json({{"file", command.map.string()},
                {"outcome", clean ? "clean" : "findings"},
                {"radius_m", options.radius_m},
                {"near_m", options.near_m},
                {"findings", list}});
  } else {
    print(findings);
    std::cout << fmt::format("{}: {}; {}, {}, {}, for a robot of {:g} m radius\n", command.map.string(),
                             clean ? "clean" : "findings", counted(errors, "error"), counted(warnings, "warning"),
                             counted(count(LintSeverity::note), "note"), options.radius_m);
  }
  return clean ? kExitDone : kExitNotSolved;
}

}  // namespace cairn

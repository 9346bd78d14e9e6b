#include <fmt/format.h>

#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "framework/planning/clusters_config.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/text.hpp"
#include "maps/landmarks/route_count.hpp"
#include "maps/store/repair.hpp"
#include "maps/store/value_check.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

std::string text_of(const StoreLoss& loss) {
  std::string text = "table " + loss.table + ": " + loss.what;
  if (loss.box)
    text += fmt::format("; x {:.2f} to {:.2f} m, y {:.2f} to {:.2f} m are lost", loss.box->min_m.x(),
                        loss.box->max_m.x(), loss.box->min_m.y(), loss.box->max_m.y());
  return text;
}

ordered_json json_of(const std::vector<StoreLoss>& losses) {
  ordered_json list = ordered_json::array();
  for (const StoreLoss& loss : losses) {
    ordered_json item = {{"table", loss.table}, {"what", loss.what}};
    if (loss.box)
      item["box_m"] = {{loss.box->min_m.x(), loss.box->min_m.y()}, {loss.box->max_m.x(), loss.box->max_m.y()}};
    list.push_back(std::move(item));
  }
  return list;
}

ordered_json json_of_kept(const SavedMap& map) {
  return {{"landmarks", map.graph.landmarks().size()},
          {"routes", map.graph.routes().size()},
          {"explored_ratio", known_ratio(map.grid)}};
}

using Properties = std::map<std::string, std::string>;

// What load_map says against it; empty when it is sound. properties: of the map, when it loads.
std::string fault_of(const std::filesystem::path& file, Properties* properties = nullptr) {
  try {
    SavedMap map = load_map(file);
    if (properties != nullptr) *properties = std::move(map.properties);
  } catch (const StoreError& error) {
    return error.what();
  }
  return {};
}

// As they are read by whoever plans on the map.
void check_cluster_settings(const Properties& properties, std::vector<ValueFinding>& findings) {
  try {
    static_cast<void>(cluster_sizes_of(properties));
  } catch (const ConfigError& error) {
    findings.push_back({"meta", kClustersProperty, "value", "cannot be used: " + error.sentence()});
  }
}

struct MapVerdict {
  std::string fault;     // what load_map says against it; empty when it loads
  std::string unproven;  // tables of which an earlier repair has kept values that are not proven
  std::vector<StoreLoss> losses;
  std::vector<ValueFinding> findings;

  [[nodiscard]] bool is_sound() const { return fault.empty() && findings.empty(); }
  [[nodiscard]] const char* outcome() const {
    return !fault.empty() ? "damaged" : findings.empty() ? "sound" : "bad_values";
  }
};

ordered_json json_of(const std::vector<ValueFinding>& findings) {
  ordered_json list = ordered_json::array();
  for (const ValueFinding& finding : findings)
    list.push_back(
        {{"table", finding.table}, {"row", finding.row}, {"column", finding.column}, {"what", finding.what}});
  return list;
}

std::string text_of(const ValueFinding& finding) {
  return fmt::format("table {}: row {}: column {} {}", finding.table, finding.row, finding.column, finding.what);
}

ordered_json json_of(const MapVerdict& verdict, const std::filesystem::path& file) {
  ordered_json report = {{"file", file.string()}, {"outcome", verdict.outcome()}};
  if (!verdict.unproven.empty()) report["unproven_tables"] = verdict.unproven;
  if (!verdict.fault.empty()) {
    report["reason"] = verdict.fault;
    report["lost"] = json_of(verdict.losses);
  }
  if (!verdict.findings.empty()) report["bad_values"] = json_of(verdict.findings);
  return report;
}

void print_faults(const MapVerdict& verdict, const std::filesystem::path& file) {
  std::cerr << "cairn: "
            << (verdict.fault.empty() ? file.string() + ": holds values that cannot be true" : verdict.fault) << "\n";
  for (const StoreLoss& loss : verdict.losses) std::cerr << "  " << text_of(loss) << "\n";
  for (const ValueFinding& finding : verdict.findings) std::cerr << "  " << text_of(finding) << "\n";
  if (verdict.fault.empty()) return;
  const bool is_whole = verdict.losses.empty();
  std::cerr << "  " << (is_whole ? "nothing in it is lost: " : "") << "cairn map repair " << file.string()
            << " -o OUT saves " << (is_whole ? "it" : "the rest") << "\n";
}

}  // namespace

int map_check(const MapCommand& command, const CommonOptions& common) {
  MapVerdict verdict;
  Properties properties;
  verdict.fault = fault_of(command.map, &properties);
  if (const auto kept = properties.find(kUnprovenTables); kept != properties.end()) verdict.unproven = kept->second;
  try {
    if (!verdict.fault.empty()) verdict.losses = salvage_map(command.map).losses;
    verdict.findings = check_values(command.map);
    check_cluster_settings(properties, verdict.findings);
  } catch (const StoreError& error) {  // no saved map at all, or nothing left of one
    if (common.json)
      print_json({{"file", command.map.string()}, {"outcome", "not_readable"}, {"reason", error.what()}});
    throw;
  }
  if (common.json)
    print_json(json_of(verdict, command.map));
  else if (verdict.is_sound())
    std::cout << command.map.string() << ": sound"
              << (verdict.unproven.empty()
                      ? ""
                      : ", but a repair has kept values that are not proven, in: " + verdict.unproven)
              << "\n";
  if (verdict.is_sound()) return kExitDone;
  print_faults(verdict, command.map);
  return kExitBadInput;
}

int map_repair(const MapCommand& command, const CommonOptions& common) {
  std::error_code error;
  if (std::filesystem::equivalent(command.map, command.repaired, error))
    throw StoreError(command.repaired.string() + ": is the damaged map itself, which is never written to");
  const SalvagedMap salvaged = salvage_map(command.map);
  const bool is_sound = fault_of(command.map).empty();  // damage may have hit what holds nothing
  save_map(command.repaired, salvaged.map, Links::replace);
  std::vector<ValueFinding> findings = check_values(command.repaired);  // what loads may still be untrue
  check_cluster_settings(salvaged.map.properties, findings);
  std::ostream& people = common.json ? std::cerr : std::cout;
  for (const StoreLoss& loss : salvaged.losses) people << "  " << text_of(loss) << "\n";
  people << fmt::format("{}: {}; {}, {}, {:.1f} % known within its outermost walls\n", command.repaired.string(),
                        salvaged.losses.empty() ? "nothing was lost" : "saved without the above",
                        counted(salvaged.map.graph.landmarks().size(), "landmark"), counted_routes(salvaged.map.graph),
                        100.0 * known_ratio(salvaged.map.grid));
  if (common.json) {
    ordered_json report = {{"file", command.map.string()},
                           {"map", command.repaired.string()},
                           {"outcome", !findings.empty() ? "bad_values"
                                       : is_sound        ? "sound"
                                                         : "repaired"},
                           {"lost", json_of(salvaged.losses)},
                           {"kept", json_of_kept(salvaged.map)}};
    if (!findings.empty()) report["bad_values"] = json_of(findings);
    print_json(report);
  }
  if (findings.empty()) return kExitDone;
  std::cerr << "cairn: " << command.repaired.string() << ": still holds values that cannot be true\n";
  for (const ValueFinding& finding : findings) std::cerr << "  " << text_of(finding) << "\n";
  return kExitBadInput;
}

}  // namespace cairn

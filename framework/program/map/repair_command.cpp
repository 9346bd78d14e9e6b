#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "maps/store/repair.hpp"

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

// What load_map says against it; empty when it is sound. unproven: what an earlier repair has kept unproven.
std::string fault_of(const std::filesystem::path& file, std::string* unproven = nullptr) {
  try {
    const SavedMap map = load_map(file);
    const auto kept = map.properties.find(kUnprovenTables);
    if (unproven != nullptr && kept != map.properties.end()) *unproven = kept->second;
  } catch (const StoreError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

int map_check(const MapCommand& command, const CommonOptions& common) {
  std::string unproven;
  const std::string fault = fault_of(command.map, &unproven);
  std::vector<StoreLoss> losses;
  try {
    if (!fault.empty()) losses = salvage_map(command.map).losses;
  } catch (const StoreError& error) {  // no saved map at all, or nothing left of one
    if (common.json)
      print_json({{"file", command.map.string()}, {"outcome", "not_readable"}, {"reason", error.what()}});
    throw;
  }
  if (common.json) {
    ordered_json report = {{"file", command.map.string()}, {"outcome", fault.empty() ? "sound" : "damaged"}};
    if (!unproven.empty()) report["unproven_tables"] = unproven;
    if (!fault.empty()) {
      report["reason"] = fault;
      report["lost"] = json_of(losses);
    }
    print_json(report);
  } else if (fault.empty()) {
    std::cout << command.map.string() << ": sound"
              << (unproven.empty() ? "" : ", but a repair has kept values that are not proven, in: " + unproven)
              << "\n";
  }
  if (fault.empty()) return kExitDone;
  std::cerr << "cairn: " << fault << "\n";
  for (const StoreLoss& loss : losses) std::cerr << "  " << text_of(loss) << "\n";
  std::cerr << "  " << (losses.empty() ? "nothing in it is lost: " : "") << "cairn map repair " << command.map.string()
            << " -o OUT saves " << (losses.empty() ? "it" : "the rest") << "\n";
  return kExitBadInput;
}

int map_repair(const MapCommand& command, const CommonOptions& common) {
  std::error_code error;
  if (std::filesystem::equivalent(command.map, command.repaired, error))
    throw StoreError(command.repaired.string() + ": is the damaged map itself, which is never written to");
  const SalvagedMap salvaged = salvage_map(command.map);
  const bool is_sound = fault_of(command.map).empty();  // damage may have hit what holds nothing
  save_map(command.repaired, salvaged.map);
  std::ostream& people = common.json ? std::cerr : std::cout;
  for (const StoreLoss& loss : salvaged.losses) people << "  " << text_of(loss) << "\n";
  people << fmt::format(
      "{}: {}; {} landmarks, {} routes, {:.1f} % known within its outermost walls\n", command.repaired.string(),
      salvaged.losses.empty() ? "nothing was lost" : "saved without the above", salvaged.map.graph.landmarks().size(),
      salvaged.map.graph.routes().size(), 100.0 * known_ratio(salvaged.map.grid));
  if (common.json)
    print_json({{"file", command.map.string()},
                {"map", command.repaired.string()},
                {"outcome", is_sound ? "sound" : "repaired"},
                {"lost", json_of(salvaged.losses)},
                {"kept", json_of_kept(salvaged.map)}});
  return kExitDone;
}

}  // namespace cairn

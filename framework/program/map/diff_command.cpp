#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/common/refusal.hpp"
#include "framework/program/map/exchange_report.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/edit/difference.hpp"
#include "maps/pictures/difference_picture.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMaxDifferences = 30;
constexpr auto kFree = static_cast<std::size_t>(CellState::free);
constexpr auto kUnknown = static_cast<std::size_t>(CellState::unknown);
constexpr auto kOccupied = static_cast<std::size_t>(CellState::occupied);

ordered_json json_of(const LandmarkGraph& graph, LandmarkId id) {
  const Landmark& landmark = *graph.find(id);
  return {{"id", "L" + std::to_string(id)},
          {"name", landmark.name},
          {"category", landmark.category},
          {"x_m", landmark.T_map_landmark.x_m},
          {"y_m", landmark.T_map_landmark.y_m}};
}

ordered_json json_of(const std::vector<LandmarkPair>& pairs, const SavedMap& a, const SavedMap& b) {
  ordered_json list = ordered_json::array();
  for (const LandmarkPair& pair : pairs)
    list.push_back({{"a", json_of(a.graph, pair.a)}, {"b", json_of(b.graph, pair.b)}, {"distance_m", pair.distance_m}});
  return list;
}

ordered_json json_of(const std::vector<LandmarkId>& ids, const LandmarkGraph& graph) {
  ordered_json list = ordered_json::array();
  for (const LandmarkId id : ids) list.push_back(json_of(graph, id));
  return list;
}

ordered_json json_of(const MapDifference& difference, const SavedMap& a, const SavedMap& b) {
  const auto& cells = difference.cells;
  return {{"outcome", difference.is_same() ? "same" : "different"},
          {"cells",
           {{"other_state", difference.cells_of_other_state()},
            {"other_probability", difference.other_probability},
            {"free_to_occupied", cells[kFree][kOccupied]},
            {"free_to_unknown", cells[kFree][kUnknown]},
            {"occupied_to_free", cells[kOccupied][kFree]},
            {"occupied_to_unknown", cells[kOccupied][kUnknown]},
            {"unknown_to_free", cells[kUnknown][kFree]},
            {"unknown_to_occupied", cells[kUnknown][kOccupied]}}},
          {"landmarks",
           {{"same", difference.same.size()},
            {"moved", json_of(difference.moved, a, b)},
            {"renamed", json_of(difference.renamed, a, b)},
            {"only_in_a", json_of(difference.only_in_a, a.graph)},
            {"only_in_b", json_of(difference.only_in_b, b.graph)}}},
          {"routes",
           {{"same", difference.routes_same.size()},
            {"changed", difference.routes_changed},
            {"only_in_a", difference.routes_only_in_a},
            {"only_in_b", difference.routes_only_in_b}}}};
}

template <class Things, class Text>
void print_first(const Things& things, Text text_of) {
  for (std::size_t i = 0; i < std::min(things.size(), kMaxDifferences); ++i)
    std::cout << "    " << text_of(things[i]) << "\n";
  if (things.size() > kMaxDifferences)
    std::cout << "    ... and " << things.size() - kMaxDifferences << " more; --json lists all\n";
}

std::string place_of(const LandmarkGraph& graph, LandmarkId id) {
  const Landmark& landmark = *graph.find(id);
  return fmt::format("{} {} at ({:.2f}, {:.2f})", label_of(landmark), printable(landmark.category),
                     landmark.T_map_landmark.x_m, landmark.T_map_landmark.y_m);
}

void print(const MapDifference& difference, const SavedMap& a, const SavedMap& b) {
  const auto& cells = difference.cells;
  std::cout << fmt::format(
      "  cells: {} of another state ({} free -> occupied, {} occupied -> free, {} unknown -> free, {} unknown -> "
      "occupied, {} free -> unknown, {} occupied -> unknown), {} of the same state with another probability\n",
      difference.cells_of_other_state(), cells[kFree][kOccupied], cells[kOccupied][kFree], cells[kUnknown][kFree],
      cells[kUnknown][kOccupied], cells[kFree][kUnknown], cells[kOccupied][kUnknown], difference.other_probability);
  std::cout << fmt::format(
      "  landmarks: {} at the same place, {} moved, {} renamed, {} only in the first, {} only in "
      "the second\n",
      difference.same.size(), difference.moved.size(), difference.renamed.size(), difference.only_in_a.size(),
      difference.only_in_b.size());
  print_first(difference.moved, [&](const LandmarkPair& pair) {
    return fmt::format("moved by {:.3f} m: {} -> {}", pair.distance_m, place_of(a.graph, pair.a),
                       place_of(b.graph, pair.b));
  });
  print_first(difference.renamed, [&](const LandmarkPair& pair) {
    return "renamed: " + label_of(*a.graph.find(pair.a)) + " -> " + label_of(*b.graph.find(pair.b));
  });
  print_first(difference.only_in_a, [&](LandmarkId id) { return "only in the first: " + place_of(a.graph, id); });
  print_first(difference.only_in_b, [&](LandmarkId id) { return "only in the second: " + place_of(b.graph, id); });
  std::cout << fmt::format(
      "  routes: {} the same, {} of another cost or closed, {} only in the first, {} only in the "
      "second\n",
      difference.routes_same.size(), difference.routes_changed.size(), difference.routes_only_in_a.size(),
      difference.routes_only_in_b.size());
}

}  // namespace

int map_diff(const DiffCommand& command, const CommonOptions& common) {
  if (!command.picture.empty() && command.picture.extension() != ".png")
    fail_extension(command.picture, "drawn into", {".png"});
  const SavedMap a = load_map(command.a);
  const SavedMap b = load_map(command.b);
  const std::string both = command.a.string() + " and " + command.b.string();
  const MapDifference difference =
      refused_about("map diff: " + both, [&] { return difference_of(a, b, command.near_m); });
  if (!command.picture.empty())
    write_difference_picture(
        command.picture, {&a, &b, &difference, command.a.filename().string() + " -> " + command.b.filename().string()});
  if (common.json) {
    ordered_json json = json_of(difference, a, b);
    if (!command.picture.empty()) json["picture"] = command.picture.string();
    print_json(json);
  } else {
    std::cout << both << ": " << (difference.is_same() ? "the same grid, landmarks and routes" : "different") << "\n";
    if (!difference.is_same()) print(difference, a, b);
    if (!command.picture.empty()) std::cout << "wrote " << command.picture.string() << "\n";
  }
  return difference.is_same() ? kExitDone : kExitNotSolved;
}

}  // namespace cairn

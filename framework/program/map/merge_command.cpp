#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/common/refusal.hpp"
#include "framework/program/map/number_list.hpp"
#include "maps/base/fingerprint.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/edit/alignment.hpp"
#include "maps/edit/merge.hpp"

namespace cairn {
namespace {

constexpr const char* kSources = "merged_sources";  // property: hashes of the grids whose evidence a map holds

using Sources = std::set<std::string>;

// Of what the grid holds, whatever else of the map has been changed since; of a map without cells, of its file.
std::string evidence_hash(const std::filesystem::path& file, const SavedMap& map) {
  const CellBox box = map.grid.bounds();
  if (box.empty()) return fmt::format("{:016x}", hash_of_file(file).value_or(FileHash{}).hash);
  std::vector<LogOdds> cells;
  cells.reserve(static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height()));
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) cells.push_back(map.grid.log_odds({x, y}));
  return fmt::format("{:016x}", hash_of({reinterpret_cast<const char*>(cells.data()), cells.size() * sizeof(LogOdds)}));
}

// Its own evidence and that of the maps which were merged into it.
Sources sources_of(const std::filesystem::path& file, const SavedMap& map) {
  Sources sources{evidence_hash(file, map)};
  const auto known = map.properties.find(kSources);
  std::istringstream words(known == map.properties.end() ? "" : known->second);
  for (std::string word; words >> word;) sources.insert(word);
  return sources;
}

bool is_within(const Sources& some, const Sources& all) {
  return std::ranges::includes(all, some);
}

bool have_common(const Sources& one, const Sources& other) {
  return std::ranges::any_of(one, [&](const std::string& hash) { return other.contains(hash); });
}

struct Laid {
  Pose2 T_a_b;
  std::optional<MapAlignment> found{};
  std::string words;  // "x,y,deg"
};

std::optional<Laid> laid_by(const MergeCommand& command, const SavedMap& a, const SavedMap& b, std::string& reason) {
  if (command.transform) {
    const std::vector<double> given =
        number_list(*command.transform, "x,y,deg", "map merge: --transform", kMaxCoordinate);
    return Laid{{given[0], given[1], wrap_angle(radians(given[2]))}, {}, *command.transform};
  }
  AlignmentRules rules;
  rules.near_m = std::max(command.near_m, 0.05);
  const AlignmentResult result = align_maps(a, b, rules);
  reason = result.reason;
  if (!result.alignment) return std::nullopt;
  const Pose2& T = result.alignment->T_a_b;
  return Laid{T, result.alignment, fmt::format("{:.3f},{:.3f},{:.2f}", T.x_m, T.y_m, degrees(T.theta_rad))};
}

nlohmann::ordered_json found_json(const Laid& laid) {
  nlohmann::ordered_json json{{"x_m", laid.T_a_b.x_m}, {"y_m", laid.T_a_b.y_m}, {"deg", degrees(laid.T_a_b.theta_rad)}};
  if (laid.found)
    json.update({{"wall_ratio", laid.found->wall_ratio},
                 {"contradicted_ratio", laid.found->contradicted_ratio},
                 {"shared_m2", laid.found->shared_m2},
                 {"landmarks", laid.found->landmarks}});
  return json;
}

int report_merged(const MergeCommand& command, const MergedMap& merged, const std::string& what,
                  const nlohmann::ordered_json& transform, const CommonOptions& common) {
  const std::size_t landmarks = merged.map.graph.landmarks().size();
  const std::size_t routes = merged.map.graph.routes().size();
  const CellBox box = merged.map.grid.bounds();
  print_report({{"map", command.out.string()},
                {"size_cells", {box.width(), box.height()}},
                {"landmarks", landmarks},
                {"routes", routes},
                {"joined_landmarks", merged.joined_landmarks},
                {"joined_routes", merged.joined_routes},
                {"transform", transform},
                {"warnings", merged.warnings}},
               fmt::format("wrote {}: {} x {} cells, {}, {}; {}", command.out.string(), box.width(), box.height(),
                           counted(landmarks, "landmark"), counted(routes, "route"), what),
               merged.warnings, common);
  return kExitDone;
}

}  // namespace

int map_merge(const MergeCommand& command, const CommonOptions& common) {
  const std::string both = "map merge: " + command.a.string() + " and " + command.b.string();
  std::error_code error;
  if (std::filesystem::equivalent(command.a, command.b, error))
    throw std::runtime_error(both + " are the same file, whose evidence would count twice");
  const SavedMap a = load_map(command.a);
  const SavedMap b = load_map(command.b);
  Sources sources = sources_of(command.a, a);
  const Sources of_b = sources_of(command.b, b);
  if (is_within(of_b, sources)) {
    save_map(command.out, a, Links::replace);
    return report_merged(command, {a, 0, 0, {}}, "the first holds the second already, and nothing counts twice",
                         nullptr, common);
  }
  if (have_common(sources, of_b))
    throw std::runtime_error(both + " both hold the evidence of one map, which would count twice");
  std::string reason;
  const std::optional<Laid> laid = laid_by(command, a, b, reason);
  if (!laid) {
    if (common.json) std::cout << nlohmann::ordered_json{{"map", nullptr}, {"reason", reason}} << "\n";
    std::cerr << both << " do not show where one lies in the other: " << reason << ". Give --transform x,y,deg\n";
    return kExitNotSolved;
  }
  // Cells of different size, or far too many.
  MergedMap merged = refused_about<std::logic_error>(both, [&] {
    return merge_maps(a, b, {laid->T_a_b, command.near_m});
  });
  std::string& history = merged.map.properties["merged_from"];
  history += (history.empty() ? "" : "; ") + command.b.filename().string() + " at " + laid->words;
  sources.merge(Sources(of_b));
  merged.map.properties[kSources] = fmt::format("{}", fmt::join(sources, " "));
  save_map(command.out, merged.map, Links::replace);
  return report_merged(
      command, merged,
      fmt::format("{} and {} of the second map are also in the first; it lies at {}",
                  counted(merged.joined_landmarks, "landmark"), counted(merged.joined_routes, "route"), laid->words),
      found_json(*laid), common);
}

}  // namespace cairn

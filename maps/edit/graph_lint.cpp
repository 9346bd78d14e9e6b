#include "maps/edit/graph_lint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <unordered_map>

#include "maps/edit/place_lint.hpp"
#include "maps/edit/route_lint.hpp"
#include "maps/geometry/near_groups.hpp"
#include "maps/landmarks/graph_parts.hpp"

namespace cairn {
namespace {

constexpr double kSamePlace_m = 1e-3;

std::string labels_of(const LandmarkGraph& graph, const std::vector<LandmarkId>& ids) {
  constexpr std::size_t kMaxNamed = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(ids.size(), kMaxNamed); ++i)
    text += (i == 0 ? "" : ", ") + full_label(*graph.find(ids[i]));
  if (ids.size() > kMaxNamed) text += fmt::format(" and {} more", ids.size() - kMaxNamed);
  return text;
}

LintFinding about(const LandmarkGraph& graph, std::string kind, LintSeverity severity, std::vector<LandmarkId> ids,
                  const std::string& sentence, std::string advice) {
  const Point at_m = graph.find(ids.front())->T_map_landmark.position();
  return {std::move(kind), severity, std::move(ids), {}, at_m, sentence, std::move(advice)};
}

// Which of the sets that the grid joins have a share in these landmarks.
std::set<LandmarkId> sets_of(const std::vector<LandmarkId>& landmarks, PlaceLint& places) {
  std::set<LandmarkId> sets;
  for (const LandmarkId id : landmarks) sets.insert(places.on_grid.set_of(id));
  return sets;
}

// Why no route could lead from the main part to these landmarks, as the end of a sentence; empty where one could.
std::string obstacle_to(const LandmarkGraph& graph, const GraphPart& part, const std::set<LandmarkId>& main_sets,
                        PlaceLint& places) {
  const LandmarkId first = part.landmarks.front();
  if (const auto why = places.no_places.find(first); part.landmarks.size() == 1 && why != places.no_places.end())
    return "; it has no approach pose: " + why->second;
  for (const LandmarkId id : part.landmarks)
    if (graph.find(id)->level != 0 || main_sets.contains(places.on_grid.set_of(id))) return "";
  return "; the grid has no way there either";
}

LintFinding about_part(const LandmarkGraph& graph, const GraphPart& part, const GraphParts& parts,
                       const std::string& obstacle) {
  const std::string labels = labels_of(graph, part.landmarks);
  const std::string main =
      fmt::format("the main part of the graph ({} of {} landmarks)", parts.main.size(), graph.landmarks().size());
  if (part.reach == Reach::trap)
    return about(graph, "trap", LintSeverity::error, part.landmarks,
                 fmt::format("{}: open routes lead there from {}, but none back", labels, main),
                 "add a route back, or close the routes that lead there");
  if (part.reach == Reach::no_way_in)
    return about(graph, "no_way_in", LintSeverity::warning, part.landmarks,
                 fmt::format("{}: open routes lead from there to {}, but none there", labels, main),
                 "add a route that leads there");
  if (part.reach == Reach::cut_off)
    return about(graph, "cut_off", LintSeverity::warning, part.landmarks,
                 fmt::format("{}: open routes lead neither there from {} nor back{}", labels, main, obstacle),
                 "add routes both ways, or open closed ones again");
  return about(graph, "isolated", LintSeverity::warning, part.landmarks,
               fmt::format("{}: no open route leads there or away{}", labels, obstacle),
               "add routes to it, or open closed ones again");
}

std::vector<LintFinding> lint_parts(const LandmarkGraph& graph, const OccupancyGrid& grid, const LintOptions& options) {
  PlaceLint places = lint_places(graph, grid, options);
  std::vector<LintFinding> findings = places.missing_routes;
  if (graph.routes().empty()) std::ranges::move(lint_no_places(graph, places), std::back_inserter(findings));
  if (graph.landmarks().size() < 2) return findings;
  if (graph.routes().empty()) {
    std::vector<LandmarkId> ids;
    for (const auto& [id, landmark] : graph.landmarks()) ids.push_back(id);
    findings.push_back(about(graph, "no_routes", LintSeverity::note, std::move(ids),
                             fmt::format("none of the {} landmarks has a route", graph.landmarks().size()),
                             "plans lead over the grid alone; add routes to plan on the graph"));
    return findings;
  }
  const GraphParts parts = parts_of(graph);
  const std::set<LandmarkId> main_sets = sets_of(parts.main, places);
  for (const GraphPart& part : parts.others) {
    const std::string obstacle = grid.bounds().empty() ? "" : obstacle_to(graph, part, main_sets, places);
    findings.push_back(about_part(graph, part, parts, obstacle));
  }
  return findings;
}

// Numbers for things that are equal.
class Sorts {
 public:
  std::size_t of(const std::string& key) { return numbers_.emplace(key, numbers_.size()).first->second; }

 private:
  std::unordered_map<std::string, std::size_t> numbers_;
};

std::vector<std::vector<LandmarkId>> groups_of(const std::vector<const Landmark*>& landmarks, double within_m,
                                               bool by_category) {
  Sorts sorts;
  std::vector<ThingAt> things;
  things.reserve(landmarks.size());
  for (const Landmark* landmark : landmarks)
    things.push_back({landmark->T_map_landmark.position(),
                      sorts.of(fmt::format("{} {}", landmark->level, by_category ? landmark->category : ""))});
  std::vector<std::vector<LandmarkId>> groups;
  for (const std::vector<std::size_t>& indices : near_groups(things, within_m)) {
    groups.emplace_back();
    for (const std::size_t i : indices) groups.back().push_back(landmarks[i]->id);
  }
  return groups;
}

std::vector<LintFinding> lint_duplicates(const LandmarkGraph& graph, double near_m) {
  std::vector<LintFinding> findings;
  std::vector<const Landmark*> all;
  std::vector<const Landmark*> recognised;
  for (const auto& [id, landmark] : graph.landmarks()) {
    all.push_back(&landmark);
    if (!landmark.category.empty()) recognised.push_back(&landmark);
  }
  const std::vector<std::vector<LandmarkId>> same = groups_of(all, kSamePlace_m, false);
  std::unordered_map<LandmarkId, const std::vector<LandmarkId>*> same_as;
  for (const std::vector<LandmarkId>& ids : same) {
    findings.push_back(about(graph, "same_place", LintSeverity::warning, ids,
                             labels_of(graph, ids) + " stand at the same place", "keep one of them"));
    for (const LandmarkId id : ids) same_as[id] = &ids;
  }
  if (near_m <= 0.0) return findings;
  for (const std::vector<LandmarkId>& ids : groups_of(recognised, near_m, true)) {
    const auto place = same_as.find(ids.front());
    if (place != same_as.end() && std::ranges::includes(*place->second, ids)) continue;  // is said already
    findings.push_back(about(graph, "near_duplicate", LintSeverity::warning, ids,
                             fmt::format("{} are of category {}, each within {:g} m of another", labels_of(graph, ids),
                                         graph.find(ids.front())->category, near_m),
                             "keep one of them, unless there are that many"));
  }
  return findings;
}

// What a command takes for something else than a name; empty when it is a plain name.
std::string misreading_of(const Landmark& landmark) {
  const std::string& name = landmark.name;
  if (name.size() > 1 && name.front() == 'L' && name.find_first_not_of("0123456789", 1) == std::string::npos)
    return name == fmt::format("L{}", landmark.id) ? "" : "the id of a landmark";
  if (name.starts_with("nearest ")) return "a search for a category";
  if (!name.empty() && name.find_first_not_of("0123456789+-.,eE \t") == std::string::npos &&
      name.find_first_of("0123456789") != std::string::npos)
    return "coordinates";
  return "";
}

std::vector<LintFinding> lint_names(const LandmarkGraph& graph) {
  std::vector<LintFinding> findings;
  std::map<std::string, std::vector<LandmarkId>> bearers;
  for (const auto& [id, landmark] : graph.landmarks()) {
    if (landmark.name.empty()) continue;
    bearers[landmark.name].push_back(id);
    if (const std::string misreading = misreading_of(landmark); !misreading.empty())
      findings.push_back(about(graph, "misread_name", LintSeverity::warning, {id},
                               fmt::format("L{} is named \"{}\", which reads as {}", id, landmark.name, misreading),
                               "give it another name"));
  }
  for (const auto& [name, ids] : bearers)
    if (ids.size() > 1)
      findings.push_back(about(
          graph, "name_taken_twice", LintSeverity::warning, ids,
          fmt::format("{} are all named \"{}\", which stands for L{} alone", labels_of(graph, ids), name, ids.front()),
          "give the others names of their own"));
  return findings;
}

}  // namespace

std::string_view name_of(LintSeverity severity) {
  constexpr std::string_view kNames[] = {"note", "warning", "error"};
  return kNames[static_cast<int>(severity)];
}

std::vector<LintFinding> lint_graph(const LandmarkGraph& graph, const OccupancyGrid& grid, const LintOptions& options) {
  std::vector<LintFinding> findings = lint_parts(graph, grid, options);
  std::ranges::move(lint_duplicates(graph, options.near_m), std::back_inserter(findings));
  std::ranges::move(lint_routes(graph, grid, options), std::back_inserter(findings));
  std::ranges::move(lint_names(graph), std::back_inserter(findings));
  std::ranges::stable_sort(findings, [](const LintFinding& a, const LintFinding& b) {
    return a.severity != b.severity ? a.severity > b.severity : a.kind < b.kind;
  });
  return findings;
}

}  // namespace cairn

#include "framework/planning/place.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "framework/config/config_value.hpp"
#include "framework/config/coordinates.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

constexpr std::string_view kNearest = "nearest ";
constexpr std::string_view kWhatAPlaceIs =
    "a place is x,y or x,y,angle_deg, a landmark's or cluster's id or name, `tag NUMBER`, or `nearest CATEGORY`";

[[noreturn]] void refuse(const std::string& place, const std::string& why) {
  throw MalformedPlace("place \"" + place + "\" " + why + "; " + std::string(kWhatAPlaceIs));
}

// "1,", "1,a", "1;2", "1 2": meant as x,y, and no name.
bool begins_with_a_coordinate(std::string_view text) {
  if (text.starts_with('[')) text.remove_prefix(1);
  const std::size_t end = text.find_first_of(",; \t");
  if (end == std::string::npos || !number_from<double>(text.substr(0, end))) return false;
  const bool has_letters = std::ranges::any_of(text, [](unsigned char c) { return std::isalpha(c) != 0 || c > 127; });
  return text[end] == ',' || !has_letters;
}

Place place_of(const std::vector<double>& values, const std::string& text) {
  if (values.size() > 3) refuse(text, "has " + std::to_string(values.size()) + " numbers");
  for (const double value : values)
    if (!std::isfinite(value)) refuse(text, "has a number that is not finite");
  Place place;
  const bool heading = values.size() == 3;
  place.pose = Pose2{values[0], values[1], heading ? wrap_angle(radians(values[2])) : 0.0};
  place.heading_matters = heading;
  return place;
}

Place nearest_place(const std::string& category, const LandmarkGraph& graph) {
  Place place;
  place.landmarks = graph.of_category(category);
  if (!place.landmarks.empty()) return place;
  std::set<std::string> known;
  for (const auto& [id, landmark] : graph.landmarks())
    if (!landmark.category.empty()) known.insert(landmark.category);
  throw PlaceError("no landmark of category \"" + category + "\"" +
                   did_you_mean(category, {known.begin(), known.end()}) +
                   "; the map holds: " + (known.empty() ? "none" : joined(known)));
}

}  // namespace

bool reads_as_place(const std::string& text) {
  const auto values = coordinates_in(text);
  return trimmed(text).starts_with(kNearest) || (values && values->size() > 1);
}

Place parse_place(const std::string& text, const LandmarkGraph& graph, const ClusterTree& clusters) {
  const std::string place_text(trimmed(text));
  if (place_text.starts_with(kNearest))
    return nearest_place(std::string(trimmed(std::string_view(place_text).substr(kNearest.size()))), graph);
  if (reads_as_place(place_text)) return place_of(*coordinates_in(place_text), place_text);
  if (const Landmark* landmark = graph.find_by_name(place_text)) {
    Place place;
    place.landmarks = {landmark->id};
    return place;
  }
  if (place_text.empty()) refuse(place_text, "is empty");
  if (const Cluster* const cluster = find_cluster(clusters, graph, place_text))
    return {std::nullopt, false, members_of(clusters, cluster->id)};
  // A bare category is its nearest landmark, unless a landmark is called so.
  if (Place place{std::nullopt, false, graph.of_category(place_text)}; !place.landmarks.empty()) return place;
  if (place_text + " " == kNearest) refuse(place_text, "names no category");
  if (coordinates_in(place_text))
    refuse(place_text, "is one number" + std::string(graph.find_by_name("L" + place_text) == nullptr
                                                         ? ""
                                                         : " (did you mean \"L" + place_text + "\"?)"));
  if (begins_with_a_coordinate(place_text)) refuse(place_text, "is not made of numbers alone");
  std::vector<std::string> names;
  for (const auto& [id, landmark] : graph.landmarks()) {
    names.push_back(label_of(landmark));
    if (!landmark.category.empty()) names.push_back(landmark.category);
  }
  for (const auto& [id, cluster] : clusters.clusters) names.push_back(label_of(cluster, graph));
  throw PlaceError("unknown place \"" + place_text + "\"" + did_you_mean(place_text, names) + "; " +
                   std::string(kWhatAPlaceIs));
}

RouteId parse_route(const std::string& text, const LandmarkGraph& graph) {
  const auto id = number_from<RouteId>(std::string_view(text).substr(text.starts_with('R') ? 1 : 0));
  if (!id) throw MalformedPlace("route \"" + text + "\": a route is named by its number, as 12 or R12");
  if (graph.find_route(*id) == nullptr) throw PlaceError("the map has no route " + std::to_string(*id));
  return *id;
}

}  // namespace cairn

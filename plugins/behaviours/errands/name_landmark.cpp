#include "plugins/behaviours/errands/name_landmark.hpp"

#include <algorithm>
#include <cstdio>

namespace cairn::behaviours {
namespace {

double distance_m(const Landmark& landmark, const Point& p_map) {
  return (landmark.T_map_landmark.position() - p_map).norm();
}

std::vector<LandmarkId> all_of(const LandmarkGraph& graph) {
  std::vector<LandmarkId> ids;
  for (const auto& [id, landmark] : graph.landmarks()) ids.push_back(id);
  return ids;
}

// "L2 (circle) is 2.31 m away".
std::string too_far(const Landmark& landmark, const Point& p_map) {
  char text[64];
  std::snprintf(text, sizeof text, " is %.2f m away", distance_m(landmark, p_map));
  return described(landmark) + text;
}

}  // namespace

void NameConfig::describe(Fields<NameConfig>& fields) {
  using C = NameConfig;
  fields.raw("as", &C::as, "text", "the name; no id, no coordinates, not `nearest ...`, and no other landmark's")
      .required = true;
  fields.raw("landmark", &C::landmark, "place",
             "which one: an id (L3), a name, a category or `nearest CATEGORY`, or a cluster by its id (C1:L3) or name; "
             "this or input; without both, the one found last");
  fields.input("input", &C::input,
               "which one: of those that an earlier step gives by `output` under this name, the one found last");
  fields.point("near_m", &C::near_m, "m", "of those that are meant, the one whose centre is nearest to this point");
  fields.number("within_m", &C::within_m, {0.01, 1000.0}, "m", "and no further from near_m than this");
}

NameLandmark::NameLandmark(const NameConfig& config) : config_(config), as_(config_detail::to_text(config.as, "as")) {
  (void)to_landmark_name(config.as, "as");
  if (as_.starts_with("nearest "))
    throw ConfigError(config.as.place, "as: " + in_quotes(as_) + " is no name: it means a landmark of a category");
  if (marker_name_in(as_))
    throw ConfigError(config.as.place, "as: " + in_quotes(as_) + " is no name: it means a printed tag");
  if (looks_like_id(as_))
    throw ConfigError(config.as.place, "as: " + in_quotes(as_) + " is no name: it looks like an id");
  if (config.landmark.kind == ConfigValue::Kind::null) return;
  if (!config.input.empty()) throw ConfigError(config.landmark.place, "name: landmark and input exclude each other");
  landmark_ = to_landmark_name(config.landmark, "landmark");
}

FoundPlace NameLandmark::meant(const WorldView& world, NamedPlaces& places) const {
  if (!landmark_.empty()) return find_landmarks(landmark_, world);
  FoundPlace found;
  if (config_.input.empty()) {
    found.place.landmarks = all_of(world.graph);
    if (found.place.landmarks.empty()) found.unknown = "the map holds no landmark";
    return found;
  }
  const std::optional<Place> given = places.input(config_.input);
  if (!given) return {{}, "no step has given the place \"" + config_.input + "\" yet"};
  found.place = *given;
  std::erase_if(found.place.landmarks, [&](LandmarkId id) { return world.graph.find(id) == nullptr; });
  if (found.place.landmarks.empty()) found.unknown = "the place \"" + config_.input + "\" holds no landmark";
  return found;
}

ChosenLandmark NameLandmark::chosen(const WorldView& world, BehaviourContext& context) const {
  const FoundPlace found = meant(world, context);
  if (!found.unknown.empty()) return {0, found.unknown};
  const std::vector<LandmarkId>& ids = found.place.landmarks;
  if (!config_.near_m) return {landmark_.empty() ? std::ranges::max(ids) : cheapest_of(ids, world, context), ""};
  const auto away_m = [&](LandmarkId id) { return distance_m(*world.graph.find(id), *config_.near_m); };
  const LandmarkId nearest = *std::ranges::min_element(ids, {}, away_m);
  if (away_m(nearest) <= config_.within_m) return {nearest, ""};
  char within[32];
  std::snprintf(within, sizeof within, "%.2f m", config_.within_m);
  return {0, "no landmark " + (landmark_.empty() ? "" : in_quotes(landmark_) + " ") + "within " + within + " of " +
                 described(*config_.near_m) + ": the nearest, " + too_far(*world.graph.find(nearest), *config_.near_m)};
}

Status NameLandmark::tick(const WorldView& world, BehaviourContext& context) {
  if (!config_.near_m && names_cluster(landmark_, world)) return context.name_cluster(landmark_, as_);
  const ChosenLandmark landmark = chosen(world, context);
  if (!landmark.unknown.empty()) return {StepState::failure, "names nothing " + as_ + ": " + landmark.unknown};
  return context.name_landmark(landmark.id, as_);
}

}  // namespace cairn::behaviours

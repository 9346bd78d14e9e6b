// Places as missions write them: `[x, y]` or `"x,y"`, a landmark's or cluster's id or name, `nearest CATEGORY`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/config_value.hpp"
#include "framework/contracts/behaviour.hpp"
#include "maps/clustering/cluster_tree.hpp"

namespace cairn::behaviours {

struct PlaceName {
  std::string text;           // for people
  std::optional<Point> at_m;  // a place of the map; otherwise the text names landmarks
};
// Throws ConfigError on anything else, and on an empty text.
[[nodiscard]] PlaceName to_place_name(const ConfigValue& value, const std::string& key);
// Text that names landmarks. Throws ConfigError on anything else, and on an empty text.
[[nodiscard]] std::string to_landmark_name(const ConfigValue& value, const std::string& key);
[[nodiscard]] PlaceName place_name_of(const Point& at_m);

// What a name stands for on this map; when it stands for nothing, `unknown` says so, naming what there is.
struct FoundPlace {
  Place place;
  std::string unknown;
};
// Of a landmark's id or name, `nearest CATEGORY`, or a cluster's id or name: any of its landmarks.
[[nodiscard]] FoundPlace find_landmarks(const std::string& name, const LandmarkGraph& graph,
                                        const ClusterTree& clusters = {});
[[nodiscard]] FoundPlace find_place(const PlaceName& name, const LandmarkGraph& graph,
                                    const ClusterTree& clusters = {});
// As the mission last formed its clusters; none where the world has none.
[[nodiscard]] FoundPlace find_landmarks(const std::string& name, const WorldView& world);
[[nodiscard]] FoundPlace find_place(const PlaceName& name, const WorldView& world);

// Whether it is the id or name of a cluster, and not of a landmark.
[[nodiscard]] bool names_cluster(const std::string& name, const WorldView& world);

// Whether a landmark of a goal is known no more: planners refuse all of it then, so its name must be looked up again.
[[nodiscard]] bool names_retired(const Place& goal, const LandmarkGraph& graph);

// "L3 (square)".
[[nodiscard]] std::string described(const Landmark& landmark);
[[nodiscard]] std::string described(const Point& at_m);

// The one of some landmarks that the mission's planner finds the cheapest to get to; where it finds a path to none, the
// nearest one. ids must not be empty and be known to the graph.
[[nodiscard]] LandmarkId cheapest_of(const std::vector<LandmarkId>& ids, const WorldView& world,
                                     BehaviourContext& context);

// The landmark that a behaviour is about, chosen once; the reason when there is none.
struct ChosenLandmark {
  LandmarkId id = 0;
  std::string unknown;
};
[[nodiscard]] ChosenLandmark choose_landmark(const std::string& name, const WorldView& world,
                                             BehaviourContext& context);
// Why a landmark that was chosen is not known any more.
[[nodiscard]] std::string lost(LandmarkId id, const LandmarkGraph& graph);

}  // namespace cairn::behaviours

// The lowest symbolic level: landmarks joined by routes (docs/method.md 9; paper section 2.1).
//
// Ids are stable: an id is never given twice, whatever is removed. Routes are directed: a two-way
// road is two routes. Iteration goes by rising id, so results never depend on hashing.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "maps/landmarks/marker_id.hpp"

namespace cairn {

using LandmarkId = std::int64_t;
using RouteId = std::int64_t;

struct TemplateDegree {
  std::string category;
  double orientation_rad = 0.0;
  double degree = 0.0;
  bool operator==(const TemplateDegree&) const = default;
};

// What the matchings at a landmark's place have said of one category.
struct CategoryEvidence {
  std::string category;
  int matchings = 0;         // that it fitted in
  double mean_degree = 0.0;  // over these
  double best_degree = 0.0;
  double last_degree = 0.0;  // in the last matching there; 0: it did not fit
  bool operator==(const CategoryEvidence&) const = default;
};

struct Landmark {
  LandmarkId id = 0;
  std::string name;      // may be empty; "L<id>" always names it too
  std::string category;  // empty for imported places without one
  Pose2 T_map_landmark;
  double degree = 0.0;                     // of the best matching of its category so far
  std::vector<TemplateDegree> templates;   // all above tau_match in that matching, best first
  std::vector<CategoryEvidence> evidence;  // over all matchings, by category
  int sightings = 0;
  std::optional<Pose2> access;  // where a robot stands to be "at" the landmark; none: its position
  int level = 0;                // floor of a building
  std::string annotations;      // what other tools keep with it: the text of a JSON object, or empty
  // The printed tag that it is; theta_rad is then the direction that its printed side faces.
  std::optional<MarkerId> marker{};

  // Where a robot stands to be "at" it.
  [[nodiscard]] Pose2 approach_pose() const { return access.value_or(T_map_landmark); }
  bool operator==(const Landmark&) const = default;
};

// What is kept of driven and planned trajectories: a hundredth of a millimetre and of a milliradian, far below what a
// robot measures, at a third of the bytes in a saved map. Imported ones stay as they are.
inline constexpr double kTrajectorySteps = 1e5;  // a metre or radian
// No place moves further: a route that is planned for a robot larger by this is free for the robot when rounded.
inline constexpr double kMaxRounding_m = 1e-5;
// Each number of each pose rounded to whole steps.
[[nodiscard]] std::vector<Pose2> in_whole_steps(std::vector<Pose2> trajectory);

struct Route {
  RouteId id = 0;
  LandmarkId from = 0;
  LandmarkId to = 0;
  double cost_m = 0.0;
  std::vector<Pose2> trajectory;  // from access to access, to kMaxRounding_m; empty when only the cost is known
  bool driven = false;            // the robot has driven it; otherwise planned or imported
  bool closed = false;            // found blocked
  int level = 0;
  std::optional<double> speed_limit_mps = std::nullopt;  // on this route; none: the robot's own
  std::string annotations = {};                          // as a landmark's
  bool operator==(const Route&) const = default;
};

// One that is not a landmark any more, with its history.
struct RetiredLandmark {
  Landmark landmark;
  std::string reason;
  bool operator==(const RetiredLandmark&) const = default;
};

class LandmarkGraph {
 public:
  // Ids of 0 are assigned; others are kept (loading). Throws std::invalid_argument on a duplicate or
  // negative id, an unknown end, a cost that is negative or not finite, a place that is not finite.
  LandmarkId add(Landmark landmark);
  RouteId add_route(Route route);
  void remove(LandmarkId id);  // and the routes that touch it
  // The same, but the landmark is kept among the retired ones, which no search finds.
  void retire(LandmarkId id, std::string reason);
  void add_retired(RetiredLandmark retired);  // loading; throws as add() does, and for an id of 0
  void remove_route(RouteId id);
  void set_closed(RouteId id, bool closed);
  void set_cost(RouteId id, double cost_m);  // throws as add_route() does
  // The ids to be given next. A saved graph keeps them, so that removed ids stay retired after
  // loading; reserve_ids never lowers them.
  [[nodiscard]] LandmarkId next_landmark_id() const { return next_landmark_; }
  [[nodiscard]] RouteId next_route_id() const { return next_route_; }
  void reserve_ids(LandmarkId next_landmark, RouteId next_route);

  [[nodiscard]] const std::map<LandmarkId, Landmark>& landmarks() const { return landmarks_; }
  [[nodiscard]] const std::map<LandmarkId, RetiredLandmark>& retired() const { return retired_; }
  [[nodiscard]] const std::map<RouteId, Route>& routes() const { return routes_; }
  [[nodiscard]] const Landmark* find(LandmarkId id) const;
  [[nodiscard]] Landmark* find(LandmarkId id);
  // "L12", its name or "tag 7"; an id wins over a landmark that is named like one, the lower id over a namesake, a name
  // over a marker.
  [[nodiscard]] const Landmark* find_by_name(const std::string& name_or_id) const;
  [[nodiscard]] const Landmark* find_marker(
      const MarkerId& marker) const;  // the lower id over another with that marker
  [[nodiscard]] const Route* find_route(RouteId id) const;
  // The landmark whose position is nearest, at most within_m away, or null; ties go to the lower id.
  [[nodiscard]] const Landmark* nearest(const Point& p_map, double within_m) const;
  [[nodiscard]] std::vector<LandmarkId> of_category(const std::string& category) const;
  // The routes that begin or end at a landmark, by rising id; none for an unknown one. One that leads back to
  // where it begins stands in both.
  [[nodiscard]] const std::vector<RouteId>& routes_from(LandmarkId id) const;
  [[nodiscard]] const std::vector<RouteId>& routes_to(LandmarkId id) const;
  // The cheapest open route from one landmark to another, or null; ties go to the lower id.
  [[nodiscard]] const Route* route_between(LandmarkId from, LandmarkId to) const;
  bool operator==(const LandmarkGraph&) const = default;

 private:
  struct Touching {
    std::vector<RouteId> out, in;  // rising
    bool operator==(const Touching&) const = default;
  };

  void check(const Landmark& landmark) const;

  std::map<LandmarkId, Landmark> landmarks_;
  std::map<LandmarkId, RetiredLandmark> retired_;
  std::map<RouteId, Route> routes_;
  std::map<LandmarkId, Touching> touching_;  // of landmarks with routes
  LandmarkId next_landmark_ = 1;
  RouteId next_route_ = 1;
};

[[nodiscard]] std::string label_of(const Landmark& landmark);  // its name, or "tag 7", or "L<id>"

}  // namespace cairn

// From detections to the landmark graph: which landmark is it, where does one stand beside it, and
// which routes join it to the others.
#pragma once

#include <functional>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/detector.hpp"
#include "framework/contracts/planner.hpp"
#include "framework/contracts/robot_model.hpp"
#include "maps/geometry/contour.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

struct LandmarkTrackerConfig {
  double merge_m = 0.4;              // a detection this near to a landmark is that landmark
  int confirm_sightings = 3;         // matchings that must find it before it counts as a landmark
  double freed_ratio = 0.8;          // of the cells inside its outline: seen free, a landmark is retired
  int routes_per_landmark = 3;       // joined to this many nearest others
  double driven_detour_ratio = 1.3;  // a driven way is kept when it is at most this much longer than the planned one
  bool correct_pose = true;          // landmarks seen again are told to the localizer
  double access_margin_m = 0.05;     // free space kept round the robot that stands beside a landmark
  static void describe(Fields<LandmarkTrackerConfig>& fields);
};

class LandmarkTracker {
 public:
  // The shapes tell which cells are a landmark's own; one of another category is never retired.
  LandmarkTracker(const LandmarkTrackerConfig& config, const RobotModel& robot, std::vector<LandmarkShape> shapes);

  enum class ChangeKind { found, changed, retired };
  struct Change {
    LandmarkId landmark = 0;
    ChangeKind kind = ChangeKind::found;
  };
  // What one matching does to the graph. Its degrees are evidence for every landmark at whose place they were
  // found (see add_evidence()), with a detection or without: that is how an early category is corrected and a pose
  // refined. Only detections make new landmarks, and chance likenesses in a growing map come and go: what is
  // not confirmed yet is a candidate, which gathers evidence too but is no landmark. Landmarks that prove to
  // be one are merged.
  [[nodiscard]] std::vector<Change> update(const Matching& matching);
  // Retires the landmarks, and drops the candidates, whose place has been seen free.
  [[nodiscard]] std::vector<Change> retire_freed(const OccupancyGrid& grid);

  // Goes on from what an earlier run has known.
  void restore(LandmarkGraph graph, LandmarkGraph candidates, std::vector<Pose2> driven_path);

  // Remembers where the robot has been (thinned to 5 cm).
  void record_pose(const Pose2& T_map_robot);

  // Finds a standing place beside each landmark and joins near landmarks by routes: the way the robot
  // drove between them where there is one, a planned one elsewhere. Replaces all earlier routes. The graph is whole
  // whenever plan is called, so that a call which never returns costs the routes to come and nothing else.
  using Plan = std::function<PlanResult(const PlanRequest&)>;
  void connect(const WorldView& world, const Plan& plan, std::uint64_t seed);

  [[nodiscard]] const LandmarkGraph& graph() const { return graph_; }
  [[nodiscard]] const LandmarkGraph& candidates() const { return candidates_; }
  [[nodiscard]] const std::vector<Pose2>& driven_path() const { return driven_path_; }

 private:
  void see(const Detection& detection);
  void merge_beside(LandmarkId id, std::vector<Change>& changes);
  void find_access(const WorldView& world);
  void join(const Landmark& from, const Landmark& to, const Plan& plan, std::uint64_t seed);
  [[nodiscard]] std::vector<Pose2> driven_between(const Pose2& from, const Pose2& to) const;

  LandmarkTrackerConfig config_;
  RobotModel robot_;
  std::vector<LandmarkShape> shapes_;
  LandmarkGraph graph_;
  LandmarkGraph candidates_;  // seen, but not confirm_sightings times yet
  std::vector<Pose2> driven_path_;
};

}  // namespace cairn

// From detections to the landmark graph: which landmark is it, and is it new or known?
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/contracts/detector.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/landmarks/association/association.hpp"
#include "framework/landmarks/config.hpp"
#include "framework/landmarks/connector.hpp"
#include "framework/landmarks/markers/marker_tracker.hpp"
#include "maps/geometry/contour.hpp"
#include "maps/geometry/map_move.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

class LandmarkTracker {
 public:
  // The shapes tell which cells are a landmark's own; one of another category is never retired. max_path_poses: of the
  // driven path.
  LandmarkTracker(const LandmarksConfig& config, const RobotModel& robot, std::vector<LandmarkShape> shapes,
                  std::size_t max_path_poses = DrivenPath::kMaxPoses);

  enum class ChangeKind { found, changed, retired };
  struct Change {
    LandmarkId landmark = 0;
    ChangeKind kind = ChangeKind::found;
  };
  // What one matching does to the graph. Its degrees are evidence for the landmark that they are of (by distance: for
  // every one at whose place they were found; see add_evidence()), with a detection or without: that is how an early
  // category is corrected and a pose refined. Only detections make new landmarks, and chance likenesses in a growing
  // map come and go: what is not confirmed yet is a candidate, which gathers evidence too but is not a landmark.
  // Landmarks that prove to be one are merged.
  [[nodiscard]] std::vector<Change> update(const Matching& matching);
  // Printed markers seen from the pose last recorded. A marker is a landmark once it has been seen often enough; its
  // pose in the graph moves when its estimate has, by more than a little.
  [[nodiscard]] std::vector<Change> update(std::span<const MarkerSighting> sightings);
  // How markers become landmarks: their categories by number, and after how many sightings.
  void expect_markers(std::map<int, std::string> categories, int confirm_sightings);
  // Retires the landmarks, and drops the candidates, whose place has been seen free.
  [[nodiscard]] std::vector<Change> retire_freed(const OccupancyGrid& grid);

  // Goes on from what an earlier run has known.
  void restore(LandmarkGraph graph, LandmarkGraph candidates, std::vector<Pose2> driven_path);

  // Names a landmark. False when there is none with that id.
  bool name(LandmarkId id, const std::string& name);

  // Remembers where the robot has been, and how well it knew that. At every tick.
  void record_pose(const PoseEstimate& pose);
  // The map has been drawn anew. The path, and what was seen on it, move along: each landmark and candidate as the pose
  // from which it was placed, each point of a route as the way near by. What an earlier run has seen stays.
  [[nodiscard]] std::vector<Change> move(const MapMove& move);
  // Brings approach poses and routes up to date (LandmarkConnector).
  void connect(const WorldView& world, const LandmarkConnector::Plan& plan, std::uint64_t seed) {
    connector_.connect(graph_, driven_, world, plan, seed);
  }

  [[nodiscard]] const LandmarkGraph& graph() const { return graph_; }
  [[nodiscard]] const LandmarkGraph& candidates() const { return candidates_; }
  [[nodiscard]] const std::vector<Pose2>& driven_path() const { return driven_.poses(); }

 private:
  // Give the landmarks that have changed.
  [[nodiscard]] std::vector<LandmarkId> add_by_distance(const Matching& matching);
  [[nodiscard]] std::vector<LandmarkId> add_by_template_sets(const Matching& matching);
  std::optional<LandmarkId> add_part(const Matching& part, const LandmarkAssociation::Answer& answer);
  void see(const Detection& detection);
  void confirm(LandmarkId candidate, std::vector<Change>& changes);
  [[nodiscard]] std::optional<LandmarkId> known_as(const Landmark& candidate) const;
  [[nodiscard]] bool are_one(const Landmark& a, const Landmark& b) const;
  void merge_beside(LandmarkId id, std::vector<Change>& changes);
  void name_marker_categories();
  void place_marker(const MarkerId& marker, std::vector<Change>& changes);
  [[nodiscard]] bool is_confirmed(const MarkerTracker::Estimate& estimate) const;
  [[nodiscard]] bool is_of_this_run(LandmarkId id) const;
  void note_places();
  void move_landmarks(const MapMove& move, std::vector<Change>& changes);
  void move_marker(const MarkerId& marker, std::vector<Change>& changes);
  void move_routes(const MapMove& move);

  LandmarksConfig config_;
  std::vector<LandmarkShape> shapes_;
  LandmarkAssociation association_;
  LandmarkGraph graph_;
  LandmarkGraph candidates_;  // seen, but not confirm_sightings times yet
  DrivenPath driven_;
  std::vector<Pose2> driven_before_;  // by an earlier run, or before the robot was lost
  LandmarkConnector connector_;
  MarkerTracker markers_;
  std::map<int, std::string> marker_categories_;  // by number
  int confirm_marker_sightings_ = 3;
  // Where a landmark or candidate was placed last, and from which of the robot's poses; none: in an earlier run.
  struct Placed {
    Pose2 T_map_landmark;
    std::optional<std::size_t> pose_number;
  };
  std::map<LandmarkRef, Placed> placed_;
  PoseEstimate pose_;  // the one recorded last
  std::size_t poses_ = 0;
};

}  // namespace cairn

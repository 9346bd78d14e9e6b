// From detections to the landmark graph: which landmark is it, where does one stand beside it, and
// which routes join it to the others.
#pragma once

#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/detector.hpp"
#include "framework/contracts/planner.hpp"
#include "framework/contracts/robot_model.hpp"
#include "maps/landmark_graph.hpp"

namespace cairn {

struct LandmarkKeeperConfig {
  double merge_m = 0.4;              // a detection this near to a landmark is that landmark
  int confirm_sightings = 3;         // matchings that must find it before it counts as a landmark
  int routes_per_landmark = 3;       // joined to this many nearest others
  double driven_detour_ratio = 1.3;  // a driven way is kept when it is at most this much longer than the planned one
  double access_margin_m = 0.05;     // free space kept round the robot that stands beside a landmark
  static void describe(Fields<LandmarkKeeperConfig>& fields);
};

class LandmarkKeeper {
 public:
  LandmarkKeeper(const LandmarkKeeperConfig& config, const RobotModel& robot);

  // What one detection does to the graph: the landmark it belongs to, and whether that is new. Chance
  // likenesses in a growing map come and go, so one that is not confirmed yet changes nothing (landmark
  // 0). A better degree improves place, category and templates; a worse one only counts as a sighting.
  struct Change {
    LandmarkId landmark = 0;  // 0: none yet
    bool is_new = false;
    bool improved = false;
  };
  Change fold(const Detection& detection);

  // Remembers where the robot has been (thinned to 5 cm).
  void follow(const Pose2& T_map_robot);

  // Finds a standing place beside each landmark and joins near landmarks by routes: the way the robot
  // drove between them where there is one, a planned one elsewhere. Replaces all earlier routes.
  void connect(const WorldView& world, const Planner& planner, const Budget& budget, std::uint64_t seed);

  [[nodiscard]] const LandmarkGraph& graph() const { return graph_; }
  [[nodiscard]] const std::vector<Pose2>& driven_path() const { return driven_path_; }

 private:
  void find_access(const WorldView& world);
  void join(const Landmark& from, const Landmark& to, const WorldView& world, const Planner& planner,
            const Budget& budget, std::uint64_t seed);
  [[nodiscard]] std::vector<Pose2> driven_between(const Pose2& from, const Pose2& to) const;

  LandmarkKeeperConfig config_;
  RobotModel robot_;
  LandmarkGraph graph_;
  LandmarkGraph candidates_;  // seen, but not confirm_sightings times yet
  std::vector<Pose2> driven_path_;
};

}  // namespace cairn

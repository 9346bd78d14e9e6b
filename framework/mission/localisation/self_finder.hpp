// Finds out where in a saved map a robot is that began somewhere in it.
//
// Until then the robot draws a small map of its own, in a frame that begins where it began. Each metre that it drives,
// that small map is searched in the whole of the saved one (maps/relocalisation), in a thread of its own; the answer is
// taken kAnswerAfter_s later by the mission's clock, and waited for if it is late: the same run gives the same bytes.
// The compass, where there is one, limits how the two frames can be turned to each other.
//
// A printed marker of the map ends the search: two sightings that agree, of two
// markers or from places some way apart, from pictures that leave no second pose open.
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "framework/contracts/localizer.hpp"
#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
#include "maps/landmarks/landmark_graph.hpp"
#include "maps/relocalisation/pose_belief.hpp"
#include "maps/relocalisation/pose_check.hpp"

namespace cairn {

// Of a robot that was lost: in a map that is left alone, or carried.
struct LocalisationFigures {
  bool is_pose_given = false;
  std::optional<double> found_s;  // by the mission's clock; none: lost still, or the pose was given
  double driven_m = 0.0;          // until then
  Pose2 T_map_robot;              // then
  int searches = 0;
  std::vector<PoseHypothesis> guesses;  // of the last search, best first
};

// How well a robot knows its place once it has found itself.
inline constexpr StartUncertainty kFoundUncertainty{0.1, radians(2.0)};
// In a frame of its own, which is turned as the compass says.
[[nodiscard]] StartUncertainty own_frame(const RobotModel& robot);
// By how much a compass can be wrong.
[[nodiscard]] double compass_within(const RobotModel& robot);

class SelfFinder {
 public:
  struct Answer {
    std::vector<PoseHypothesis> found;
    std::optional<PoseHypothesis> believed;
  };
  // The map must stay as it is.
  SelfFinder(std::shared_ptr<const OccupancyGrid> map, const RobotModel& robot);

  // At every tick. seen: the small map.
  void update(const Observation& observation, const Pose2& T_local_robot, const OccupancyGrid& seen, double time_s);
  // After update(): markers in that observation that the map holds.
  void see_markers(const Observation& observation, const Pose2& T_local_robot, const LandmarkGraph& known);
  // What markers have said so far may be of where the robot was before.
  void forget_markers();
  // Each search also looks at where the robot is if it began at T_map_start: looks() has one more then. T_local_robot:
  // with the first observation. The frames are the same, or turned to each other by more than a compass can be wrong.
  void compare_with(const Pose2& T_map_start, const Pose2& T_local_robot);
  [[nodiscard]] bool is_compared() const { return T_map_local_believed_.has_value(); }
  [[nodiscard]] const std::vector<PoseLook>& looks() const { return looks_; }
  // Where the robot's own frame lies in the map, once that is known.
  [[nodiscard]] const std::optional<Pose2>& T_map_local() const {
    return by_marker_ ? by_marker_ : belief_.T_map_local();
  }
  // The search under way, as something whose destructor waits for its end; null: there is none. Its answer is lost.
  [[nodiscard]] std::shared_ptr<std::future<Answer>> let_go();
  // All but found_s and T_map_robot.
  [[nodiscard]] LocalisationFigures figures() const;

  static constexpr double kAnswerAfter_s = 1.0;

 private:
  struct Search {
    std::future<Answer> answer;
    Pose2 T_local_robot;
    double begun_s = 0.0;
    double driven_m = 0.0;
  };
  void take(const Answer& answer);
  void follow_compass(const Observation& observation, const Pose2& T_local_robot);
  [[nodiscard]] std::optional<KnownHeading> heading(const Pose2& T_local_robot) const;

  // What searches share, which may go on when the finder is gone.
  struct Searched {
    std::shared_ptr<const OccupancyGrid> map;
    std::optional<PoseSearch> search{};  // made by the first one, in its thread
  };
  const std::shared_ptr<Searched> searched_;
  double compass_within_rad_;
  bool has_compass_;
  Point compass_sum_{0.0, 0.0};  // of unit vectors: by how much the map's frame is turned from the robot's own
  PoseBelief belief_;
  struct MarkerGuess {
    MarkerId marker;
    Pose2 T_map_local;
    Pose2 T_local_robot;  // when it was seen
  };
  std::optional<MarkerGuess> marker_guess_;  // by the marker that counted last
  std::optional<Pose2> by_marker_;
  int searches_ = 0;
  std::optional<Pose2> T_map_local_believed_;
  std::vector<PoseLook> looks_;
  std::optional<Search> running_;
};

// Searches that go on though nobody needs their answers.
class EndingSearches {
 public:
  using Search = std::shared_ptr<std::future<SelfFinder::Answer>>;
  // Null: none. Those that have ended are dropped, each with its map.
  void add(Search search) {
    std::erase_if(searches_, [](const Search& ending) {
      return ending->wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    if (search) searches_.push_back(std::move(search));
  }
  // Until all have ended.
  void wait() { searches_.clear(); }

 private:
  std::vector<Search> searches_;
};

}  // namespace cairn

// Whether a robot that believes to know its place is to be checked: cheap enough for every tick.
//
// Two signs. Of the readings of the last 2 m driven, too many contradict the map as it was some metres ago: an echo
// where all of it was free, or one from behind something. Or the estimate has jumped: the localizer has begun to
// believe a compass or landmarks that it had refused. Neither proves anything, a moved table gives the first and a
// slipping wheel the second: a doubt only begins a check (maps/relocalisation/pose_check.hpp), which decides.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/mission/localisation/watch_figures.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

struct DoubtRules {
  double piece_m = 0.1;  // of the way, or a turn of
  double piece_rad = radians(20.0);
  std::size_t pieces = 20;
  std::size_t max_readings = 36;  // of a piece: the rest, as of a robot that stands, says nothing more
  int min_readings = 40;          // that the map says something about
  double contradicted_ratio = 0.15;
  // After each doubt that has proved wrong so much more, up to that: smooth walls contradict in all of some worlds.
  double wrong_factor = 1.3;
  double max_contradicted_ratio = 0.35;
  double jump_m = 0.3;  // more than odometry says, from one tick to the next
  double jump_rad = radians(15.0);
};

enum class MapAnswer : std::uint8_t { unknown, agrees, contradicts };
// What a map says to an echo; `unknown` to every other reading.
[[nodiscard]] MapAnswer answer_of(const OccupancyGrid& map, const Pose2& T_map_robot, const RangeReading& reading);

class PoseDoubt {
 public:
  explicit PoseDoubt(const RobotModel& robot, const DoubtRules& rules = {});

  // At every tick. before: the map as it was. Why there is a doubt now, if there is.
  std::optional<DoubtCause> update(const Observation& observation, const Pose2& T_map_robot,
                                   const OccupancyGrid& before);
  // Far from a doubt: what is drawn now is worth keeping.
  [[nodiscard]] bool is_quiet() const { return 2.0 * contradicted_ratio() < rules_.contradicted_ratio; }
  [[nodiscard]] double contradicted_ratio() const;  // of the readings that the map says something about
  // The doubt has proved wrong: the next one needs more.
  void was_wrong();
  // The robot was found: what doubts have proved wrong says nothing of where it is now.
  void forget_wrong() { doubted_from_ratio_ = rules_.contradicted_ratio; }
  // A doubt needs new evidence.
  void reset();

 private:
  struct Piece {
    std::size_t readings = 0;
    int known = 0;
    int contradicted = 0;
  };
  [[nodiscard]] bool has_jumped(const Observation& observation, const Pose2& T_map_robot);
  [[nodiscard]] bool does_compass_agree(const Observation& observation, const Pose2& T_map_robot) const;
  void compare(const Observation& observation, const Pose2& T_map_robot, const OccupancyGrid& before);

  DoubtRules rules_;
  double doubted_from_ratio_;
  double compass_within_rad_;
  bool has_compass_;
  std::optional<Pose2> T_map_robot_;   // of the last tick
  std::optional<Pose2> T_odom_robot_;  // of the last tick
  Pose2 piece_begun_at_{};
  std::deque<Piece> pieces_;  // the last is under way
  Piece sum_;
  std::optional<DoubtCause> cause_;  // until the compass agrees
};

}  // namespace cairn

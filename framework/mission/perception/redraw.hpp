// How the map follows a past that is corrected: it is drawn anew, a slice each tick, while the robot drives on in the
// map so far. Until all of it is drawn, everyone sees the old map and the robot's place in that, and from one tick to
// the next the new one: never a part, never a pose of the one in the other.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "framework/contracts/mapper.hpp"
#include "framework/mission/perception/past.hpp"

namespace cairn {

// The frame that a map was drawn in, beside that of the localizer, which jumps when the past is corrected.
class DrawnFrame {
 public:
  // The map is drawn anew when one of its poses has moved so far. Until then it is good enough, and the frames are one.
  static constexpr double kRedrawAfter_m = 0.1;

  // The past has been corrected: the longest way by which one of the map's poses has moved, and the last of them.
  void correct(double moved_m, const Pose2& T_drawn_last, const Pose2& T_map_last);
  // Whether the map should be drawn anew.
  [[nodiscard]] bool is_outdated() const { return is_outdated_; }
  // Of an estimate of the localizer, which the map has no jump for.
  [[nodiscard]] const Pose2& T_drawn_map() const { return T_drawn_map_; }

 private:
  Pose2 T_drawn_map_;
  bool is_outdated_ = false;
};

// The estimate as it is in a frame in which its own frame lies at T.
[[nodiscard]] PoseEstimate moved(const Pose2& T, PoseEstimate estimate);

class Redraw {
 public:
  // Slices are counted in cells, so that the same run gives the same bytes: about 5 ms for the map modules at hand, and
  // never less than two observations, so that it comes to its end.
  static constexpr double kCellsInSlice = 200000.0;
  static constexpr std::size_t kMinObservations = 2;

  using Draw = std::function<void(Mapper&, const Observation&, const PoseEstimate&)>;

  // map: that holds nothing of the past. Where the past belongs, one for each observation.
  Redraw(std::shared_ptr<Mapper> map, double cell_m, std::vector<Pose2> T_map_robot)
      : map_(std::move(map)), cell_m_(cell_m), T_map_robot_(std::move(T_map_robot)) {}

  // An observation that has come meanwhile; the past has it too.
  void add(const Pose2& T_map_robot) { T_map_robot_.push_back(T_map_robot); }
  void draw_slice(const Past& past, const Draw& draw);
  [[nodiscard]] bool is_done() const { return drawn_ == T_map_robot_.size(); }

  [[nodiscard]] const std::shared_ptr<Mapper>& map() const { return map_; }
  [[nodiscard]] const std::vector<Pose2>& T_map_robot() const { return T_map_robot_; }
  // The past has been corrected again; one for each observation.
  void correct(const std::vector<Pose2>& T_map_robot);
  [[nodiscard]] const DrawnFrame& frame() const { return frame_; }

 private:
  std::shared_ptr<Mapper> map_;
  double cell_m_;
  std::vector<Pose2> T_map_robot_;
  std::size_t drawn_ = 0;
  DrawnFrame frame_;
};

// About how many cells a mapper visits for it.
[[nodiscard]] double cells_of(const Observation& observation, double cell_m);

}  // namespace cairn

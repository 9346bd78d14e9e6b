#include "framework/mission/perception/redraw.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kFarthest_m = 10.0;   // beyond it beams that hit nothing are cut off, or seldom
constexpr double kCellsOfReading = 5;  // whatever its length
constexpr double kCellsOfObservation = 100;

}  // namespace

void DrawnFrame::correct(double moved_m, const Pose2& T_drawn_last, const Pose2& T_map_last) {
  is_outdated_ = moved_m > kRedrawAfter_m;
  T_drawn_map_ = is_outdated_ ? T_drawn_last * inverse(T_map_last) : Pose2{};
}

PoseEstimate moved(const Pose2& T, PoseEstimate estimate) {
  if (T == Pose2{}) return estimate;
  estimate.T_map_robot = T * estimate.T_map_robot;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(T.theta_rad), -std::sin(T.theta_rad), std::sin(T.theta_rad),
      std::cos(T.theta_rad);
  const Eigen::Matrix3d turned = turn * estimate.covariance * turn.transpose();
  estimate.covariance = 0.5 * (turned + turned.transpose());
  return estimate;
}

double cells_of(const Observation& observation, double cell_m) {
  double cells = kCellsOfObservation;
  for (const RangeReading& reading : observation.ranges) {
    const double length_m =
        std::clamp(std::isfinite(reading.range_m) ? reading.range_m : reading.max_m, 0.0, kFarthest_m);
    const double length = length_m / cell_m;
    cells += kCellsOfReading + length + reading.half_beam_rad * length * length;
  }
  return cells;
}

void Redraw::correct(const std::vector<Pose2>& T_map_robot) {
  double moved_m = 0.0;
  for (std::size_t i = 0; i < T_map_robot_.size(); ++i)
    moved_m = std::max(moved_m, (T_map_robot_[i].position() - T_map_robot[i].position()).norm());
  frame_.correct(moved_m, T_map_robot_.back(), T_map_robot.back());
}

void Redraw::draw_slice(const Past& past, const Draw& draw) {
  double cells = 0.0;
  for (std::size_t i = 0; !is_done() && (i < kMinObservations || cells < kCellsInSlice); ++i) {
    const Observation seen = past.observation(drawn_);
    cells += cells_of(seen, cell_m_);
    draw(*map_, seen, PoseEstimate{T_map_robot_[drawn_]});
    ++drawn_;
  }
}

}  // namespace cairn

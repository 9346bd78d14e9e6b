#include "framework/modules/plausibility.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kMaxImported_m = 1e9;  // of coordinates in graph files

bool is_finite(const std::vector<TemplateDegree>& templates) {
  return std::ranges::all_of(templates, [](const TemplateDegree& fit) {
    return std::isfinite(fit.degree) && std::isfinite(fit.orientation_rad);
  });
}

bool is_finite(const Matching& matching) {
  for (const CategoryDegree& degree : matching.degrees)
    if (!std::isfinite(degree.degree) || !degree.at_m.allFinite() || !std::isfinite(degree.orientation_rad))
      return false;
  if (!is_finite(matching.templates)) return false;
  if (!matching.detection) return true;
  const auto& [category, T_map_landmark, degree, templates] = *matching.detection;
  return cairn::is_finite(T_map_landmark) && std::isfinite(degree) && is_finite(templates);
}

bool is_near(const Point& at_m, const OccupancyGrid& grid) {
  const CellBox box = grid.bounds();
  const Point lower_m = grid.centre_of(box.min) - Point::Constant(kMaxDetectionOutside_m);
  const Point upper_m = grid.centre_of(box.max) + Point::Constant(kMaxDetectionOutside_m);
  return (at_m.array() >= lower_m.array()).all() && (at_m.array() <= upper_m.array()).all();
}

}  // namespace

std::string ObservationCheck::fault_of(const Observation& observation) {
  if (!std::isfinite(observation.stamp_s) || !cairn::is_finite(observation.T_odom_robot))
    return "returned a stamp or an odometry that is not finite";
  if (observation.compass_rad && !std::isfinite(*observation.compass_rad))
    return "returned a compass heading that is not finite";
  const WallClock::Time here = wall_clock_->now();
  if (last_stamp_s_) {
    const double passed_s = observation.stamp_s - *last_stamp_s_;
    if (!is_clock_possible(passed_s, std::chrono::duration<double>(here - last_here_).count()))
      return fmt::format("returned a stamp of {:g} s after one of {:g} s", observation.stamp_s, *last_stamp_s_);
    if (std::string fault = fault_of_motion(observation.T_odom_robot, std::max(passed_s, 0.0)); !fault.empty())
      return fault;
  }
  last_stamp_s_ = observation.stamp_s;
  last_here_ = here;
  T_odom_last_ = observation.T_odom_robot;
  return {};
}

// here_s: what has passed by this computer's clock. A process that was stopped, or a long plan, is no leap of a clock.
bool ObservationCheck::is_clock_possible(double passed_s, double here_s) const {
  if (is_live_) return passed_s >= 0.0 && passed_s <= kMaxLiveStampAhead_s + here_s;
  return passed_s >= -kMaxStampBack_s && passed_s <= kMaxStampAhead_s;
}

// A live robot that goes on being too fast, each step by a little, uses up what it may leap.
std::string ObservationCheck::fault_of_motion(const Pose2& T_odom_robot, double passed_s) {
  spare_m_ = std::min(kMaxLiveLeap_m, spare_m_ + kMaxLiveLeap_m * passed_s);
  spare_rad_ = std::min(kMaxLiveTurn_rad, spare_rad_ + kMaxLiveTurn_rad * passed_s);
  const double leap_m = (T_odom_robot.position() - T_odom_last_.position()).norm();
  const double usual_m = (is_live_ ? 3.0 : 10.0) * max_v_mps_ * passed_s;
  if (leap_m > usual_m + (is_live_ ? spare_m_ : kMaxOdometryLeap_m))
    return fmt::format("returned an odometry that leaps by {:g} m within {:g} s", leap_m, passed_s);
  spare_m_ -= std::max(leap_m - usual_m, 0.0);
  const double turn_rad = std::abs(wrap_angle(T_odom_robot.theta_rad - T_odom_last_.theta_rad));
  const double usual_rad = 3.0 * max_w_radps_ * passed_s;
  if (is_live_ && turn_rad > usual_rad + spare_rad_)
    return fmt::format("returned an odometry that turns by {:.0f} degrees within {:g} s", degrees(turn_rad), passed_s);
  spare_rad_ -= std::max(turn_rad - usual_rad, 0.0);
  return {};
}

std::string fault_of(const GroundTruth& truth) {
  return cairn::is_finite(truth.T_map_robot) ? "" : "returned a true place that is not finite";
}

std::string fault_of(const PoseEstimate& pose, double max_m) {
  if (!cairn::is_finite(pose.T_map_robot) || !pose.covariance.allFinite()) return "returned a pose that is not finite";
  const double out_m = pose.T_map_robot.position().cwiseAbs().maxCoeff();
  if (out_m > max_m)
    return fmt::format("returned a pose {:g} m from the map's origin, {:g} m are allowed", out_m, max_m);
  return {};
}

std::string fault_of(const MarkerSighting& sighting) {
  const auto is_wrong = [](const MarkerPose& pose) {
    return !cairn::is_finite(pose.T_robot_marker) || !std::isfinite(pose.height_m) || !pose.covariance.allFinite() ||
           pose.covariance.llt().info() != Eigen::Success;
  };
  if (is_wrong(sighting.pose) || (sighting.mirrored && is_wrong(*sighting.mirrored)))
    return "returned a marker whose pose is not finite or whose covariance is none";
  const auto away_m = [](const MarkerPose& pose) {
    return std::hypot(pose.T_robot_marker.position().norm(), pose.height_m);
  };
  const double furthest_m = std::max(away_m(sighting.pose), sighting.mirrored ? away_m(*sighting.mirrored) : 0.0);
  if (furthest_m > kMaxMarkerAway_m) return fmt::format("returned a marker {:g} m away", furthest_m);
  return {};
}

std::string fault_of(const LoopProposal& proposal, std::size_t submaps) {
  if (proposal.submap >= submaps)
    return fmt::format("proposed a loop with submap {} of {}", proposal.submap + 1, submaps);
  const Eigen::Matrix3d& information = proposal.information;
  if (!cairn::is_finite(proposal.T_submap_node) || !information.allFinite() || !std::isfinite(proposal.score))
    return "proposed a loop that is not finite";
  if (proposal.score < 0.0 || proposal.score > 1.0)
    return fmt::format("proposed a loop with a score of {:g}, which is not within 0 to 1", proposal.score);
  const double off_m = proposal.T_submap_node.position().norm();
  if (off_m > kMaxPlace_m) return fmt::format("proposed a loop over {:g} m", off_m);
  if (!information.isApprox(information.transpose(), 1e-6) || information.llt().info() != Eigen::Success)
    return "proposed a loop whose information is none";
  return {};
}

std::string fault_of(const Matching& matching, const OccupancyGrid& grid) {
  if (!is_finite(matching)) return "returned a detection that is not finite";
  if (!matching.detection || is_near(matching.detection->T_map_landmark.position(), grid)) return {};
  const Pose2& at = matching.detection->T_map_landmark;
  return fmt::format("returned a detection at ({:g}, {:g}), which is outside of the map", at.x_m, at.y_m);
}

std::string fault_of(const PlanResult& plan) {
  if (plan.outcome != PlanOutcome::solved && plan.path.empty()) return {};  // numbers of no path mean nothing
  const auto is_place = [](const Pose2& pose) {
    return cairn::is_finite(pose) && pose.position().cwiseAbs().maxCoeff() <= kMaxImported_m;
  };
  if (!std::isfinite(plan.cost_m) || !std::isfinite(plan.length_m) || !std::ranges::all_of(plan.path, is_place))
    return fmt::format("returned a path that is not finite, or leads farther than {:g} m", kMaxImported_m);
  if (plan.cost_m < 0.0 || plan.length_m < 0.0) return "returned a path of less than no length or cost";
  return {};
}

}  // namespace cairn

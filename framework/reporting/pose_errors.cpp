#include "framework/reporting/pose_errors.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kEvery_s = 1.0;

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace

void PoseErrors::note(const WorldView& world, const std::optional<Pose2>& true_T_map_robot) {
  corrections_ += world.pose.sightings_used;
  refused_ += world.pose.sightings_refused;
  if (!true_T_map_robot || world.pose.trust == PoseTrust::lost) return;
  if (last_ && world.time_s < last_->time_s + kEvery_s) return;
  const Pose2& truth = *true_T_map_robot;
  const Point off_m = truth.position() - world.pose.T_map_robot.position();
  const double off_rad = wrap_angle(truth.theta_rad - world.pose.T_map_robot.theta_rad);
  const Eigen::Vector3d off(off_m.x(), off_m.y(), off_rad);
  const double squared = off.dot(world.pose.covariance.ldlt().solve(off));
  last_ = PoseErrorSample{world.time_s, off_m.norm(), std::abs(off_rad), squared > 0.0 ? std::sqrt(squared) : 0.0};
  worst_m_ = std::max(worst_m_, last_->error_m);
  worst_rad_ = std::max(worst_rad_, last_->error_rad);
  samples_.add(*last_);
}

std::optional<PoseErrorFigures> PoseErrors::figures() const {
  if (!last_) return std::nullopt;
  std::vector<double> metres, angles, sigmas;
  for (const PoseErrorSample& sample : samples()) {
    metres.push_back(sample.error_m);
    angles.push_back(degrees(sample.error_rad));
    sigmas.push_back(sample.sigmas);
  }
  return PoseErrorFigures{quantile(metres, 0.5), quantile(metres, 0.95), worst_m_,
                          last_->error_m,        quantile(angles, 0.5),  degrees(worst_rad_),
                          quantile(sigmas, 0.5), corrections_,           refused_};
}

}  // namespace cairn

#include "maps/relocalisation/pose_belief.hpp"

namespace cairn {

bool PoseBelief::drive(const Pose2& T_local_robot) {
  if (T_local_robot_) driven_m_ += (T_local_robot.position() - T_local_robot_->position()).norm();
  T_local_robot_ = T_local_robot;
  if (driven_m_ - searched_at_m_ < rules_.search_every_m) return false;
  searched_at_m_ = driven_m_;
  return true;
}

bool PoseBelief::is_clear() const {
  if (guesses_.empty()) return false;
  const PoseHypothesis& best = guesses_.front();
  if (!best.is_held_by_corners || best.score < rules_.min_score) return false;
  if (best.contradicted_ratio > rules_.max_contradicted_ratio) return false;
  return guesses_.size() < 2 || guesses_[1].score <= rules_.clear_ratio * best.score;
}

void PoseBelief::update(const std::vector<PoseHypothesis>& found, const Pose2& T_local_robot) {
  guesses_ = found;
  T_map_local_.reset();
  if (!is_clear()) {
    T_map_local_ahead_.reset();
    return;
  }
  const Pose2 T_map_local = guesses_.front().T_map_robot * inverse(T_local_robot);
  bool is_same = false;
  if (T_map_local_ahead_) {
    // Compared where the robot is now: far from the origin of the local frame a small turn moves much.
    const Pose2 expected = *T_map_local_ahead_ * T_local_robot;
    const Pose2 off = inverse(expected) * guesses_.front().T_map_robot;
    is_same = off.position().norm() <= rules_.same_m && std::abs(off.theta_rad) <= rules_.same_rad;
  }
  if (!is_same) ahead_since_m_ = driven_m_;
  T_map_local_ahead_ = T_map_local;
  if (driven_m_ - ahead_since_m_ >= rules_.ahead_for_m) T_map_local_ = T_map_local;
}

}  // namespace cairn

#include "framework/landmarks/markers/marker_tracker.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kApart_m = 0.15;  // of the robot, between sightings that count
constexpr double kApart_rad = radians(12.0);
constexpr double kFar = 30.0;     // squared Mahalanobis distance of a sighting that is none of this place
constexpr int kMoved = 4;         // of these in a row: the marker hangs elsewhere now
constexpr double kDecides = 9.0;  // difference of misfits
// Of a marker; undecided ones count after four times `confirm_sightings`.
constexpr std::size_t kMaxKept = 200;

struct InMap {
  Eigen::Vector3d state;
  Eigen::Matrix3d covariance;
};

// The robot's error turns and moves what it sees.
InMap in_map(const MarkerPose& seen, const Pose2& T_map_robot, const Eigen::Matrix3d& pose_covariance) {
  const Pose2 T_map_marker = T_map_robot * seen.T_robot_marker;
  const Point off = T_map_marker.position() - T_map_robot.position();
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Identity();
  by_pose(0, 2) = -off.y();
  by_pose(1, 2) = off.x();
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  turned.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(T_map_robot.theta_rad).toRotationMatrix();
  return {{T_map_marker.x_m, T_map_marker.y_m, T_map_marker.theta_rad},
          by_pose * pose_covariance * by_pose.transpose() + turned * seen.covariance * turned.transpose()};
}

Eigen::Vector3d difference(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Vector3d off = a - b;
  off[2] = wrap_angle(off[2]);
  return off;
}

std::vector<MarkerPose> poses_of(const MarkerSighting& sighting) {
  std::vector<MarkerPose> poses{sighting.pose};
  if (sighting.mirrored) poses.push_back(*sighting.mirrored);
  return poses;
}

}  // namespace

bool are_apart(const Pose2& a, const Pose2& b) {
  return (a.position() - b.position()).norm() >= kApart_m ||
         std::abs(wrap_angle(a.theta_rad - b.theta_rad)) >= kApart_rad;
}

std::vector<MarkerId> MarkerTracker::update(std::span<const MarkerSighting> sightings, const PoseEstimate& pose,
                                            std::size_t pose_number) {
  std::vector<MarkerId> changed;
  for (const MarkerSighting& sighting : sightings) {
    const auto is_same = [&](const MarkerSighting& other) {
      return other.marker == sighting.marker && other.camera == sighting.camera && other.stamp_s == sighting.stamp_s;
    };
    if (std::ranges::count_if(sightings, is_same) > 1) continue;
    Track& track = tracks_[sighting.marker];
    if (!track.kept.empty() && !are_apart(track.kept.back().T_map_robot, pose.T_map_robot)) continue;
    if (add(track, {sighting, pose.T_map_robot, pose.covariance, pose_number})) changed.push_back(sighting.marker);
  }
  return changed;
}

void MarkerTracker::begin(Track& track, const Kept& kept) {
  track.hypotheses.clear();
  track.kept = {kept};
  track.strangers = 0;
  track.min_pose_covariance = kept.pose_covariance;
  for (const MarkerPose& pose : poses_of(kept.sighting)) {
    const InMap seen = in_map(pose, kept.T_map_robot, kept.pose_covariance);
    track.hypotheses.push_back({seen.state, seen.covariance, 0.0});
  }
}

// The pose of the sighting that fits the hypothesis better.
MarkerTracker::Match MarkerTracker::match_of(const Hypothesis& hypothesis, const Kept& kept) {
  std::optional<Match> best;
  for (const MarkerPose& pose : poses_of(kept.sighting)) {
    const InMap seen = in_map(pose, kept.T_map_robot, kept.pose_covariance);
    const Eigen::Vector3d off = difference(seen.state, hypothesis.state);
    const double distance2 = off.dot((hypothesis.covariance + seen.covariance).ldlt().solve(off));
    if (!best || distance2 < best->distance2) best = Match{off, seen.covariance, distance2};
  }
  return *best;
}

void MarkerTracker::correct(Hypothesis& hypothesis, const Match& match) {
  hypothesis.misfit += std::min(match.distance2, kFar);
  const Eigen::Matrix3d gain = hypothesis.covariance * (hypothesis.covariance + match.covariance).inverse();
  hypothesis.state += gain * match.off;
  hypothesis.state[2] = wrap_angle(hypothesis.state[2]);
  const Eigen::Matrix3d left = (Eigen::Matrix3d::Identity() - gain) * hypothesis.covariance;
  hypothesis.covariance = 0.5 * (left + left.transpose());
}

// Whether the estimate has changed.
bool MarkerTracker::add(Track& track, const Kept& kept) {
  std::vector<Match> matches;
  matches.reserve(track.hypotheses.size());
  for (const Hypothesis& hypothesis : track.hypotheses) matches.push_back(match_of(hypothesis, kept));
  // Of a marker that is new, none is near.
  if (std::ranges::none_of(matches, [](const Match& match) { return match.distance2 < kFar; })) {
    if (!matches.empty() && ++track.strangers < kMoved) return false;
    begin(track, kept);
    return true;
  }
  track.strangers = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) correct(track.hypotheses[i], matches[i]);
  std::ranges::stable_sort(track.hypotheses, {}, &Hypothesis::misfit);
  if (track.hypotheses.size() == 2 && track.hypotheses[1].misfit - track.hypotheses[0].misfit > kDecides)
    track.hypotheses.pop_back();
  if (kept.pose_covariance.trace() < track.min_pose_covariance.trace())
    track.min_pose_covariance = kept.pose_covariance;
  if (track.kept.size() == kMaxKept) track.kept.pop_back();
  track.kept.push_back(kept);
  return true;
}

void MarkerTracker::correct(std::span<const Pose2> T_map_robot) {
  for (auto& [marker, track] : tracks_) {
    std::vector<Kept> kept = std::move(track.kept);
    track = {};
    for (Kept& one : kept) {
      if (one.pose_number < T_map_robot.size()) one.T_map_robot = T_map_robot[one.pose_number];
      add(track, one);
    }
  }
}

std::optional<MarkerTracker::Estimate> MarkerTracker::estimate(const MarkerId& marker) const {
  const auto found = tracks_.find(marker);
  if (found == tracks_.end() || found->second.hypotheses.empty()) return std::nullopt;
  const Track& track = found->second;
  const Hypothesis& best = track.hypotheses.front();
  // What the robot did not know of its own place all sightings share.
  return Estimate{{best.state[0], best.state[1], best.state[2]},
                  best.covariance + track.min_pose_covariance,
                  static_cast<int>(track.kept.size()),
                  track.hypotheses.size() == 1};
}

std::vector<MarkerId> MarkerTracker::markers() const {
  std::vector<MarkerId> all;
  all.reserve(tracks_.size());
  for (const auto& [marker, track] : tracks_) all.push_back(marker);
  return all;
}

}  // namespace cairn

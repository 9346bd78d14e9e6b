#include "framework/experiments/trials/record.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kMoved_m = 0.1;
constexpr double kTurned_rad = radians(15.0);

bool has_reading(const Observation& observation) {
  return std::ranges::any_of(observation.ranges,
                             [](const RangeReading& reading) { return !std::isnan(reading.range_m); });
}

}  // namespace

void TrialRecord::on(const Event& event, const MissionView& view) {
  if (std::holds_alternative<TickDone>(event) && view.world.observation != nullptr) note_tick(view);
  if (const auto* node = std::get_if<NodeEnded>(&event)) note_landmarks(node->path, view.world.graph);
  if (const auto* step = std::get_if<StepEnded>(&event))
    note_landmarks(std::to_string(step->index + 1), view.world.graph);
}

void TrialRecord::note_landmarks(const std::string& path, const LandmarkGraph& graph) {
  std::vector<KnownLandmark>& known = landmarks_[path];
  known.clear();
  for (const auto& [id, landmark] : graph.landmarks()) {
    const Point at_m = landmark.T_map_landmark.position();
    known.push_back({landmark.category, at_m, landmark.access ? landmark.access->position() : at_m});
  }
}

std::vector<KnownLandmark> TrialRecord::landmarks_at_end(const std::string& path) const {
  const auto found = landmarks_.find(path);
  return found == landmarks_.end() ? std::vector<KnownLandmark>{} : found->second;
}

void TrialRecord::note_tick(const MissionView& view) {
  const Observation& observation = *view.world.observation;
  note_silence(observation, view.commanded);
  if (!view.truth) return;
  const Pose2& truth = view.truth->T_map_robot;
  const Pose2& estimate = view.world.pose.T_map_robot;
  moments_.push_back({view.world.time_s, truth, (estimate.position() - truth.position()).norm(),
                      std::abs(wrap_angle(estimate.theta_rad - truth.theta_rad)),
                      observation.battery_ratio.value_or(1.0) <= 0.0});
}

void TrialRecord::note_silence(const Observation& observation, const Twist& commanded) {
  const bool moves = commanded != Twist{};
  if (has_reading(observation)) {
    silent_ticks_ = 0;
  } else {
    if (++silent_ticks_ == 1) counts_ = moved_before_;
    if (silent_ticks_ == 1 && counts_) ++silences_.silences;
    const int stop_ticks = moves ? silent_ticks_ + 1 : silent_ticks_ == 1 ? 1 : 0;
    if (counts_) silences_.worst_stop_ticks = std::max(silences_.worst_stop_ticks, stop_ticks);
  }
  moved_before_ = moves;
}

Stand longest_stand(const std::vector<TrialMoment>& moments, const std::vector<WaitSpan>& waits) {
  Stand longest;
  const TrialMoment* anchor = nullptr;
  for (const TrialMoment& moment : moments) {
    const bool waits_now = std::ranges::any_of(
        waits, [&](const WaitSpan& span) { return span.begin_s <= moment.time_s && moment.time_s <= span.end_s; });
    const bool gets_on =
        anchor == nullptr || waits_now || moment.is_empty ||
        (moment.T_map_robot.position() - anchor->T_map_robot.position()).norm() > kMoved_m ||
        std::abs(wrap_angle(moment.T_map_robot.theta_rad - anchor->T_map_robot.theta_rad)) > kTurned_rad;
    if (gets_on) anchor = &moment;
    if (moment.time_s - anchor->time_s > longest.for_s) longest = {anchor->time_s, moment.time_s - anchor->time_s};
  }
  return longest;
}

}  // namespace cairn

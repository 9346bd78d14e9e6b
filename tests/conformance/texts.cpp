#include "tests/conformance/texts.hpp"

#include <cstdio>

namespace cairn::conformance {

std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string text_of(const Pose2& pose) {
  return "(" + text_of(pose.x_m) + ", " + text_of(pose.y_m) + ", " + text_of(pose.theta_rad) + ")";
}

std::string text_of(const Twist& twist) {
  return "v " + text_of(twist.v_mps) + " w " + text_of(twist.w_radps);
}

std::string text_of(const SensorStep& step) {
  if (step.state != SensorState::observation)
    return (step.state == SensorState::fault ? "fault: " : "end of data: ") + step.reason;
  const Observation& seen = step.observation;
  std::string text = "at " + text_of(seen.stamp_s) + " s odometry " + text_of(seen.T_odom_robot);
  if (seen.compass_rad) text += " compass " + text_of(*seen.compass_rad);
  if (seen.bumped) text += " bumped";
  if (seen.battery_ratio) text += " battery " + text_of(*seen.battery_ratio);
  for (const RangeReading& r : seen.ranges)
    text += "\n  sensor " + std::to_string(r.sensor) + " at " + text_of(r.T_robot_sensor) + " half beam " +
            text_of(r.half_beam_rad) + " from " + text_of(r.min_m) + " to " + text_of(r.max_m) + ": " +
            text_of(r.range_m);
  return text;
}

std::string text_of(const PoseEstimate& estimate) {
  std::string text = text_of(estimate.T_map_robot) + " covariance";
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) text += " " + text_of(estimate.covariance(row, column));
  return text;
}

std::string text_of(const DetectionReport& report) {
  std::string text = std::to_string(report.matchings.size()) + " matchings";
  for (const Matching& matching : report.matchings) {
    text += "\n  trigger " + text_of(matching.trigger) + " cells " + std::to_string(matching.region_cells);
    for (const CategoryDegree& d : matching.degrees)
      text += "\n    " + d.category + " " + text_of(d.degree) + " turned " + text_of(d.orientation_rad) + " at (" +
              text_of(d.at_m.x()) + ", " + text_of(d.at_m.y()) + ")";
    if (!matching.detection) continue;
    text += "\n    found " + matching.detection->category + " at " + text_of(matching.detection->T_map_landmark) +
            " degree " + text_of(matching.detection->degree);
    for (const TemplateDegree& t : matching.detection->templates)
      text += "\n      " + t.category + " turned " + text_of(t.orientation_rad) + " " + text_of(t.degree);
  }
  return text;
}

std::string text_of(const PlanResult& result) {
  std::string text = std::string(name_of(result.outcome)) + ": " + result.reason + "\n  cost " +
                     text_of(result.cost_m) + " length " + text_of(result.length_m) + " clearance " +
                     text_of(result.clearance_m) + " settled " + std::to_string(result.settled) + "\n  landmarks";
  for (const LandmarkId id : result.landmarks) text += " L" + std::to_string(id);
  text += " routes";
  for (const RouteId id : result.routes) text += " R" + std::to_string(id);
  text += " blocked";
  for (const RouteId id : result.blocked_routes) text += " R" + std::to_string(id);
  for (const Pose2& pose : result.path) text += "\n  " + text_of(pose);
  return text;
}

std::string text_of(const PathResult& result) {
  std::string text = std::string(name_of(result.outcome)) + ": " + result.reason + "\n  cost " +
                     text_of(result.cost_m) + " length " + text_of(result.length_m) + " clearance " +
                     text_of(result.clearance_m) + " from L" + std::to_string(result.from_landmark) + " to L" +
                     std::to_string(result.to_landmark);
  for (const Pose2& pose : result.path) text += "\n  " + text_of(pose);
  return text;
}

std::string text_of(const RouteResult& result) {
  std::string text = std::string(name_of(result.outcome)) + ": " + result.reason + "\n  cost " +
                     text_of(result.cost_m) + " settled " + std::to_string(result.settled) + "\n  landmarks";
  for (const LandmarkId id : result.landmarks) text += " L" + std::to_string(id);
  text += " routes";
  for (const RouteId id : result.routes) text += " R" + std::to_string(id);
  for (const RouteAlternative& other : result.alternatives) {
    text += "\n  or, cost " + text_of(other.cost_m);
    for (const RouteId id : other.routes) text += " R" + std::to_string(id);
  }
  return text;
}

std::string text_of(const Status& status) {
  const char* const word = status.state == StepState::running   ? "running: "
                           : status.state == StepState::success ? "success: "
                                                                : "failure: ";
  return word + status.reason;
}

std::string text_of(Cell cell) {
  return "(" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ")";
}

}  // namespace cairn::conformance

#include "framework/program/mission/status_json.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace cairn {
namespace {

using nlohmann::ordered_json;

double status_rounded(double value) {
  return std::round(value * 1e3) / 1e3;
}

ordered_json status_number(double value) {
  return std::isfinite(value) ? ordered_json(status_rounded(value)) : ordered_json(nullptr);
}

}  // namespace

ordered_json json_of(const RunStatus& status) {
  const TimeLeft none{0.0, std::numeric_limits<double>::infinity(), {""}};
  const TimeLeft& left = status.left ? *status.left : none;
  const bool is_known = left.without.empty() || left.about_s > 0.0;
  return {{"mission", status.mission},
          {"state", std::string(name_of(status.state))},
          {"step", status.step},
          {"steps", status.steps},
          {"step_name", status.step_name},
          {"node", status.node},
          {"doing", status.doing},
          {"time_s", status_rounded(status.time_s)},
          {"paused_s", status_rounded(status.paused_s)},
          {"explored_ratio", status_rounded(status.explored_ratio)},
          {"pose",
           {{"x_m", status_rounded(status.T_map_robot.x_m)},
            {"y_m", status_rounded(status.T_map_robot.y_m)},
            {"angle_deg", status_rounded(degrees(status.T_map_robot.theta_rad))},
            {"trust", std::string(name_of(status.trust))}}},
          {"distance_m", status_rounded(status.distance_m)},
          {"landmarks", status.landmarks},
          {"eta_s", is_known && status.left ? ordered_json(status_rounded(left.about_s)) : ordered_json(nullptr)},
          {"eta_without", status.left ? left.without : std::vector<std::string>{}},
          {"eta_at_most_s", status_number(left.max_s)},
          {"outcome", status.outcome},
          {"reason", status.reason},
          {"map", status.map_file}};
}

}  // namespace cairn

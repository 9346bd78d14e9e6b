#include <string>

#include "framework/contracts/module.hpp"

namespace cairn {

std::string_view name_of(PluginKind kind) {
  switch (kind) {
    case PluginKind::sensor:
      return "sensor";
    case PluginKind::localizer:
      return "localizer";
    case PluginKind::map:
      return "map";
    case PluginKind::detector:
      return "detector";
    case PluginKind::planner:
      return "planner";
    case PluginKind::behaviour:
      return "behaviour";
    case PluginKind::path_planner:
      return "path_planner";
    case PluginKind::route_planner:
      return "route_planner";
    case PluginKind::controller:
      return "controller";
    case PluginKind::marker_detector:
      return "marker_detector";
    case PluginKind::loop_closer:
      return "loop_closer";
  }
  return "?";
}

std::string_view name_of(PlanOutcome outcome) {
  switch (outcome) {
    case PlanOutcome::solved:
      return "solved";
    case PlanOutcome::approximate:
      return "approximate";
    case PlanOutcome::start_blocked:
      return "start_blocked";
    case PlanOutcome::goal_blocked:
      return "goal_blocked";
    case PlanOutcome::no_route:
      return "no_route";
    case PlanOutcome::out_of_budget:
      return "out_of_budget";
    case PlanOutcome::cancelled:
      return "cancelled";
    case PlanOutcome::unknown_place:
      return "unknown_place";
    case PlanOutcome::unsupported:
      return "unsupported";
  }
  return "?";
}

std::string_view name_of(PathSegment::Origin origin) {
  switch (origin) {
    case PathSegment::Origin::stored:
      return "stored";
    case PathSegment::Origin::straight:
      return "straight";
    case PathSegment::Origin::planned:
      return "planned";
    case PathSegment::Origin::cut:
      return "cut";
    case PathSegment::Origin::escape:
      return "escape";
  }
  return "?";
}

std::string_view name_of(ControlState state) {
  switch (state) {
    case ControlState::following:
      return "following";
    case ControlState::blocked:
      return "blocked";
    case ControlState::arrived:
      return "arrived";
  }
  return "?";
}

std::string text_of(const AbiStamp& stamp) {
  std::string text = std::string("cairn ") + stamp.cairn_version + ", " + stamp.compiler + ", " + stamp.build +
                     ", Eigen alignment " + std::to_string(stamp.eigen_align) + ", sizes";
  for (const std::uint32_t size : stamp.sizes) text += " " + std::to_string(size);
  return text;
}

}  // namespace cairn

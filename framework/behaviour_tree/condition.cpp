#include "framework/behaviour_tree/condition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "framework/behaviour_tree/parameters.hpp"
#include "framework/config/named_category.hpp"
#include "maps/base/text.hpp"
#include "maps/landmarks/marker_id.hpp"

namespace cairn {
namespace {

constexpr double kCountEvery_s = 1.0;
constexpr std::string_view kNearest = "nearest ";

// As `goto` takes them, and a bare category.
std::vector<LandmarkId> landmarks_of(const std::string& text, const LandmarkGraph& graph) {
  if (text.starts_with(kNearest)) return graph.of_category(text.substr(kNearest.size()));
  if (const Landmark* landmark = graph.find_by_name(text)) return {landmark->id};
  return graph.of_category(text);
}

Status answer(bool holds, std::string reason) {
  return {holds ? StepState::success : StepState::failure, std::move(reason)};
}

Status known(const std::string& landmark, const LandmarkGraph& graph) {
  const std::vector<LandmarkId> found = landmarks_of(landmark, graph);
  if (found.empty()) return answer(false, "no landmark \"" + landmark + "\" is known");
  return answer(true, label_of(*graph.find(found.front())) + " is known");
}

Status at_place(const Condition& condition, const WorldView& world) {
  if (world.pose.trust == PoseTrust::lost) return answer(false, "the robot does not know where it is");
  std::vector<Point> places;
  if (condition.at_m) places.push_back(*condition.at_m);
  if (!condition.at_m)
    for (const LandmarkId id : landmarks_of(condition.landmark, world.graph))
      places.push_back(world.graph.find(id)->T_map_landmark.position());
  if (places.empty()) return known(condition.landmark, world.graph);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Point& place : places) nearest_m = std::min(nearest_m, (place - world.pose.T_map_robot.position()).norm());
  return answer(nearest_m <= condition.number, fmt::format("{:.2f} m away", nearest_m));
}

Status battery_above(double ratio, const WorldView& world) {
  if (world.observation == nullptr || !world.observation->battery_ratio)
    return answer(false, "the sensor reports no battery");
  const double left = *world.observation->battery_ratio;
  return answer(left > ratio, fmt::format("{:.1f} % of the battery is left", 100.0 * left));
}

}  // namespace

std::vector<ConfigError> unknown_categories(const std::vector<TreeNode>& steps,
                                            const std::vector<std::string>& categories) {
  std::vector<ConfigError> errors;
  for (const TreeNode& node : steps) {
    const ConfigValue& settings = node.choice.config;
    const ConfigValue* const landmark =
        settings.kind == ConfigValue::Kind::scalar ? &settings : settings.find("landmark");
    try {
      if (is_condition(node.kind) && landmark != nullptr) {
        check_named_categories(*landmark, node.choice.name, categories);
        if (const std::string fault = marker_name_fault(landmark->scalar); !fault.empty())
          throw ConfigError(landmark->place, node.choice.name + ": " + in_quotes(landmark->scalar) + ": " + fault);
      }
    } catch (const ConfigError& error) {
      errors.push_back(with_place_of_use(error, settings, node.place));
    }
    std::ranges::move(unknown_categories(node.children, categories), std::back_inserter(errors));
  }
  return errors;
}

Status ConditionCheck::operator()(const TreeNode& node, const WorldView& world) {
  const Condition& condition = node.condition;
  switch (node.kind) {
    case NodeKind::landmark_known:
      return known(condition.landmark, world.graph);
    case NodeKind::explored: {
      const double ratio = explored_ratio(world);
      return answer(ratio >= condition.number, fmt::format("{:.1f} % explored", 100.0 * ratio));
    }
    case NodeKind::time_before:
      return answer(world.time_s < condition.number, fmt::format("{:.1f} s have passed", world.time_s));
    case NodeKind::time_after:
      return answer(world.time_s >= condition.number, fmt::format("{:.1f} s have passed", world.time_s));
    case NodeKind::battery_above:
      return battery_above(condition.number, world);
    default:
      return at_place(condition, world);
  }
}

double ConditionCheck::explored_ratio(const WorldView& world) {
  if (world.time_s < counted_s_ + kCountEvery_s) return ratio_;
  counted_s_ = world.time_s;
  ratio_ = known_ratio(world.grid);
  return ratio_;
}

}  // namespace cairn

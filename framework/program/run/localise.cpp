#include "framework/program/run/localise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>

#include "framework/config/coordinates.hpp"
#include "framework/mission/modules.hpp"
#include "maps/base/text.hpp"
#include "maps/store/repair.hpp"

namespace cairn {
namespace {

Pose2 pose_of(const std::string& text) {
  const std::vector<double> numbers = coordinates_in(text).value_or(std::vector<double>{});
  const bool are_finite = std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
  if (numbers.size() != 3 || !are_finite)
    throw std::runtime_error("--pose: " + in_quotes(text) + " is not X,Y,DEGREES, such as 1.5,-2,90");
  return {numbers[0], numbers[1], wrap_angle(radians(numbers[2]))};
}

}  // namespace

std::optional<Pose2> pose_given(const RunCommand& command) {
  if (command.pose.empty()) return std::nullopt;
  if (command.localise_in.empty() && command.resume.empty())
    throw std::runtime_error("--pose is a place in a map: it goes with --localize-in or --resume");
  return pose_of(command.pose);
}

SavedMap load_map_to_work_with(const std::filesystem::path& file) {
  try {
    return load_map(file);
  } catch (const StoreError& error) {
    std::optional<SavedMap> map = map_without_damaged_submaps(file);
    if (!map) throw;
    std::cerr << error.what()
              << "; nothing else is damaged: the run does without the submaps (`cairn map repair` "
                 "keeps those that are whole)\n";
    return *std::move(map);
  }
}

std::optional<MapToLocaliseIn> map_to_localise_in(const RunCommand& command) {
  if (command.localise_in.empty()) return std::nullopt;
  return MapToLocaliseIn{load_map_to_work_with(command.localise_in), pose_given(command)};
}

void begin_with_finding_itself(Mission& mission) {
  const std::vector<const TreeNode*> behaviours = behaviours_of(mission.steps);
  const auto finds = [](const TreeNode* node) { return node->choice.name == kFindMyself; };
  if (behaviours.empty() || std::ranges::any_of(behaviours, finds)) return;
  TreeNode node;
  node.name = kFindMyself;
  node.choice.name = kFindMyself;
  node.choice.config.kind = ConfigValue::Kind::map;
  node.choice.config.place = mission.config.steps.place;
  node.place = mission.config.steps.place;
  node.path = "0";  // before the first step of the file
  mission.steps.insert(mission.steps.begin(), std::move(node));
}

std::string trust_text(const LocalisationFigures& figures) {
  if (figures.is_pose_given) return "tracking: the pose was given";
  if (!figures.found_s)
    return fmt::format("lost: after {:.1f} m and {}, {} fit", figures.driven_m, counted(figures.searches, "look"),
                       counted(figures.guesses.size(), "place"));
  const Pose2& at = figures.T_map_robot;
  return fmt::format("tracking: found itself after {:.1f} m, at {:.0f} s, at ({:.2f}, {:.2f}) m, {:.0f} degrees",
                     figures.driven_m, *figures.found_s, at.x_m, at.y_m, degrees(at.theta_rad));
}

}  // namespace cairn

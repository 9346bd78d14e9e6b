#include "framework/mission/resume.hpp"

#include <fmt/format.h>

#include "framework/behaviour_tree/tree_text.hpp"
#include "framework/mission/saved_content.hpp"
#include "maps/base/fingerprint.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

constexpr const char* kTreeProperty = "tree";
constexpr const char* kPausedProperty = "paused_s";
constexpr double kMaxPaused_s = 1e8;

std::string property(const SavedMap& map, const std::string& key) {
  const auto found = map.properties.find(key);
  return found == map.properties.end() ? "" : found->second;
}

void require_same(const SavedMap& map, const std::string& key, const std::string& wanted, const char* what) {
  if (const std::string found = property(map, key); found != wanted)
    throw StoreError(fmt::format("cannot go on with this mission: the map was made {} \"{}\", the mission's is \"{}\"",
                                 what, found, wanted));
}

void require_same_steps(const MissionProgress& progress, const std::vector<TreeNode>& steps) {
  const auto step = static_cast<std::size_t>(progress.step);
  const std::string here = step < steps.size() ? steps[step].name : "";
  if (step <= steps.size() && progress.step_name == here) return;
  const auto called = [](const std::string& name) { return name.empty() ? std::string("the end") : name; };
  throw StoreError(
      fmt::format("cannot go on with this mission: the map was saved at step {}, {}; in this mission "
                  "there comes {}",
                  step + 1, called(progress.step_name), called(here)));
}

}  // namespace

std::int64_t seed_of(const SavedMap& map) {
  const auto seed = number_from<std::int64_t>(property(map, "seed"));
  if (!seed) throw StoreError("cannot be resumed: it does not say with which seed it was made");
  return *seed;
}

void check_resumable(const SavedMap& map, const Mission& mission) {
  if (!map.progress)
    throw StoreError(
        "cannot be resumed: it does not say how far a mission had come (only maps that `cairn run` "
        "has saved do)");
  const std::map<std::string, std::string> wanted = properties_of(mission);
  require_same(map, "mission", wanted.at("mission"), "by mission");
  require_same(map, "robot", wanted.at("robot"), "with robot");
  require_same(map, "robot_radius_m", wanted.at("robot_radius_m"), "with a robot radius, in metres, of");
  require_same(map, "seed", wanted.at("seed"), "with seed");
  require_same_steps(*map.progress, mission.steps);
}

void check_same_world(const SavedMap& map, const Mission& mission) {
  const std::string made_in = property(map, "world");
  if (made_in.empty() || made_in == mission.world_fingerprint) return;
  throw StoreError(
      fmt::format("cannot go on with this mission: the map was made in another world than {} is now "
                  "(--other-world goes on all the same)",
                  mission.config.world.empty() ? "none" : mission.config.world.string()));
}

std::string tree_fingerprint(const TreeNode& step) {
  return fingerprint_of(tree_text({step}));
}

void add_tree(SavedMap& map, const SavedTree& tree) {
  map.properties[kTreeProperty] = tree.fingerprint;
  map.properties[kTreeStateProperty] = text_of(tree.state);
}

std::optional<SavedTree> saved_tree(const SavedMap& map) {
  const std::string text = property(map, kTreeStateProperty);
  if (text.empty()) return std::nullopt;
  try {
    return SavedTree{property(map, kTreeProperty), tree_state_of(text)};
  } catch (const std::invalid_argument& error) {
    throw StoreError(fmt::format("cannot be resumed: its property {}: {}", kTreeStateProperty, error.what()));
  }
}

void add_pauses(SavedMap& map, double paused_s) {
  if (paused_s > 0.0) map.properties[kPausedProperty] = fmt::format("{}", paused_s);
}

double paused_before(const SavedMap& map) {
  const std::string text = property(map, kPausedProperty);
  if (text.empty()) return 0.0;
  const auto paused_s = number_from<double>(text);
  if (!paused_s || !(*paused_s >= 0.0 && *paused_s <= kMaxPaused_s))
    throw StoreError(fmt::format("cannot be resumed: its property {} is {}, not a time in seconds", kPausedProperty,
                                 in_quotes(text)));
  return *paused_s;
}

void check_same_cells(const OccupancyGrid& saved, const OccupancyGrid& of_mission) {
  if (saved.cell_m() != of_mission.cell_m())
    throw StoreError(fmt::format("cannot go on with this mission: the map has cells of {} m, the mission's of {} m",
                                 saved.cell_m(), of_mission.cell_m()));
  if (saved.origin_m() != of_mission.origin_m() || saved.clamp_quanta() != of_mission.clamp_quanta())
    throw StoreError(
        fmt::format("cannot go on with this mission: the map's grid begins at ({}, {}) m and is clamped at {} nat, the "
                    "mission's at "
                    "({}, {}) m and {} nat",
                    saved.origin_m().x(), saved.origin_m().y(), saved.clamp_nat(), of_mission.origin_m().x(),
                    of_mission.origin_m().y(), of_mission.clamp_nat()));
}

}  // namespace cairn

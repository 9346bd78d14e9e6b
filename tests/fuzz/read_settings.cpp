// Settings are read from a folder in which the files that they may name are there under fixed names.
#include <cmath>
#include <vector>

#include "framework/experiments/config.hpp"
#include "framework/files/robot_file.hpp"
#include "framework/files/template_file.hpp"
#include "framework/files/world_file.hpp"
#include "framework/mission/mission.hpp"
#include "tests/fuzz/scratch.hpp"

namespace cairn::fuzz {
namespace {

constexpr std::string_view kRobot = "{name: fuzzed, radius_m: 0.2, sonars: [{x_m: 0, y_m: 0, angle_deg: 0}]}";
constexpr std::string_view kWorld = "{bounds_m: [[0, 0], [6, 5]], objects: [{template: square, at_m: [2, 2]}]}";
constexpr std::string_view kSubMission = "{parameters: {where: , wait_s: 2}, steps: [goto: $where, wait: $wait_s]}";
constexpr std::string_view kSquare =
    "{category: square, polygon_m: [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]]}";

// The parts between bytes 0.
std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find('\0');
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

template <class Read>
void unless_refused(Read read) {
  try {
    read();
  } catch (const ConfigError&) {
  }
}

void check(const Contour& contour) {
  promise(contour.outer_diameter_m() > 0.0 && std::isfinite(contour.outer_diameter_m()), "a contour has a size");
}

void check(const RobotModel& robot) {
  promise(robot.radius_m > 0.0 && std::isfinite(robot.radius_m), "a robot has a radius");
  for (const int sonar : robot.firing_order)
    promise(sonar >= 0 && static_cast<std::size_t>(sonar) < robot.sonars.size(), "only sonars that are there fire");
}

void check(const World& world) {
  promise((world.max_m - world.min_m).minCoeff() > 0.0, "a world has a size");
  for (const WorldObject& object : world.objects) check(object.contour);
}

const std::vector<LandmarkShape>& shapes() {
  static const std::vector<LandmarkShape> kept{load_landmark_shape(scratch_file("square.yaml", kSquare))};
  return kept;
}

void check(const TreeNode& node, std::size_t depth) {
  promise(depth <= kMaxTreeDepth, "a tree is not too deep");
  promise(is_leaf(node.kind) == node.children.empty(), "leaves and nothing else have no children");
  promise(node.kind != NodeKind::parallel || (node.succeed_at >= 1 && node.succeed_at <= node.children.size()),
          "a parallel can succeed");
  promise(node.kind != NodeKind::timeout || node.after_s > 0.0, "a timeout takes time");
  for (const TreeNode& child : node.children) check(child, depth + 1);
}

// Next to the mission: robot.yaml, world.yaml, the sub-mission sub.yaml and the folder templates.
void furnish() {
  if (std::filesystem::exists(scratch() / "templates")) return;
  std::filesystem::create_directory(scratch() / "templates");
  scratch_file("templates/square.yaml", kSquare);
  scratch_file("robot.yaml", kRobot);
  scratch_file("world.yaml", kWorld);
  scratch_file("sub.yaml", kSubMission);
}

}  // namespace

void read_yaml(Input input) {
  const std::vector<std::string_view> parts = parts_of(text_of(input));
  unless_refused([&] {
    ConfigValue root = parse_config_text(std::string(parts.front()), "fuzzed");
    for (std::size_t i = 1; i < parts.size(); ++i) apply_override(root, std::string(parts[i]));
    static_cast<void>(resolve_path(root));
  });
}

void read_mission(Input input) {
  furnish();
  const std::vector<std::string_view> parts = parts_of(text_of(input));
  const std::filesystem::path file = scratch_file("mission.yaml", parts.front());
  const std::vector<std::string> overrides(parts.begin() + 1, parts.end());
  unless_refused([&] {
    const Mission mission = load_mission(file, overrides);
    check(mission.robot);
    if (mission.world) check(*mission.world);
    promise(count_nodes(mission.steps) <= kMaxTreeNodes, "a tree is not too large");
    for (const TreeNode& step : mission.steps) check(step, 1);
    promise(mission.config.mission.find_first_of(std::string_view("/\0", 2)) == std::string::npos,
            "a mission's name stays in the output folder");
  });
}

void read_world(Input input) {
  const std::filesystem::path file = scratch_file("fuzzed_world.yaml", text_of(input));
  unless_refused([&] { check(load_world(file, shapes())); });
}

void read_template(Input input) {
  const std::string_view text = text_of(input);
  const std::size_t end = std::min(text.find('\0'), text.size());
  const std::filesystem::path file = scratch_file("fuzzed_template.yaml", text.substr(0, end));
  scratch_file("picture.png", text.substr(std::min(end + 1, text.size())));
  unless_refused([&] { check(load_landmark_shape(file).contour); });
}

void read_robot(Input input) {
  const std::filesystem::path file = scratch_file("fuzzed_robot.yaml", text_of(input));
  unless_refused([&] { check(load_robot(file)); });
}

void read_experiment(Input input) {
  const std::filesystem::path file = scratch_file("experiment.yaml", text_of(input));
  unless_refused([&] {
    const ExperimentConfig config = load_experiment(file);
    promise(!config.missions.empty() && !config.variants.empty(), "an experiment has missions and variants");
  });
}

}  // namespace cairn::fuzz

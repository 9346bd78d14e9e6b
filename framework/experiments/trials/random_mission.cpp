#include "framework/experiments/trials/random_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "framework/experiments/trials/true_space.hpp"
#include "maps/base/portable_random.hpp"
#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

enum Purpose : std::uint64_t { kSteps = 1, kBattery, kFirstFault = 10 };  // of streams of chance
constexpr int kGoalTries = 10000;
constexpr double kFaultsFor_s = 3600.0;
constexpr double kFromMover_m = 1.0;
constexpr double kDeafFor_s = 30.0;  // on average

// As YAML takes any path.
std::string yaml_quoted(const std::filesystem::path& path) {
  std::string text = path.string();
  for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 2) text.insert(at, 1, '\'');
  return "'" + text + "'";
}

class Drawing {
 public:
  Drawing(const TrialsConfig& config, const RobotModel& robot, const World& world, std::uint64_t seed)
      : config_(config),
        robot_(robot),
        world_(world),
        space_(world, robot.radius_m + config.clearance_m),
        seed_(seed),
        chance_(seed, kSteps) {}

  std::string start();
  std::string sensor();
  std::string steps();

 private:
  Point anywhere();
  Point with_room();
  Point place() { return chance_.share() < config_.anywhere_ratio ? anywhere() : with_room(); }
  [[nodiscard]] bool is_clear_of_traffic(const Point& p_m) const;
  std::string fault_lines();
  std::string fault(const std::string& kind, PortableRandom& chance);
  std::string deaf_part(PortableRandom& chance);
  std::string go_to_place();
  std::string go_to_landmark();
  std::string places();
  std::string goal();
  std::string step();

  const TrialsConfig& config_;
  const RobotModel& robot_;
  const World& world_;
  TrueSpace space_;
  std::uint64_t seed_;
  PortableRandom chance_;
};

Point Drawing::anywhere() {
  const double x_m = chance_.between(world_.min_m.x(), world_.max_m.x());
  return {x_m, chance_.between(world_.min_m.y(), world_.max_m.y())};
}

Point Drawing::with_room() {
  for (int t = 0; t < kGoalTries; ++t)
    if (Point p_m = anywhere(); space_.has_room(p_m)) return p_m;
  throw ConfigError({robot_.name, 0, 0}, fmt::format("the robot and {:g} m beside it have room nowhere in the random "
                                                     "world of seed {}",
                                                     config_.clearance_m, seed_));
}

bool Drawing::is_clear_of_traffic(const Point& p_m) const {
  const auto near_door = [&](const WorldDoor& door) {
    return distance_to_segment_m(p_m, door.from_m, door.to_m) < robot_.radius_m + config_.clearance_m;
  };
  const auto near_mover = [&](const WorldMover& mover) { return (mover.path_m.front() - p_m).norm() < kFromMover_m; };
  return std::ranges::none_of(world_.doors, near_door) && std::ranges::none_of(world_.movers, near_mover);
}

std::string Drawing::start() {
  Point at_m = with_room();
  for (int t = 0; t < kGoalTries && !is_clear_of_traffic(at_m); ++t) at_m = with_room();
  return fmt::format("{{at_m: [{:.3f}, {:.3f}], angle_deg: {:.1f}}}", at_m.x(), at_m.y(), chance_.between(0.0, 360.0));
}

// The settings of a fault but for its time.
std::string Drawing::fault(const std::string& kind, PortableRandom& chance) {
  const int sonars = static_cast<int>(robot_.sonars.size());
  const std::string lasting = fmt::format("for_s: {:g}, ", config_.fault_for_s);
  if (kind == "dead") return fmt::format("{}dead: [{}]", lasting, chance.whole(0, sonars - 1));
  if (kind == "stuck") return fmt::format("{}stuck: {{sonar: {}}}", lasting, chance.whole(0, sonars - 1));
  if (kind == "slip") {
    const std::array wheels{"left", "right", "both"};
    const char* wheel = wheels[static_cast<std::size_t>(chance.whole(0, 2))];
    return fmt::format("{}slip: {{wheel: {}, ratio: {:.2f}}}", lasting, wheel, chance.between(0.1, 0.9));
  }
  if (kind == "compass_jump") return fmt::format("{}compass_jump_deg: {:.1f}", lasting, chance.between(-90.0, 90.0));
  if (kind == "silent") return lasting + "silent: true";
  if (kind == "deaf") return deaf_part(chance);
  const Point to_m = with_room();
  return fmt::format("kidnap: {{to_m: [{:.3f}, {:.3f}], angle_deg: {:.1f}}}", to_m.x(), to_m.y(),
                     chance.between(0.0, 360.0));
}

// The whole ring, a half, or about half of it; for kDeafFor_s on average.
std::string Drawing::deaf_part(PortableRandom& chance) {
  const std::string lasting = fmt::format("for_s: {:.1f}, ", chance.wait(1.0 / kDeafFor_s));
  const std::array parts{"whole", "left", "right"};
  const int part = chance.whole(0, 3);
  if (part < 3) return lasting + "deaf: " + parts[static_cast<std::size_t>(part)];
  std::string sonars;
  for (std::size_t i = 0; i < robot_.sonars.size(); ++i)
    if (chance.share() < 0.5) sonars += (sonars.empty() ? "" : ", ") + std::to_string(i);
  return lasting + (sonars.empty() ? "deaf: whole" : "dead: [" + sonars + "]");
}

std::string Drawing::fault_lines() {
  const FaultRates& rates = config_.faults_per_hour;
  const std::array<std::pair<const char*, double>, 7> kinds{{{"dead", rates.dead},
                                                             {"stuck", rates.stuck},
                                                             {"slip", rates.slip},
                                                             {"compass_jump", rates.compass_jump},
                                                             {"silent", rates.silent},
                                                             {"kidnap", rates.kidnap},
                                                             {"deaf", rates.deaf}}};
  std::string text;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const auto& [kind, per_hour] = kinds[i];
    const bool needs_sonars = i < 2 || i == 6;
    if (per_hour <= 0.0 || (needs_sonars && robot_.sonars.empty())) continue;
    PortableRandom chance(seed_, kFirstFault + i);
    for (double at_s = chance.wait(per_hour / 3600.0); at_s < kFaultsFor_s; at_s += chance.wait(per_hour / 3600.0))
      text += fmt::format("    - {{at_s: {:.2f}, {}}}\n", at_s, fault(kind, chance));
  }
  return text.empty() ? text : "  faults:\n" + text;
}

std::string Drawing::sensor() {
  std::string text = "  plugin: simulated_robot\n";
  PortableRandom chance(seed_, kBattery);
  const bool empties = chance.share() < config_.battery_ratio;
  const double lasts_s = chance.between(300.0, 1200.0);
  if (empties) text += fmt::format("  battery: {{standing_s: {:.0f}, driving_s: {:.0f}}}\n", 2.0 * lasts_s, lasts_s);
  return text + fault_lines();
}

std::string Drawing::go_to_place() {
  const Point at_m = place();
  return fmt::format("goto: {{at_m: [{:.2f}, {:.2f}], at_most_s: {:g}}}", at_m.x(), at_m.y(), config_.goal_at_most_s);
}

std::string Drawing::go_to_landmark() {
  std::vector<std::string> categories;
  for (const WorldObject& object : world_.objects)
    if (!object.category.empty()) categories.push_back(object.category);
  if (categories.empty()) return go_to_place();
  const std::string& category =
      categories[static_cast<std::size_t>(chance_.whole(0, static_cast<int>(categories.size()) - 1))];
  // Who wants to go to one looks for it first: search is done at once where one is known.
  return fmt::format(
      "sequence: [{{force_success: {{search: {{category: {}, at_most_s: {:g}}}}}}}, {{goto: {{landmark: nearest {}, "
      "at_most_s: {:g}}}}}]",
      category, config_.goal_at_most_s, category, config_.goal_at_most_s);
}

// The settings of two or three of them.
std::string Drawing::places() {
  std::string text = "places: [";
  const int count = chance_.whole(2, 3);
  for (int i = 0; i < count; ++i) {
    const Point at_m = with_room();
    text += fmt::format("{}[{:.2f}, {:.2f}]", i == 0 ? "" : ", ", at_m.x(), at_m.y());
  }
  return text + (chance_.share() < 0.5 ? "], order: given" : "], order: shortest");
}

std::string Drawing::goal() {
  const double kind = chance_.share();
  if (kind < 0.65) return go_to_place();
  if (kind < 0.85) return go_to_landmark();
  return "tour: {" + places() + fmt::format(", at_most_s: {:g}}}", 2.0 * config_.goal_at_most_s);
}

// One or more goals under a node.
std::string Drawing::step() {
  const double after_s = 1.5 * config_.goal_at_most_s;
  switch (chance_.whole(0, 8)) {
    case 0:
      return "sequence: [{" + goal() + "}, {wait: 2}]";
    case 1:
      return "force_success: {retry: {times: 2, do: {" + goal() + "}}}";
    case 2:
      return fmt::format("force_success: {{timeout: {{after_s: {:g}, do: {{{}}}}}}}", after_s, goal());
    case 3:
      return fmt::format("force_success: {{retry: {{times: 2, do: {{timeout: {{after_s: {:g}, do: {{{}}}}}}}}}}}",
                         after_s, goal());
    case 4: {
      const std::string first = goal();
      return "force_success: {fallback: [{" + first + "}, {" + go_to_place() + "}, {wait: 5}]}";
    }
    case 5:
      return "force_success: {reactive_sequence: [{time_before: 3000}, {" + goal() + "}]}";
    case 6: {
      const std::string first = go_to_place();
      return "force_success: {repeat: {times: 2, do: [{" + first + "}, {" + go_to_place() + "}]}}";
    }
    case 7:
      return fmt::format("force_success: {{timeout: {{after_s: {:g}, do: {{patrol: {{rounds: 2, {}}}}}}}}}",
                         3.0 * config_.goal_at_most_s, places());
    default:
      return "force_success: {" + goal() + "}";
  }
}

std::string Drawing::steps() {
  std::string text = fmt::format("  - force_success: {{explore: {{until_known_ratio: 0.97, at_most_s: {:g}}}}}\n",
                                 config_.explore_at_most_s);
  const int goals = chance_.whole(config_.min_goals, std::max(config_.min_goals, config_.max_goals));
  for (int i = 0; i < goals; ++i) {
    text += "  - " + step() + "\n";
    if (chance_.share() < 0.2) text += fmt::format("  - wait: {:.1f}\n", chance_.between(1.0, 20.0));
  }
  return text + fmt::format("  - force_success: {{return_home: {{at_most_s: {:g}}}}}\n", config_.goal_at_most_s);
}

}  // namespace

std::string random_mission_yaml(const TrialsConfig& config, const MissionFiles& files, const RobotModel& robot,
                                const World& world, std::uint64_t seed) {
  Drawing drawing(config, robot, world, seed);
  const std::string start = drawing.start();
  std::string text = fmt::format("# Random mission {}.\nmission: trial\nseed: {}\nrobot: {}\nworld: {}\n", seed, seed,
                                 yaml_quoted(files.robot), yaml_quoted(files.world));
  text += "start: " + start + "\nsensor:\n" + drawing.sensor();
  text += fmt::format(
      "localizer: {{plugin: odometry_compass}}\nmap: {{plugin: muriel, cell_m: 0.05, false_echo_per_m: 2}}\n"
      "detector:\n  {{plugin: template_matcher, templates: {}, sizes: [1, 1.07], coarse_cells: 5, degrees: "
      "above_threshold}}\n"
      "planner: {{plugin: hybrid, route: {{plugin: ompl}}}}\nat_most_s: 7200\nsteps:\n",
      yaml_quoted(files.templates));
  return text + drawing.steps();
}

}  // namespace cairn

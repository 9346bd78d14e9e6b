#include "plugins/behaviours/errands/go_to.hpp"

#include <algorithm>
#include <cstdio>

#include "plugins/behaviours/errands/place_name.hpp"
#include "plugins/common/motion/path.hpp"

namespace cairn::behaviours {
namespace {

constexpr std::size_t kMaxNamed = 12;
const std::string kNearest = "nearest ";

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMaxNamed); ++i) text += (i == 0 ? "" : ", ") + names[i];
  return text + (names.size() > kMaxNamed ? ", ..." : "");
}

std::string known_landmarks(const LandmarkGraph& graph) {
  std::vector<std::string> names;
  for (const auto& [id, landmark] : graph.landmarks())
    names.push_back(label_of(landmark) + (landmark.category.empty() ? "" : " (" + landmark.category + ")"));
  return names.empty() ? "the map holds no landmark" : "the map holds " + list_of(names);
}

NamedLandmarks nearest_of(const std::string& category, const LandmarkGraph& graph) {
  NamedLandmarks named{graph.of_category(category), ""};
  if (!named.ids.empty()) return named;
  std::vector<std::string> categories;
  for (const auto& [id, landmark] : graph.landmarks()) categories.push_back(landmark.category);
  named.unknown = "no landmark of category \"" + category + "\"" + did_you_mean(category, categories) + "; " +
                  known_landmarks(graph);
  return named;
}

}  // namespace

void GoToConfig::describe(Fields<GoToConfig>& fields) {
  using C = GoToConfig;
  fields.raw("landmark", &C::landmark, "text",
             "where to go: a landmark's id (L3) or name, or `nearest CATEGORY`; this, at_m or input");
  fields.point("at_m", &C::at_m, "m", "where to go: a place of the map");
  fields.input("input", &C::input, "where to go: the place that an earlier step gives by `output` under this name");
  fields.angle("angle_deg", &C::angle_rad, {-360.0, 360.0},
               "heading at the end; without it the robot faces the landmark");
  RouteSettings::describe_route(fields);
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "time to get there; when it is up the step has failed");
  fields.shorthand("landmark");
}

NamedLandmarks landmarks_named(const std::string& name, const LandmarkGraph& graph) {
  if (name.starts_with(kNearest)) return nearest_of(name.substr(kNearest.size()), graph);
  if (const Landmark* landmark = graph.find_by_name(name)) return {{landmark->id}, ""};
  std::vector<std::string> labels;
  for (const auto& [id, landmark] : graph.landmarks()) labels.push_back(label_of(landmark));
  return {{}, "no landmark \"" + name + "\"" + did_you_mean(name, labels) + "; " + known_landmarks(graph)};
}

GoTo::GoTo(const GoToConfig& config, std::uint64_t seed) : config_(config), seed_(seed), driver_(config, seed) {
  const bool names_landmark = config.landmark.kind != ConfigValue::Kind::null;
  if (config.landmark.kind == ConfigValue::Kind::list)
    throw ConfigError(config.landmark.place, "goto: landmark must be text; a place is written `{at_m: [x, y]}`");
  if (names_landmark && config.at_m)
    throw ConfigError(config.landmark.place, "goto: landmark and at_m exclude each other");
  if (!config.input.empty() && (names_landmark || config.at_m))
    throw ConfigError(config.landmark.place, "goto: input takes the place of landmark and at_m; give one of them");
  if (!names_landmark && !config.at_m && config.input.empty())
    throw ConfigError(config.landmark.place,
                      "goto: needs a landmark (`landmark: nearest square`), a place (`at_m: [x, y]`) or the place that "
                      "an earlier step gives (`input: NAME`)");
  if (names_landmark) landmark_name_ = to_landmark_name(config.landmark, "landmark");
}

void GoTo::halt() {
  *this = GoTo(config_, seed_);
}

Status GoTo::tick(const WorldView& world, BehaviourContext& context) {
  if (!begun_s_) begun_s_ = world.time_s;
  if (world.time_s - *begun_s_ >= config_.at_most_s)
    return {Progress::failure, "time is up on the way to " + destination(world)};
  return facing_since_s_ ? face(world, context) : drive_there(world, context);
}

GoTo::FoundGoal GoTo::find_goal(const WorldView& world, BehaviourContext& context) const {
  FoundGoal found;
  if (config_.at_m) {
    found.goal.pose = Pose2{config_.at_m->x(), config_.at_m->y(), config_.angle_rad.value_or(0.0)};
    found.goal.heading_matters = config_.angle_rad.has_value();
  } else if (!config_.input.empty()) {
    const std::optional<Place> given = context.input(config_.input);
    if (!given) return {{}, "no step has given the place \"" + config_.input + "\" yet"};
    found.goal = *given;
    if (names_retired(found.goal, world.graph))
      found.unknown = "of the place \"" + config_.input + "\": " + lost(found.goal.landmarks.front(), world.graph);
  } else {
    NamedLandmarks named = landmarks_named(landmark_name_, world.graph);
    found.goal.landmarks = std::move(named.ids);
    found.unknown = std::move(named.unknown);
  }
  return found;
}

Status GoTo::drive_there(const WorldView& world, BehaviourContext& context) {
  if (goal_ && names_retired(*goal_, world.graph)) goal_.reset();
  if (!goal_) {
    driver_.restart();
    FoundGoal found = find_goal(world, context);
    if (!found.unknown.empty()) return {Progress::failure, found.unknown};
    goal_ = std::move(found.goal);
  }
  const Status status = driver_.tick(*goal_, world, context);
  if (status.progress == Progress::running)
    return {Progress::running, status.reason + ", to " + destination(world), status.left_s};
  if (status.progress == Progress::failure)
    return {Progress::failure, status.reason + "; on the way to " + destination(world)};
  facing_since_s_ = world.time_s;
  return face(world, context);
}

Status GoTo::face(const WorldView& world, BehaviourContext& context) {
  const Pose2& pose = world.pose.T_map_robot;
  const Landmark* landmark = world.graph.find(driver_.goal_landmark());
  double error_rad = 0.0;
  if (config_.angle_rad) {
    error_rad = wrap_angle(*config_.angle_rad - pose.theta_rad);
  } else if (landmark != nullptr) {
    error_rad = motion::heading_error(pose, landmark->T_map_landmark.position());
  }
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  if (!can_turn || std::abs(error_rad) <= config_.driving.face.faced_rad ||
      world.time_s - *facing_since_s_ > config_.driving.face.at_most_s)
    return {Progress::success, "at " + destination(world)};
  const motion::TurnSettings& turn = config_.driving.turn;
  context.drive(motion::turn_by(error_rad, motion::max_turn_radps(world.robot, turn), turn));
  return {Progress::running, "turning to " + destination(world)};
}

std::string GoTo::destination(const WorldView& world) const {
  if (const Landmark* landmark = world.graph.find(driver_.goal_landmark()))
    return label_of(*landmark) + (landmark->category.empty() ? "" : " (" + landmark->category + ")");
  if (!config_.input.empty()) return "the place \"" + config_.input + "\"";
  if (!config_.at_m) return landmark_name_;
  char text[64];
  std::snprintf(text, sizeof text, "(%.2f, %.2f)", config_.at_m->x(), config_.at_m->y());
  return text;
}

}  // namespace cairn::behaviours

#include "plugins/behaviours/errands/return_home.hpp"

#include "plugins/behaviours/places/place_name.hpp"

namespace cairn::behaviours {

void ReturnHomeConfig::describe(Fields<ReturnHomeConfig>& fields) {
  using C = ReturnHomeConfig;
  fields.raw(
      "to", &C::to, "text",
      "a landmark's id (L3) or name, a category, or `nearest CATEGORY`; without it, the pose where the mission began");
  RouteSettings::describe_route(fields);
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "time to get there; when it is up the step has failed");
  fields.shorthand("to");
}

ReturnHome::ReturnHome(const ReturnHomeConfig& config, std::uint64_t seed)
    : config_(config), seed_(seed), driver_(config, seed) {
  if (config.to.kind == ConfigValue::Kind::null) return;
  to_ = to_landmark_name(config.to, "to");
}

void ReturnHome::halt() {
  *this = ReturnHome(config_, seed_);
}

std::string ReturnHome::unknown_place(const WorldView& world, NamedPlaces& /*places*/) const {
  return to_.empty() ? "" : find_landmarks(to_, world).unknown;
}

Status ReturnHome::tick(const WorldView& world, BehaviourContext& context) {
  const std::string home = to_.empty() ? "home at " + described(world.T_map_start.position()) : "home at " + to_;
  if (!begun_s_) begun_s_ = world.time_s;
  if (world.time_s - *begun_s_ >= config_.at_most_s) return {StepState::failure, "time is up on the way " + home};
  if (goal_ && names_retired(*goal_, world.graph)) goal_.reset();
  if (!goal_) {
    driver_.restart();
    Place goal;
    if (to_.empty()) {
      goal.pose = world.T_map_start;
      goal.heading_matters = true;
    } else {
      FoundPlace found = find_landmarks(to_, world);
      if (!found.unknown.empty()) return {StepState::failure, found.unknown};
      goal = std::move(found.place);
    }
    goal_ = goal;
  }
  const Status status = driver_.tick(*goal_, world, context);
  if (status.state == StepState::running) return {StepState::running, status.reason + ", " + home, status.left_s};
  if (status.state == StepState::failure) return {StepState::failure, status.reason + "; on the way " + home};
  return {StepState::success, home};
}

}  // namespace cairn::behaviours

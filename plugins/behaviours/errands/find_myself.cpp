#include "plugins/behaviours/errands/find_myself.hpp"

#include <cmath>
#include <string>

namespace cairn::behaviours {
namespace {

// To the end: it is ended from outside.
ExploreConfig exploring(const FindMyselfConfig& config, bool is_close) {
  ExploreConfig explore = config;
  explore.until_known_ratio = 1.0;
  explore.second_look = is_close && config.second_look;
  if (!is_close) explore.look_closer_m = 0.0;
  return explore;
}

}  // namespace

void FindMyselfConfig::describe(Fields<FindMyselfConfig>& fields) {
  using C = FindMyselfConfig;
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "time to find itself; when it is up the step has failed");
  fields.number("at_most_m", &C::at_most_m, {0.0, 1e6}, "m", "the same, of the distance driven");
  describe_exploring(fields);
}

FindMyself::FindMyself(const FindMyselfConfig& config)
    : config_(config), wide_(exploring(config, false)), close_(exploring(config, true)) {}

void FindMyself::halt() {
  wide_.halt();
  close_.halt();
  is_close_ = false;
  begun_s_.reset();
  driven_m_ = 0.0;
}

std::optional<Status> FindMyself::ended(const WorldView& world) {
  const Point at_m = world.pose.T_map_robot.position();
  if (world.pose.trust != PoseTrust::lost)
    return Status{StepState::success, begun_s_ ? "found itself after " + std::to_string(std::lround(driven_m_)) + " m"
                                               : std::string("knows where it is")};
  if (!begun_s_) {
    begun_s_ = world.time_s;
    at_m_ = at_m;
  }
  driven_m_ += (at_m - at_m_).norm();
  at_m_ = at_m;
  if (world.time_s - *begun_s_ >= config_.at_most_s)
    return Status{StepState::failure,
                  "has not found itself in " + std::to_string(std::lround(config_.at_most_s)) + " s"};
  if (driven_m_ >= config_.at_most_m)
    return Status{StepState::failure,
                  "has not found itself in " + std::to_string(std::lround(config_.at_most_m)) + " m"};
  return std::nullopt;
}

Status FindMyself::tick(const WorldView& world, BehaviourContext& context) {
  if (const auto status = ended(world)) return *status;
  Status status = (is_close_ ? close_ : wide_).tick(world, context);
  if (status.state == StepState::running) return {StepState::running, "does not know where it is: " + status.reason};
  if (status.state == StepState::success && !is_close_) {
    is_close_ = true;
    return {StepState::running, "does not know where it is: looks closer"};
  }
  return {StepState::failure, "has not found itself: " + status.reason};
}

}  // namespace cairn::behaviours

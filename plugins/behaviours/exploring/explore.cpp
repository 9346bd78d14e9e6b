#include "plugins/behaviours/exploring/explore.hpp"

#include <algorithm>

#include "plugins/behaviours/exploring/exploration.hpp"

namespace cairn::behaviours {
void ExploreConfig::describe(Fields<ExploreConfig>& fields) {
  using C = ExploreConfig;
  fields.number(
      "until_known_ratio", &C::until_known_ratio, {0.0, 1.0}, "",
      "share of what can be reached that is known; when it is reached, frontiers and openings are left alone");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "time to explore; when it is up the step has succeeded");
  describe_exploring(fields);
}

Explore::Explore(const ExploreConfig& config) : config_(config) {}

Explore::~Explore() = default;

Status Explore::tick(const WorldView& world, BehaviourContext& context) {
  if (!run_) {
    run_ = std::make_unique<Exploration>(config_, world);
    const EstimateSettings& estimate = config_.exploring.estimate;
    progress_.emplace(world, config_.look_closer_m > 0.0 ? config_.look_closer_m : estimate.passed_m, estimate);
    begun_s_ = world.time_s;
  }
  Status status = run_->tick(world, context);
  if (status.state != StepState::running) return status;
  status.left_s = progress_->left_s(world);
  if (status.left_s) status.left_s = std::min(*status.left_s, begun_s_ + config_.at_most_s - world.time_s);
  return status;
}

void Explore::halt() {
  run_.reset();
}

bool Explore::has_nothing_left() const {
  return run_ && run_->has_nothing_left();
}

std::optional<Point> Explore::room_out_of_reach(const WorldView& world, const std::vector<Point>& done) const {
  return run_ ? run_->room_out_of_reach(world, done) : std::nullopt;
}

}  // namespace cairn::behaviours

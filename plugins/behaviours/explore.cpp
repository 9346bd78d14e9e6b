#include "plugins/behaviours/explore.hpp"

#include "plugins/behaviours/exploration.hpp"

namespace cairn::behaviours {

void ExploreConfig::describe(Fields<ExploreConfig>& fields) {
  using C = ExploreConfig;
  fields.number("until_known_ratio", &C::until_known_ratio, {0.0, 1.0}, "",
                "share of the cells within the outermost walls to know; then frontiers are left alone");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "time to explore; when it is up the step has succeeded");
  describe_ways(fields);
}

Explore::Explore(const ExploreConfig& config) : config_(config) {}

Explore::~Explore() = default;

Status Explore::tick(const WorldView& world, Orders& orders) {
  if (!run_) run_ = std::make_unique<Exploration>(config_, world);
  return run_->tick(world, orders);
}

void Explore::halt() {
  run_.reset();
}

}  // namespace cairn::behaviours

#include "plugins/behaviours/explore.hpp"

#include <algorithm>

#include "plugins/behaviours/exploration.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kLookEvery_s = 5.0;

}  // namespace

void ExploreConfig::describe(Fields<ExploreConfig>& fields) {
  using C = ExploreConfig;
  fields.number("until_known_ratio", &C::until_known_ratio, {0.0, 1.0}, "",
                "share of the cells within the outermost walls to know; then frontiers are left alone");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "time to explore; when it is up the step has succeeded");
  fields.number("clearance_m", &C::clearance_m, {0.0, 2.0}, "m",
                "kept between the robot's edge and everything occupied");
  fields.number("look_closer_m", &C::look_closer_m, {0.0, 5.0}, "m",
                "every edge is passed within this distance and every free-standing object circled; 0: neither");
  fields.number("lap_distance_m", &C::lap_distance_m, {0.1, 5.0}, "m",
                "from the edge of an object to the robot's centre on a lap");
  fields.number("largest_object_m", &C::largest_object_m, {0.1, 20.0}, "m", "what is longer is a wall: no laps");
  fields.flag("second_look", &C::second_look,
              "when all is seen, free-standing objects that are no known landmark are circled once more");
  fields.number("smallest_frontier_m", &C::smallest_frontier_m, {0.0, 10.0}, "m", "shorter frontiers are left alone");
  fields.number("speed_mps", &C::speed_mps, {0.01, 5.0}, "m/s", "top speed, within the robot's own limits");
  fields.number("lap_speed_mps", &C::lap_speed_mps, {0.01, 5.0}, "m/s",
                "the same on a lap: slower means more readings, and no more error of the odometry");
}

Explore::Explore(const ExploreConfig& config) : config_(config) {}

Explore::~Explore() = default;

Status Explore::tick(const WorldView& world, Orders& orders) {
  if (!run_) {
    run_ = std::make_unique<Exploration>(config_, world);
    begun_s_ = looked_s_ = world.time_s;
    left_at_look_s_.reset();
  }
  Status status = run_->tick(world, orders);
  if (status.progress == Progress::running) status.left_s = left_s(world);
  return status;
}

// As if what is left became known as fast as what is known has; nothing can be told of the laps after that.
std::optional<double> Explore::left_s(const WorldView& world) {
  const double done_s = world.time_s - begun_s_;
  if (world.time_s >= looked_s_ + kLookEvery_s) {
    looked_s_ = world.time_s;
    const double known = known_ratio(world.grid);
    left_at_look_s_.reset();
    if (known > 0.0 && known < config_.until_known_ratio)
      left_at_look_s_ = done_s * (config_.until_known_ratio - known) / known;
  }
  if (!left_at_look_s_) return std::nullopt;
  const double left_s = *left_at_look_s_ - (world.time_s - looked_s_);
  return std::min(std::max(0.0, left_s), config_.at_most_s - done_s);
}

void Explore::halt() {
  run_.reset();
}

}  // namespace cairn::behaviours

#include "plugins/behaviours/explore.hpp"

#include <algorithm>

#include "plugins/behaviours/exploration.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kPassed_m = 1.0;  // where edges are not passed at a distance of their own

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
    progress_.emplace(world, config_.look_closer_m > 0.0 ? config_.look_closer_m : kPassed_m);
    begun_s_ = world.time_s;
  }
  Status status = run_->tick(world, orders);
  if (status.progress != Progress::running) return status;
  status.left_s = progress_->left_s(world);
  if (status.left_s) status.left_s = std::min(*status.left_s, begun_s_ + config_.at_most_s - world.time_s);
  return status;
}

void Explore::halt() {
  run_.reset();
}

}  // namespace cairn::behaviours

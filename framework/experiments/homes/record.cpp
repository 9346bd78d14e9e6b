#include "framework/experiments/homes/record.hpp"

#include <algorithm>

#include "framework/experiments/trials/true_space.hpp"

namespace cairn {
namespace {

constexpr double kCountEvery_s = 1.0;
constexpr double kMostly = 0.9;

}  // namespace

HomeRecord::HomeRecord(const HomesConfig& config, Home home, const World& world, double radius_m)
    : config_(config), home_(std::move(home)), can_enter_(home_.rooms.size(), 0), entered_(home_.rooms.size(), 0) {
  const TrueSpace space(world, radius_m);
  reachable_m_ = space.reached_from(home_.start_m);
  cell_m2_ = space.cell_m() * space.cell_m();
  for (std::size_t i = 0; i < home_.rooms.size(); ++i)
    can_enter_[i] = std::ranges::any_of(
        reachable_m_, [&](const Point& p_m) { return home_.rooms[i].contains(p_m, config_.beyond_door_m); });
}

void HomeRecord::count(const OccupancyGrid& grid, double time_s) {
  const auto known = std::ranges::count_if(
      reachable_m_, [&](const Point& p_m) { return grid.state(grid.cell_at(p_m)) != CellState::unknown; });
  known_ratio_ = reachable_m_.empty() ? 0.0 : static_cast<double>(known) / static_cast<double>(reachable_m_.size());
  if (!known_90_s_ && known_ratio_ >= kMostly) known_90_s_ = time_s;
}

void HomeRecord::on(const Event& event, const MissionView& view) {
  if (!std::holds_alternative<TickDone>(event) || !view.truth) return;
  const Point at_m = view.truth->T_map_robot.position();
  for (std::size_t i = 0; i < home_.rooms.size(); ++i)
    if (home_.rooms[i].contains(at_m, config_.beyond_door_m)) entered_[i] = 1;
  if (view.world.time_s < counted_s_ + kCountEvery_s) return;
  counted_s_ = view.world.time_s;
  count(view.world.grid, view.world.time_s);
}

HomeVerdict HomeRecord::verdict(const MissionResult& result, const std::vector<TimedContact>& contacts) const {
  HomeVerdict verdict;
  for (std::size_t i = 0; i < home_.rooms.size(); ++i) {
    verdict.rooms += can_enter_[i] != 0 ? 1 : 0;
    verdict.entered += can_enter_[i] != 0 && entered_[i] != 0 ? 1 : 0;
    if (can_enter_[i] != 0 && entered_[i] == 0) verdict.not_entered.push_back(static_cast<int>(i));
  }
  verdict.area_m2 = cell_m2_ * static_cast<double>(reachable_m_.size());
  verdict.known_ratio = known_ratio_;
  verdict.known_90_s = known_90_s_;
  verdict.contacts = static_cast<int>(contacts.size());
  verdict.fast_contacts = static_cast<int>(std::ranges::count_if(contacts, [&](const TimedContact& touch) {
    return touch.contact.could_be_seen && touch.contact.speed_mps > config_.fast_mps;
  }));
  if (!result.steps.empty()) {
    verdict.said_success = result.steps.front().status.state == StepState::success;
    verdict.end = result.steps.front().status.reason;
  }
  return verdict;
}

}  // namespace cairn

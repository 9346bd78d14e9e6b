#include "plugins/baselines/himm_map/himm_map.hpp"

#include <algorithm>
#include <cmath>

#include "maps/geometry/segments.hpp"
#include "maps/grid/beam_cells.hpp"
#include "plugins/common/sonar_model/reading.hpp"

namespace cairn::himm_map {
namespace {

constexpr double kRoomForEveryCertainty_nat = 10.0;

std::vector<LogOdds> log_odds_table(int certainty_max) {
  std::vector<LogOdds> table;
  for (int c = 0; c <= certainty_max; ++c) table.push_back(log_odds_of((c + 0.5) / (certainty_max + 1.0)));
  return table;
}

// The highest certainty that is as surely free as that.
int surest_of(const std::vector<LogOdds>& log_odds_of_certainty, LogOdds free) {
  const auto beyond = std::ranges::upper_bound(log_odds_of_certainty, free);
  return static_cast<int>(std::max<std::ptrdiff_t>(0, beyond - log_odds_of_certainty.begin() - 1));
}

}  // namespace

using sonar_model::Meaning;

HimmMap::HimmMap(const Config& config)
    : config_(config),
      log_odds_of_certainty_(log_odds_table(config.certainty_max)),
      free_certainty_(surest_of(log_odds_of_certainty_, sonar_model::ClearedFootprint::kFree)),
      grid_(config.cell_m, kRoomForEveryCertainty_nat) {}

void HimmMap::begin_with(const OccupancyGrid& grid) {
  grid_ = grid;
  const CellBox box = grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      const LogOdds value = grid.log_odds({x, y});
      if (value == 0) continue;
      const auto nearest = std::ranges::lower_bound(log_odds_of_certainty_, value);
      const auto certainty = std::min<std::ptrdiff_t>(nearest - log_odds_of_certainty_.begin(), config_.certainty_max);
      certainties_.at(sonar_model::tile_holding({x, y}))[sonar_model::place_in_tile({x, y})] =
          static_cast<std::uint8_t>(certainty);
    }
}

const CellChanges& HimmMap::integrate(const Observation& observation, const PoseEstimate& pose) {
  changes_.spans.clear();
  if (!is_finite(pose.T_map_robot)) return changes_;
  for (const RangeReading& reading : observation.ranges) integrate_reading(reading, pose.T_map_robot);
  for (const Cell cell : cleared_footprint_.unknown_under(grid_, pose.T_map_robot))
    set_certainty(cell, free_certainty_);
  sonar_model::tidy(changes_.spans);
  return changes_;
}

void HimmMap::integrate_reading(const RangeReading& reading, const Pose2& T_map_robot) {
  const Meaning meaning = sonar_model::meaning_of(reading);
  if (meaning == Meaning::ignored) return;
  const bool echo = meaning == Meaning::echo;
  const Pose2 T_map_sensor = T_map_robot * reading.T_robot_sensor;
  const double length_m = echo ? reading.range_m : std::min(reading.max_m, config_.range_m);
  if (!grid_.can_include(T_map_sensor.position(), length_m)) return;
  const Cell hit = grid_.cell_at(T_map_sensor.position() + length_m * T_map_sensor.direction());
  spans_over({T_map_sensor, 0.0, length_m}, grid_.cell_m(), spans_);
  for (const CellSpan& span : spans_)
    for (int x = span.x_begin; x < span.x_end; ++x)
      if (const Cell cell{x, span.y}; !echo || cell != hit) set_certainty(cell, certainty(cell) - config_.decrement);
  if (echo) set_certainty(hit, certainty(hit) + config_.increment + (config_.growth ? growth_at(hit) : 0));
}

int HimmMap::certainty(Cell cell) const {
  const auto* const tile = certainties_.find(sonar_model::tile_holding(cell));
  return tile == nullptr ? 0 : (*tile)[sonar_model::place_in_tile(cell)];
}

void HimmMap::set_certainty(Cell cell, int certainty) {
  const int kept = std::clamp(certainty, 0, config_.certainty_max);
  const LogOdds value = log_odds_of_certainty_[static_cast<std::size_t>(kept)];
  // A cell in the middle of the scale looks as one that was never seen, but is not.
  if (grid_.log_odds(cell) == value && this->certainty(cell) == kept) return;
  grid_.set_log_odds(cell, value);
  certainties_.at(sonar_model::tile_holding(cell))[sonar_model::place_in_tile(cell)] = static_cast<std::uint8_t>(kept);
  changes_.spans.push_back({cell.y, cell.x, cell.x + 1});
}

int HimmMap::growth_at(Cell cell) const {
  int sum = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (dx != 0 || dy != 0) sum += certainty(cell + Cell{dx, dy});
  return sum / 2;
}

}  // namespace cairn::himm_map

#include "plugins/muriel/muriel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plugins/muriel/plain_muriel.hpp"
#include "plugins/sonar_model/reading.hpp"

namespace cairn::muriel {
namespace {

constexpr int kTileSide = OccupancyGrid::kTileSide;
// The kernels' series are good up to here, and the beam crosses at most kMostEdges edges of 32 buckets.
constexpr double kWidestHalfBeam_rad = 0.25 * std::numbers::pi;

// So many range errors before the echo, Phi is 1 and phi 0 to a tenth of a quantum.
constexpr float kSharp_sigmas = 5.0F;

constexpr std::array<LogOdds, kTileSide> kUnseenRow{};

KernelReading kernel_reading(const Config& config, const PlacedReading& reading, LogOdds believed_from) {
  const Beam& beam = reading.beam;
  const Point ahead = beam.T_map_sensor.direction();
  KernelReading result;
  result.apex_x_m = beam.T_map_sensor.x_m;
  result.apex_y_m = beam.T_map_sensor.y_m;
  result.cell_m = config.cell_m;
  result.ahead_x = static_cast<float>(ahead.x());
  result.ahead_y = static_cast<float>(ahead.y());
  result.is_ray = beam.half_beam_rad <= 0.0;
  result.per_half_beam2 = result.is_ray ? 0.0F : static_cast<float>(1.0 / (beam.half_beam_rad * beam.half_beam_rad));
  result.alpha_max = static_cast<float>(config.alpha_max);
  result.per_alpha_range = static_cast<float>(1.0 / config.alpha_range_m);
  result.delta_m = static_cast<float>(config.delta_m);
  result.delta_per_m = static_cast<float>(config.delta_per_m);
  result.range_m = static_cast<float>(std::min(reading.range_m, 1e6));
  result.reach_m = static_cast<float>(beam.reach_m);
  result.near_m = (result.range_m - kSharp_sigmas * result.delta_m) / (1.0F + kSharp_sigmas * result.delta_per_m);
  result.is_echo = reading.is_echo;
  result.believed_from = config.specular ? believed_from : std::numeric_limits<LogOdds>::max();
  return result;
}

void add_edges(KernelReading& result, const Beam& beam, int bearings) {
  result.bearings = bearings;
  const double axis = beam.T_map_sensor.theta_rad;
  result.first_bucket = bucket_of(axis - beam.half_beam_rad, bearings);
  const int last_bucket = bucket_of(axis + beam.half_beam_rad, bearings);
  result.edges = (last_bucket - result.first_bucket + bearings) % bearings;
  for (int e = 0; e < result.edges; ++e) {
    const double angle = (result.first_bucket + e + 0.5) * 2.0 * std::numbers::pi / bearings;
    result.edge_x[static_cast<std::size_t>(e)] = static_cast<float>(std::cos(angle));
    result.edge_y[static_cast<std::size_t>(e)] = static_cast<float>(std::sin(angle));
  }
}

}  // namespace

Muriel::Muriel(const Config& config)
    : config_(config), believed_(log_odds_of(config.believed_p)), grid_(config.cell_m, config.clamp_nat) {
  std::ranges::copy(weights_of(config), weights_.begin());
  for (int l = believed_; l <= grid_.clamp_quanta(); ++l)
    probability_.push_back(probability_of(static_cast<LogOdds>(l)));
}

const CellChanges& Muriel::integrate(const Observation& observation, const PoseEstimate& pose) {
  changes_.spans.clear();
  if (!sonar_model::is_finite(pose.T_map_robot)) return changes_;
  for (const RangeReading& reading : observation.ranges)
    if (const auto news = placed(config_, reading, pose.T_map_robot)) integrate_reading(*news);
  join_rows();
  return changes_;
}

void Muriel::integrate_reading(const PlacedReading& reading) {
  if (!grid_.can_include(reading.beam.T_map_sensor.position(), reading.beam.reach_m)) return;
  if (reading.beam.half_beam_rad > kWidestHalfBeam_rad) {
    integrate_plainly(config_, reading, grid_, log_, spans_, changes_.spans);
    return;
  }
  find_runs(reading);
  KernelReading kernel = kernel_reading(config_, reading, believed_);
  if (config_.log != LogPolicy::off) add_edges(kernel, reading.beam, config_.log_bearings);
  const int known = evaluate_runs(kernel, runs_.data(), static_cast<int>(runs_.size()), cells_, known_.data());
  const double s = config_.specular ? specular_p(reading, known) : 0.0;
  apply({static_cast<float>(1.0 - s), static_cast<float>(1.0 / config_.false_echo_per_m), grid_.clamp_quanta()});
}

void Muriel::find_runs(const PlacedReading& reading) {
  spans_over(reading.beam, config_.cell_m, spans_);
  runs_.clear();
  std::size_t cells = 0;
  Cell known_tile{};
  const LogOdds* tile_cells = nullptr;
  bool is_looked_up = false;
  for (const CellSpan& span : spans_)
    for (int x = span.x_begin; x < span.x_end;) {
      const int tile_end = (x | (kTileSide - 1)) + 1;
      const int end = std::min(span.x_end, tile_end);
      const int blocks = (end - x + kBlock_cells - 1) / kBlock_cells;
      const Cell first{std::min(x, tile_end - blocks * kBlock_cells), span.y};
      if (const Cell tile = sonar_model::tile_holding(first); !is_looked_up || tile != known_tile) {
        tile_cells = grid_.cells_of_tile(tile);
        known_tile = tile;
        is_looked_up = true;
      }
      Run& run = runs_.emplace_back();
      run.first = first;
      run.blocks = blocks;
      run.begin = x - first.x;
      run.end = end - first.x;
      run.is_seen = tile_cells != nullptr;
      run.cells = run.is_seen ? tile_cells + sonar_model::place_in_tile(first) : kUnseenRow.data();
      cells += static_cast<std::size_t>(blocks * kBlock_cells);
      x = end;
    }
  make_room(cells);
}

void Muriel::make_room(std::size_t cells) {
  if (known_.size() <= cells) {
    known_.resize(cells + 1);
    integers_.resize(2 * cells);
    floats_.resize(5 * cells);
  }
  float* const floats = floats_.data();
  cells_ = {floats,
            floats + cells,
            integers_.data(),
            floats + 2 * cells,
            floats + 3 * cells,
            floats + 4 * cells,
            integers_.data() + cells};
}

double Muriel::specular_p(const PlacedReading& reading, int known) const {
  KnownTargets targets(config_.specular_sectors);
  for (int i = 0; i < known; ++i) {
    const KnownTarget& target = known_[static_cast<std::size_t>(i)];
    const double p = probability_[static_cast<std::size_t>(target.log_odds - believed_)];
    const float off2 = cells_.off2[target.index];
    const double off_axis = std::copysign(std::sqrt(std::abs(off2)), off2);
    const double range_m = cells_.range_m[target.index];
    if (range_m < reading.range_m - 3.0 * config_.delta(range_m))
      targets.add_blocker(off_axis, p * cells_.alpha[target.index]);
    targets.add_source(off_axis, p * cells_.hit_per_m[target.index]);
  }
  return targets.specular_p(config_, reading.is_echo);
}

// What says nothing must not grow the grid.
void Muriel::open_runs(const KernelScale& scale) {
  std::size_t at = 0;
  Cell open_tile{};
  LogOdds* cells = nullptr;
  LogWord* words = nullptr;
  for (Run& run : runs_) {
    const int count = run.blocks * kBlock_cells;
    if (run.is_seen || says_something(cells_.miss + at, cells_.hit_per_m + at, scale, count)) {
      const Cell tile = sonar_model::tile_holding(run.first);
      if (cells == nullptr || tile != open_tile) {
        cells = grid_.cells_of_tile_for_writing(tile);
        words = config_.log == LogPolicy::off ? nullptr : log_.tile(tile).data();
        open_tile = tile;
      }
      const std::size_t place = sonar_model::place_in_tile(run.first);
      run.cells_to_write = cells + place;
      run.words = words == nullptr ? nullptr : words + place;
    }
    at += static_cast<std::size_t>(count);
  }
}

void Muriel::apply(const KernelScale& scale) {
  open_runs(scale);
  apply_runs(cells_, scale, weights_, runs_.data(), static_cast<int>(runs_.size()));
  CellBox box;
  for (const Run& run : runs_) {
    if (run.last_changed < 0) continue;
    const CellSpan span{run.first.y, run.first.x + run.first_changed, run.first.x + run.last_changed + 1};
    box = united(box, {{span.x_begin, span.y}, {span.x_end, span.y + 1}});
    changes_.spans.push_back(span);
  }
  grid_.include(box);
}

// One span a row, rows rising.
void Muriel::join_rows() {
  if (changes_.spans.empty()) return;
  const auto [low, high] = std::ranges::minmax(changes_.spans, {}, &CellSpan::y);
  hull_.assign(static_cast<std::size_t>(high.y - low.y + 1), {0, std::numeric_limits<int>::max(), 0});
  for (const CellSpan& span : changes_.spans) {
    CellSpan& row = hull_[static_cast<std::size_t>(span.y - low.y)];
    const bool is_first = row.x_begin > row.x_end;
    row = {span.y, std::min(row.x_begin, span.x_begin), is_first ? span.x_end : std::max(row.x_end, span.x_end)};
  }
  changes_.spans.clear();
  for (const CellSpan& row : hull_)
    if (row.x_begin < row.x_end) changes_.spans.push_back(row);
}

}  // namespace cairn::muriel

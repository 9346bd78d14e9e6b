#include "plugins/muriel/muriel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "maps/geometry/segments.hpp"
#include "plugins/common/sonar_model/reading.hpp"
#include "plugins/muriel/plain_muriel.hpp"

namespace cairn::muriel {
namespace {

constexpr int kTileSide = OccupancyGrid::kTileSide;
// The kernels' series are good up to here, and the beam crosses at most kMaxEdges edges of 32 buckets.
constexpr double kWidestHalfBeam_rad = 0.25 * std::numbers::pi;

// So many range errors before the echo, Phi is 1 and phi 0 to a tenth of a quantum.
constexpr float kSharp_sigmas = 5.0F;

int plane_of(int bucket) {
  return bucket / kBucketsInPlane;
}

}  // namespace

Muriel::Muriel(const Config& config)
    : config_(config),
      weights_(weights_of(config)),
      believed_(log_odds_of(config.believed_p)),
      grid_(config.cell_m, config.clamp_nat),
      light_rays_(config) {}

const CellChanges& Muriel::integrate(const Observation& observation, const PoseEstimate& pose) {
  changes_.spans.clear();
  if (!is_finite(pose.T_map_robot)) return changes_;
  for (const RangeReading& reading : observation.ranges)
    if (const auto evidence = placed(config_, reading, pose.T_map_robot)) integrate_reading(*evidence);
  grid_.include(light_rows_.box());
  light_rows_.drain(changes_.spans);
  cleared_footprint_.take(grid_, pose.T_map_robot, changes_.spans);
  join_rows();
  return changes_;
}

void Muriel::integrate_reading(const PlacedReading& reading) {
  if (!grid_.can_include(reading.beam.T_map_sensor.position(), reading.beam.reach_m)) return;
  if (reading.is_light) {
    light_rays_.integrate(reading, grid_, log_, light_rows_);
    return;
  }
  const int first_bucket =
      bucket_of(reading.beam.T_map_sensor.theta_rad - reading.beam.half_beam_rad, config_.log_bearings);
  const std::optional<KernelLog> log = kernel_log(reading.beam);
  if (reading.beam.half_beam_rad > kWidestHalfBeam_rad || !log) {
    integrate_plainly(config_, reading, grid_, log_, spans_, changes_.spans);
    return;
  }
  find_runs(reading.beam);
  find_blocks(reading.beam, plane_of(first_bucket));
  const KernelReading kernel = kernel_reading(reading);
  const ListLengths lists = place_blocks(kernel, blocks_.data(), block_count_, cells_);
  const double s = config_.specular ? specular_p(kernel, lists.known) : 0.0;
  compare_blocks(kernel, lists.near, cells_);
  KernelScale scale{static_cast<float>(1.0 - s), grid_.clamp_quanta(), {}};
  std::ranges::copy(weights_, scale.weight_of_count);
  open_unseen(scale, plane_of(first_bucket));
  apply_blocks(scale, *log, blocks_.data(), block_count_, cells_);
  note_changes();
}

KernelReading Muriel::kernel_reading(const PlacedReading& reading) const {
  const Beam& beam = reading.beam;
  const Point ahead = beam.T_map_sensor.direction();
  KernelReading result;
  result.cell_m = static_cast<float>(config_.cell_m);
  result.ahead_x = static_cast<float>(ahead.x());
  result.ahead_y = static_cast<float>(ahead.y());
  result.is_ray = beam.half_beam_rad <= 0.0;
  if (!result.is_ray) {
    const double widest_tangent = std::tan(beam.half_beam_rad);
    result.per_half_beam = static_cast<float>(1.0 / beam.half_beam_rad);
    result.widest_tangent2 = static_cast<float>(widest_tangent * widest_tangent);
  }
  result.alpha_max = static_cast<float>(config_.alpha_max);
  result.per_alpha_range = static_cast<float>(1.0 / config_.alpha_range_m);
  result.delta_m = static_cast<float>(config_.delta_m);
  result.delta_per_m = static_cast<float>(config_.delta_per_m);
  result.per_false_echo_m = static_cast<float>(1.0 / config_.false_echo_per_m);
  result.range_m = static_cast<float>(std::min(reading.range_m, 1e6));
  result.reach_m = static_cast<float>(beam.reach_m);
  result.near_m = (result.range_m - kSharp_sigmas * result.delta_m) / (1.0F + kSharp_sigmas * result.delta_per_m);
  result.is_echo = reading.is_echo;
  result.believed_from = config_.specular ? believed_ : std::numeric_limits<LogOdds>::max();
  result.sectors = config_.specular_sectors;
  return result;
}

// Nothing when the beam's buckets do not follow each other in two planes.
std::optional<KernelLog> Muriel::kernel_log(const Beam& beam) const {
  KernelLog log;
  if (config_.log == LogPolicy::off) return log;
  const int bearings = config_.log_bearings;
  const double per_rad = bearings / (2.0 * std::numbers::pi);
  const double axis = beam.T_map_sensor.theta_rad * per_rad;
  const double first = std::round((beam.T_map_sensor.theta_rad - beam.half_beam_rad) * per_rad);
  const double last = std::round((beam.T_map_sensor.theta_rad + beam.half_beam_rad) * per_rad);
  const int first_bucket = bucket_of(beam.T_map_sensor.theta_rad - beam.half_beam_rad, bearings);
  const int end = first_bucket + static_cast<int>(last - first) + 1;
  const bool is_in_order = end <= bearings || (bearings % kBucketsInPlane == 0 && bearings > kBucketsInPlane);
  const int planes = (end - 1) / kBucketsInPlane - plane_of(first_bucket) + 1;
  if (!is_in_order || planes > 2) return std::nullopt;
  log.is_on = true;
  log.shift = 2 * (first_bucket % kBucketsInPlane);
  log.buckets_per_off = static_cast<float>(beam.half_beam_rad * per_rad);
  log.buckets_to_axis = static_cast<float>(axis - first + 0.5);
  const int second_plane = plane_of((end - 1) % bearings);
  log.plane_step = (second_plane - plane_of(first_bucket)) * static_cast<std::ptrdiff_t>(sonar_model::kCellsInTile);
  return log;
}

// Pieces of the beam's spans, cut where tiles end.
void Muriel::find_runs(const Beam& beam) {
  spans_over(beam, config_.cell_m, spans_);
  runs_.clear();
  block_count_ = 0;
  for (const CellSpan& span : spans_)
    for (int x = span.x_begin; x < span.x_end;) {
      const int tile_end = (x | (kTileSide - 1)) + 1;
      const int end = std::min(span.x_end, tile_end);
      const int blocks = (end - x + kBlock_cells - 1) / kBlock_cells;
      const Cell first{std::min(x, tile_end - blocks * kBlock_cells), span.y};
      runs_.push_back({first, x - first.x, end - first.x, block_count_, blocks, true});
      block_count_ += blocks;
      x = end;
    }
}

void Muriel::find_blocks(const Beam& beam, int first_plane) {
  make_room();
  const std::size_t plane_at = static_cast<std::size_t>(first_plane) * sonar_model::kCellsInTile;
  const double cell_m = config_.cell_m;
  const double x_m = 0.5 * cell_m - beam.T_map_sensor.x_m;
  const double y_m = 0.5 * cell_m - beam.T_map_sensor.y_m;
  const auto block_m = static_cast<float>(kBlock_cells * cell_m);
  Cell known_tile{std::numeric_limits<int>::max(), 0};
  LogOdds* tile_cells = nullptr;
  std::uint16_t* tile_log = nullptr;
  Block* next = blocks_.data();
  for (Run& run : runs_) {
    if (const Cell tile = sonar_model::tile_holding(run.first); tile != known_tile) {
      known_tile = tile;
      tile_cells = grid_.cells_of_tile(tile) == nullptr ? nullptr : grid_.cells_of_tile_for_writing(tile);
      tile_log = tile_cells == nullptr || config_.log == LogPolicy::off ? nullptr : log_.tile(tile).data() + plane_at;
    }
    run.is_seen = tile_cells != nullptr;
    const std::size_t place = sonar_model::place_in_tile(run.first);
    const int stride = run.is_seen ? kBlock_cells : 0;
    Block block{static_cast<float>(run.first.x * cell_m + x_m),
                static_cast<float>(run.first.y * cell_m + y_m),
                run.is_seen ? tile_cells + place : unseen_cells_.data(),
                tile_log == nullptr ? unseen_log_.data() + plane_at : tile_log + place,
                static_cast<float>(run.begin),
                static_cast<float>(run.end)};
    for (int b = 0; b < run.blocks; ++b) {
      *next++ = block;
      block.dx_m += block_m;
      block.cells += stride;
      if (tile_log != nullptr) block.log += stride;
      block.begin -= kBlock_cells;
      block.end -= kBlock_cells;
    }
  }
}

void Muriel::make_room() {
  if (blocks_.size() >= static_cast<std::size_t>(block_count_)) return;
  const std::size_t blocks = 2 * static_cast<std::size_t>(block_count_);
  const std::size_t cells = (blocks + 1) * kBlock_cells;
  blocks_.resize(blocks);
  moved_.resize(blocks + sizeof(std::uint64_t));
  floats_.resize(5 * cells);
  integers_.resize(2 * cells + 2 * (blocks + 1));
  float* const floats = floats_.data();
  std::int32_t* const integers = integers_.data();
  cells_.evidence = floats;
  cells_.range_m = floats + cells;
  cells_.off = floats + 2 * cells;
  cells_.blockers = {floats + 3 * cells, integers};
  cells_.sources = {floats + 4 * cells, integers + cells};
  cells_.near = integers + 2 * cells;
  cells_.known = integers + 2 * cells + blocks + 1;
  cells_.moved = moved_.data();
}

double Muriel::specular_p(const KernelReading& reading, int known) const {
  SectorTargets found;
  find_targets(reading, blocks_.data(), known, cells_, found);
  KnownTargets targets(config_.specular_sectors);
  for (int k = 0; k < config_.specular_sectors; ++k) {
    targets.add_blocker_in(k, found.blocking[k]);
    targets.add_source_in(k, found.density_per_m[k]);
  }
  return targets.specular_p(config_, reading.is_echo);
}

// What says nothing must not grow the grid.
void Muriel::open_unseen(const KernelScale& scale, int first_plane) {
  const std::size_t plane_at = static_cast<std::size_t>(first_plane) * sonar_model::kCellsInTile;
  for (const Run& run : runs_) {
    if (run.is_seen) continue;
    const int at = run.first_block * kBlock_cells;
    if (!says_something(cells_.evidence + at, scale, run.blocks * kBlock_cells)) continue;
    const Cell tile = sonar_model::tile_holding(run.first);
    const std::size_t place = sonar_model::place_in_tile(run.first);
    LogOdds* cells = grid_.cells_of_tile_for_writing(tile) + place;
    std::uint16_t* counts = config_.log == LogPolicy::off ? nullptr : log_.tile(tile).data() + plane_at + place;
    for (int b = 0; b < run.blocks; ++b) {
      Block& block = blocks_[static_cast<std::size_t>(run.first_block) + static_cast<std::size_t>(b)];
      block.cells = cells + b * kBlock_cells;
      if (counts != nullptr) block.log = counts + b * kBlock_cells;
    }
  }
}

void Muriel::note_changes() {
  static_assert(kTileSide <= 64 && std::endian::native == std::endian::little, "a run's bits are a word");
  CellBox box;
  for (const Run& run : runs_) {
    std::uint64_t moved = 0;
    std::memcpy(&moved, moved_.data() + run.first_block, sizeof moved);  // the blocks' bits, then others'
    moved &= ~std::uint64_t{0} >> (64 - kBlock_cells * run.blocks);
    if (moved == 0) continue;
    const CellSpan span{run.first.y, run.first.x + std::countr_zero(moved), run.first.x + 64 - std::countl_zero(moved)};
    box = united(box, {{span.x_begin, span.y}, {span.x_end, span.y + 1}});
    changes_.spans.push_back(span);
  }
  grid_.include(box);
}

// One span a row, rows rising.
void Muriel::join_rows() {
  if (changes_.spans.empty()) return;
  const auto [low, high] = std::ranges::minmax(changes_.spans, {}, &CellSpan::y);
  const int rows = high.y - low.y + 1;
  hull_.assign(static_cast<std::size_t>(rows), {0, std::numeric_limits<int>::max(), 0});
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

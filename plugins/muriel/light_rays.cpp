#include "plugins/muriel/light_rays.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace cairn::muriel {
namespace {

constexpr int kRanges = 2048;
constexpr float kSharpSigmas = 5.0F;  // farther before the echo than this, Phi is 1 and phi 0
constexpr int kPerSigma = 128;
constexpr int kSigmas = static_cast<int>(2.0F * kSharpSigmas) * kPerSigma;

// 256 ln x for positive normal x, error 0.002, by single operations only: the series of atanh round a power of two.
float quanta_of_ln(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;
  const auto rest = std::bit_cast<float>(bits - exponent * (1 << 23));
  const float s = (rest - 1.0F) / (rest + 1.0F);
  return static_cast<float>(exponent) * (256.0F * 0.69314718F) +
         s * (256.0F * 1.99995481F + 256.0F * 0.678788687F * (s * s));
}

// Between two entries; at: not below 0.
float looked_up(const std::vector<float>& table, float at) {
  const auto low = std::min(static_cast<std::size_t>(at), table.size() - 2);
  return table[low] + (at - static_cast<float>(low)) * (table[low + 1] - table[low]);
}

}  // namespace

struct LightRays::Ray {
  float echo_m;      // or the farthest without one
  float sharp_m;     // up to here the echo is far behind
  float false_echo;  // 0 without an echo, else 1 / F
  int clamp;
  std::size_t plane;  // of the log, where its counts begin
  int shift;
};

LightRays::LightRays(const Config& config) : config_(config), weights_(weights_of(config)) {
  for (int i = 0; i <= kRanges; ++i) {
    const double alpha = config.alpha(config.alpha_range_m * i / kRanges, 0.0, 0.0);
    before_echo_.push_back(static_cast<float>(kLogOddsPerNat * std::log1p(-alpha)));
  }
  for (int i = 0; i <= kSigmas; ++i) {
    const double z = static_cast<double>(i) / kPerSigma - static_cast<double>(kSharpSigmas);
    integral_.push_back(static_cast<float>(0.5 * std::erfc(-z * std::numbers::sqrt2 * 0.5)));
    density_.push_back(
        static_cast<float>(std::exp(-0.5 * z * z) * 0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2));
  }
}

float LightRays::increment_of(const Ray& ray, float range_m) const {
  if (range_m <= ray.sharp_m)
    return looked_up(before_echo_, range_m * (static_cast<float>(kRanges) / static_cast<float>(config_.alpha_range_m)));
  const float share = std::max(0.0F, 1.0F - range_m / static_cast<float>(config_.alpha_range_m));
  const float alpha = static_cast<float>(config_.alpha_max) * share;
  const float delta_m = static_cast<float>(config_.delta_m) + static_cast<float>(config_.delta_per_m) * range_m;
  const float z = std::clamp((ray.echo_m - range_m) / delta_m, -kSharpSigmas, kSharpSigmas);
  const float at = (z + kSharpSigmas) * static_cast<float>(kPerSigma);
  const float hit = ray.false_echo > 0.0F ? looked_up(density_, at) * ray.false_echo / delta_m : 0.0F;
  return quanta_of_ln(1.0F + alpha * (hit - looked_up(integral_, at)));
}

void LightRays::integrate(const PlacedReading& reading, OccupancyGrid& grid, IndependenceLog& log, RowHull& changed) {
  const Beam& beam = reading.beam;
  const int bucket = bucket_of(beam.T_map_sensor.theta_rad, config_.log_bearings);
  Ray ray{};
  ray.echo_m = static_cast<float>(std::min(reading.range_m, 1e6));
  ray.sharp_m = (ray.echo_m - kSharpSigmas * static_cast<float>(config_.delta_m)) /
                (1.0F + kSharpSigmas * static_cast<float>(config_.delta_per_m));
  ray.false_echo = reading.is_echo ? static_cast<float>(1.0 / config_.false_echo_per_m) : 0.0F;
  ray.clamp = grid.clamp_quanta();
  ray.plane = static_cast<std::size_t>(bucket / kBucketsInPlane) * sonar_model::kCellsInTile;
  ray.shift = 2 * (bucket % kBucketsInPlane);

  place_ = {};  // the log's plane is another
  spans_over(beam, config_.cell_m, spans_);
  const Point ahead = beam.T_map_sensor.direction();
  const double cell_m = config_.cell_m;
  for (const CellSpan& span : spans_) {
    const double row_m = ahead.y() * ((span.y + 0.5) * cell_m - beam.T_map_sensor.y_m);
    for (int x = span.x_begin; x < span.x_end; ++x) {
      const double along_m = ahead.x() * ((x + 0.5) * cell_m - beam.T_map_sensor.x_m) + row_m;
      if (along_m > beam.reach_m) continue;
      ++cells_;
      const float increment = increment_of(ray, static_cast<float>(std::max(0.0, along_m)));
      // What rounds to nothing leaves grid and log alone.
      if (std::abs(increment) >= 0.5F) add(ray, {x, span.y}, increment, grid, log, changed);
    }
  }
}

void LightRays::add(const Ray& ray, Cell cell, float increment, OccupancyGrid& grid, IndependenceLog& log,
                    RowHull& changed) {
  const Cell tile = sonar_model::tile_holding(cell);
  if (!place_.is_known || tile != place_.tile) {
    place_ = {tile, grid.cells_of_tile_for_writing(tile), nullptr, true};
    if (config_.log != LogPolicy::off) place_.counts = log.tile(tile).data() + ray.plane;
  }
  const std::size_t at = sonar_model::place_in_tile(cell);
  double weight = 1.0;
  if (place_.counts != nullptr) {
    std::uint16_t& counts = place_.counts[at];
    weight = weights_[static_cast<std::size_t>((counts >> ray.shift) & kMaxReadings)];
    if (weight <= 0.0) return;
    counts = static_cast<std::uint16_t>(counts + (1U << ray.shift));
  }
  const auto change = static_cast<int>(std::lround(static_cast<float>(weight) * increment));
  LogOdds& value = place_.cells[at];
  const auto after = static_cast<LogOdds>(std::clamp(value + change, -ray.clamp, ray.clamp));
  if (after == value) return;
  value = after;
  changed.add(cell.y, cell.x, cell.x + 1);
}

}  // namespace cairn::muriel

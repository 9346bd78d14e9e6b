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
  float echo_m = 0.0F;      // or the farthest without one
  float sharp_m = 0.0F;     // up to here the echo is far behind
  float false_echo = 0.0F;  // 0 without an echo, else 1 / F
  double ahead_x = 1.0;
  double from_x_m = 0.0;  // along the ray from the sensor to x = 0, y = 0
  double ahead_y = 0.0;
  double reach_m = 0.0;
  std::size_t plane = 0;  // of the log, where its counts begin
  int shift = 0;
};

LightRays::LightRays(const Config& config)
    : config_(config),
      alpha_max_(static_cast<float>(config.alpha_max)),
      per_alpha_range_(static_cast<float>(1.0 / config.alpha_range_m)),
      delta_m_(static_cast<float>(config.delta_m)),
      delta_per_m_(static_cast<float>(config.delta_per_m)) {
  std::ranges::transform(weights_of(config), weights_.begin(),
                         [](double weight) { return static_cast<float>(weight); });
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
  if (range_m <= ray.sharp_m) return looked_up(before_echo_, range_m * per_alpha_range_ * static_cast<float>(kRanges));
  const float alpha = alpha_max_ * std::max(0.0F, 1.0F - range_m * per_alpha_range_);
  const float delta_m = delta_m_ + delta_per_m_ * range_m;
  const float z = std::clamp((ray.echo_m - range_m) / delta_m, -kSharpSigmas, kSharpSigmas);
  const float at = (z + kSharpSigmas) * static_cast<float>(kPerSigma);
  const float hit = ray.false_echo > 0.0F ? looked_up(density_, at) * ray.false_echo / delta_m : 0.0F;
  return quanta_of_ln(1.0F + alpha * (hit - looked_up(integral_, at)));
}

void LightRays::integrate(const PlacedReading& reading, OccupancyGrid& grid, IndependenceLog& log, RowHull& changed) {
  const Beam& beam = reading.beam;
  const int bucket = bucket_of(beam.T_map_sensor.theta_rad, config_.log_bearings);
  const Point ahead = beam.T_map_sensor.direction();
  Ray ray;
  ray.echo_m = static_cast<float>(std::min(reading.range_m, 1e6));
  ray.sharp_m = (ray.echo_m - kSharpSigmas * delta_m_) / (1.0F + kSharpSigmas * delta_per_m_);
  ray.false_echo = reading.is_echo ? static_cast<float>(1.0 / config_.false_echo_per_m) : 0.0F;
  ray.ahead_x = ahead.x();
  ray.ahead_y = ahead.y();
  ray.from_x_m = -ahead.dot(beam.T_map_sensor.position());
  ray.reach_m = beam.reach_m;
  ray.plane = static_cast<std::size_t>(bucket / kBucketsInPlane) * sonar_model::kCellsInTile;
  ray.shift = 2 * (bucket % kBucketsInPlane);

  has_tile_ = false;  // the log's plane is another
  spans_over(beam, config_.cell_m, spans_);
  for (const CellSpan& span : spans_)
    for (int x = span.x_begin; x < span.x_end;) {
      const int end = std::min(span.x_end, (x | (OccupancyGrid::kTileSide - 1)) + 1);
      take_row(ray, {span.y, x, end}, grid, log, changed);
      x = end;
    }
}

void LightRays::take_row(const Ray& ray, const CellSpan& span, OccupancyGrid& grid, IndependenceLog& log,
                         RowHull& changed) {
  const Cell first{span.x_begin, span.y};
  const Cell tile = sonar_model::tile_holding(first);
  const auto open_tile = [&](bool anew) {
    const bool is_there = anew || grid.cells_of_tile(tile) != nullptr;
    tile_ = {};
    if (is_there) tile_.cells = grid.cells_of_tile_for_writing(tile);
    if (is_there && config_.log != LogPolicy::off) tile_.counts = log.tile(tile).data() + ray.plane;
    tile_at_ = tile;
    has_tile_ = true;
  };
  if (!has_tile_ || tile != tile_at_) open_tile(false);
  const std::size_t row = sonar_model::place_in_tile(first);
  const double row_m = ray.ahead_y * (span.y + 0.5) * config_.cell_m + ray.from_x_m;
  const double step_m = ray.ahead_x * config_.cell_m;
  const int clamp = grid.clamp_quanta();
  int changed_from = span.x_end;
  int changed_to = span.x_begin;
  cells_ += span.x_end - span.x_begin;
  for (int x = span.x_begin; x < span.x_end; ++x) {
    const double along_m = (x + 0.5) * step_m + row_m;
    if (along_m > ray.reach_m) continue;
    const std::size_t at = row + static_cast<std::size_t>(x - span.x_begin);
    float weight = 1.0F;
    if (tile_.counts != nullptr) weight = weights_[(tile_.counts[at] >> ray.shift) & kMaxReadings];
    if (weight <= 0.0F) continue;
    const float increment = increment_of(ray, static_cast<float>(std::max(0.0, along_m)));
    if (std::abs(increment) < 0.5F) continue;  // what rounds to nothing leaves grid and log alone
    if (tile_.cells == nullptr) open_tile(true);
    if (tile_.counts != nullptr) tile_.counts[at] = static_cast<std::uint16_t>(tile_.counts[at] + (1U << ray.shift));
    LogOdds& value = tile_.cells[at];
    const float change = weight * increment;
    const int sum = value + static_cast<int>(change + std::copysign(0.5F, change));
    const auto after = static_cast<LogOdds>(std::clamp(sum, -clamp, clamp));
    if (after == value) continue;
    value = after;
    changed_from = std::min(changed_from, x);
    changed_to = x + 1;
  }
  if (changed_from < changed_to) changed.add(span.y, changed_from, changed_to);
}

}  // namespace cairn::muriel

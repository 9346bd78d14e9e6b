#include "plugins/muriel/muriel.hpp"

#include <algorithm>
#include <cmath>

#include "plugins/muriel/plain_muriel.hpp"
#include "plugins/sonar_model/reading.hpp"

namespace cairn::muriel {
namespace {

KernelReading kernel_reading(const Config& config, const PlacedReading& reading) {
  const double half_beam = reading.beam.half_beam_rad;
  const Point ahead = reading.beam.T_map_sensor.direction();
  KernelReading result;
  result.ahead_x = static_cast<float>(ahead.x());
  result.ahead_y = static_cast<float>(ahead.y());
  result.is_ray = half_beam <= 0.0;
  result.per_half_beam2 = result.is_ray ? 0.0F : static_cast<float>(1.0 / (half_beam * half_beam));
  result.alpha_max = static_cast<float>(config.alpha_max);
  result.per_alpha_range = static_cast<float>(1.0 / config.alpha_range_m);
  result.delta_m = static_cast<float>(config.delta_m);
  result.delta_per_m = static_cast<float>(config.delta_per_m);
  result.range_m = static_cast<float>(std::min(reading.range_m, 1e6));
  result.reach_m = static_cast<float>(reading.beam.reach_m);
  result.is_echo = reading.is_echo;
  return result;
}

int rounded(float quanta) {
  return static_cast<int>(quanta + (quanta < 0.0F ? -0.5F : 0.5F));
}

}  // namespace

Muriel::Muriel(const Config& config)
    : config_(config),
      weights_(weights_of(config)),
      believed_(log_odds_of(config.believed_p)),
      grid_(config.cell_m, config.clamp_nat),
      pieces_(config.log == LogPolicy::off ? 0 : config.log_bearings) {
  for (int l = believed_; l <= grid_.clamp_quanta(); ++l)
    probability_.push_back(static_cast<float>(probability_of(static_cast<LogOdds>(l))));
}

const CellChanges& Muriel::integrate(const Observation& observation, const PoseEstimate& pose) {
  changes_.spans.clear();
  if (!sonar_model::is_finite(pose.T_map_robot)) return changes_;
  for (const RangeReading& reading : observation.ranges)
    if (const auto news = placed(config_, reading, pose.T_map_robot)) integrate_reading(*news);
  sonar_model::tidy(changes_.spans);
  return changes_;
}

void Muriel::integrate_reading(const PlacedReading& reading) {
  if (reading.beam.half_beam_rad > kWidestFastHalfBeam_rad)
    return integrate_plainly(config_, reading, grid_, log_, spans_, changes_.spans);
  place_cells(reading);
  evaluate_cells(kernel_reading(config_, reading), dx_m_, dy_m_, pieces_.cells(), cells_);
  const double s = config_.specular ? specular_p(reading) : 0.0;
  weigh_cells(cells_.miss, cells_.hit_per_m, static_cast<float>(1.0 - s),
              static_cast<float>(1.0 / config_.false_echo_per_m), pieces_.cells(), increments_);
  apply();
}

void Muriel::place_cells(const PlacedReading& reading) {
  pieces_.cover(reading.beam, config_.cell_m);
  const auto count = static_cast<std::size_t>(pieces_.cells());
  constexpr std::size_t kArrays = 8;
  if (scratch_.size() < kArrays * count) scratch_.resize(kArrays * count);
  float* next = scratch_.data();
  for (float** array : {&dx_m_, &dy_m_, &increments_, &cells_.range_m, &cells_.off_axis, &cells_.alpha, &cells_.miss,
                        &cells_.hit_per_m})
    next = (*array = next) + count;

  std::size_t at = 0;
  const auto step = static_cast<float>(config_.cell_m);
  for (const Piece& piece : pieces_.pieces()) {
    const auto dx = static_cast<float>((piece.first.x + 0.5) * config_.cell_m - reading.beam.T_map_sensor.x_m);
    const auto dy = static_cast<float>((piece.first.y + 0.5) * config_.cell_m - reading.beam.T_map_sensor.y_m);
    for (int i = 0; i < piece.cells; ++i, ++at) {
      dx_m_[at] = dx + step * static_cast<float>(i);
      dy_m_[at] = dy;
    }
  }
}

double Muriel::specular_p(const PlacedReading& reading) {
  KnownTargets targets(config_.specular_sectors);
  const auto range_m = static_cast<float>(reading.range_m);
  std::size_t at = 0;
  for (const Piece& piece : pieces_.pieces()) {
    const std::span<const LogOdds> run = grid_.run_from(piece.first);
    const auto cells = static_cast<std::size_t>(piece.cells);
    for (std::size_t i = 0; !run.empty() && i < cells; ++i) {
      const LogOdds log_odds = run[i];
      if (log_odds < believed_) continue;
      const std::size_t k = at + i;
      const float p = probability_[static_cast<std::size_t>(log_odds - believed_)];
      const auto delta = static_cast<float>(config_.delta(cells_.range_m[k]));
      if (cells_.range_m[k] < range_m - 3.0F * delta) targets.add_blocker(cells_.off_axis[k], p * cells_.alpha[k]);
      targets.add_source(cells_.off_axis[k], p * cells_.hit_per_m[k]);
    }
    at += cells;
  }
  return targets.specular_p(config_, reading.is_echo);
}

void Muriel::apply() {
  const float* increments = increments_;
  for (const Piece& piece : pieces_.pieces()) {
    int begin = 0;
    int end = piece.cells;
    while (begin < end && rounded(increments[begin]) == 0) ++begin;  // 0 must not grow the grid
    while (begin < end && rounded(increments[end - 1]) == 0) --end;
    if (begin < end)
      apply_piece({{piece.first.x + begin, piece.first.y}, end - begin, piece.bucket}, increments + begin);
    increments += piece.cells;
  }
}

void Muriel::apply_piece(const Piece& piece, const float* increments) {
  LogOdds* const cells = grid_.run_for_writing(piece.first, piece.cells).data();
  const int clamp = grid_.clamp_quanta();
  LogWord* const words = config_.log == LogPolicy::off ? nullptr : &log_.word_for_writing(piece.first);
  const std::array<float, 4> weights{static_cast<float>(weights_[0]), static_cast<float>(weights_[1]),
                                     static_cast<float>(weights_[2]), static_cast<float>(weights_[3])};
  int first = piece.cells;
  int last = -1;
  for (int i = 0; i < piece.cells; ++i) {
    float change = increments[i];
    if (words != nullptr) {
      const float weight = weights[static_cast<std::size_t>(count_in(words[i], piece.bucket))];
      const bool counts = weight > 0.0F && rounded(change) != 0;
      words[i] += static_cast<LogWord>(counts) << (2 * piece.bucket);
      change = counts ? change * weight : 0.0F;
    }
    const int value = std::clamp(cells[i] + rounded(change), -clamp, clamp);
    if (value == cells[i]) continue;
    cells[i] = static_cast<LogOdds>(value);
    first = std::min(first, i);
    last = i;
  }
  if (last >= 0) changes_.spans.push_back({piece.first.y, piece.first.x + first, piece.first.x + last + 1});
}

}  // namespace cairn::muriel

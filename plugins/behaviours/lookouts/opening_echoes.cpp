#include "plugins/behaviours/lookouts/opening_echoes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn::behaviours {

void OpeningEchoSettings::describe(Fields<OpeningEchoSettings>& fields) {
  using C = OpeningEchoSettings;
  fields.number("beam_ratio", &C::beam_ratio, {0.0, 1.0}, "", "share of a beam in which nothing nearer can have stood");
  fields.number("behind_m", &C::behind_m, {0.0, 5.0}, "m", "an echo from this far behind an opening has passed it");
  fields.number("bin_m", &C::bin_m, {0.005, 0.5}, "m", "echoes are counted in parts of this length along an opening");
  fields.number("aside_m", &C::aside_m, {0.1, 10.0}, "m", "and within this of its middle");
  fields.number("gap_m", &C::gap_m, {0.0, 1.0}, "m", "parts without echoes that are no longer than this do not count");
  fields.number("off_middle_m", &C::off_middle_m, {0.0, 5.0}, "m",
                "the middle of the open part may be this far from where the map has it");
  fields.integer("min_passes", &C::min_passes, {1.0, 1000.0}, "a part is open that so many echoes have passed");
  fields.integer("min_silent", &C::min_silent, {1.0, 1000.0}, "or where straight beams were silent so often");
}

void OpeningEchoes::begin(const Point& at_m, const Point& from_m) {
  const Point ahead = at_m - from_m;
  from_m_ = from_m;
  T_map_opening_ = {at_m.x(), at_m.y(), std::atan2(ahead.y(), ahead.x())};
  is_heard_ = false;
  passes_.assign(static_cast<std::size_t>(std::ceil(2.0 * settings_.aside_m / settings_.bin_m)), 0);
  silent_ = passes_;
  echoed_.clear();
}

void OpeningEchoes::see(const Observation& observation, const Pose2& T_map_robot) {
  for (const RangeReading& reading : observation.ranges) {
    const bool is_silent = reading.range_m >= reading.max_m;
    if (!is_silent && !(reading.range_m > reading.min_m)) continue;
    if (!is_silent && !has_echoed(reading.sensor)) echoed_.push_back(reading.sensor);
    const Pose2 T_opening_sensor = inverse(T_map_opening_) * (T_map_robot * reading.T_robot_sensor);
    const double half_rad = settings_.beam_ratio * reading.half_beam_rad;
    const double before_m = -T_opening_sensor.x_m;
    const double left_rad = wrap_angle(T_opening_sensor.theta_rad) + half_rad;
    const double right_rad = wrap_angle(T_opening_sensor.theta_rad) - half_rad;
    constexpr double kMaxOff_rad = 0.45 * std::numbers::pi;
    if (before_m <= 0.0 || left_rad > kMaxOff_rad || right_rad < -kMaxOff_rad) continue;
    const bool is_straight = right_rad <= 0.0 && left_rad >= 0.0;
    if (is_silent && (!is_straight || !has_echoed(reading.sensor))) continue;
    is_heard_ = true;
    // The nearest that it can have come from within the beam.
    const double reach_m = std::min(reading.range_m, reading.max_m) * std::min(std::cos(left_rad), std::cos(right_rad));
    if (reach_m < before_m + settings_.behind_m) continue;
    pass(T_opening_sensor.y_m + before_m * std::tan(right_rad), T_opening_sensor.y_m + before_m * std::tan(left_rad),
         is_silent ? silent_ : passes_);
  }
}

void OpeningEchoes::pass(double from_m, double to_m, std::vector<int>& passes) const {
  const double last = static_cast<double>(passes.size()) - 1.0;
  const double first_bin = std::floor((from_m + settings_.aside_m) / settings_.bin_m);
  const double last_bin = std::floor((to_m + settings_.aside_m) / settings_.bin_m);
  if (last_bin < 0.0 || first_bin > last) return;
  for (auto i = static_cast<std::size_t>(std::max(0.0, first_bin));
       i <= static_cast<std::size_t>(std::min(last, last_bin)); ++i)
    ++passes[i];
}

// A single echo may have come from another transducer, and shifts the middle of what was heard.
double OpeningEchoes::surer_middle_m(std::size_t first, std::size_t last) const {
  const auto is_sure = [&](std::size_t i) { return passes_[i] + silent_[i] > settings_.min_passes; };
  std::size_t left = first;
  std::size_t right = last;
  while (left < right && !is_sure(left)) ++left;
  while (right > left && !is_sure(right)) --right;
  if (left == right) return 0.5 * (middle_of(first) + middle_of(last));
  return 0.5 * (middle_of(left) + middle_of(right));
}

HeardOpening OpeningEchoes::heard() const {
  HeardOpening opening;
  opening.middle_m = T_map_opening_.position();
  opening.from_m = from_m_;
  opening.is_heard = is_heard_;
  const auto is_open = [&](std::size_t i) {
    return passes_[i] >= settings_.min_passes || silent_[i] >= settings_.min_silent;
  };
  const auto max_gap = static_cast<std::size_t>(settings_.gap_m / settings_.bin_m + 1e-9);
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    if (!is_open(i)) continue;
    std::size_t last = i;
    for (std::size_t k = i; k < passes_.size() && k <= last + max_gap + 1; ++k)
      if (is_open(k)) last = k;
    const double from_m = middle_of(i) - 0.5 * settings_.bin_m;
    const double to_m = middle_of(last) + 0.5 * settings_.bin_m;
    const double middle_m = surer_middle_m(i, last);
    i = last;
    if (std::abs(middle_m) > settings_.off_middle_m || to_m - from_m <= opening.width_m) continue;
    opening.width_m = to_m - from_m;
    opening.middle_m = T_map_opening_ * Point{0.0, middle_m};
  }
  return opening;
}

}  // namespace cairn::behaviours

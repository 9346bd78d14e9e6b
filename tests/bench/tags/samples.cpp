#include "tests/bench/tags/samples.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <span>

#include "framework/experiments/statistics.hpp"

namespace cairn {
namespace {

constexpr double kSidesApart_rad = radians(10.0);  // below that slant the two sides are nearly the same

using Samples = std::vector<const TagSample*>;
using Figure = std::function<double(const Samples&)>;

struct Bin {
  std::string name;
  std::function<bool(const TagSample&)> holds;
};

Bin distance_bin(double from_m, double to_m) {
  return {fmt::format("{:g} to {:g} m", from_m, to_m),
          [=](const TagSample& s) { return s.distance_m >= from_m && s.distance_m < to_m; }};
}

Bin slant_bin(double from_deg, double to_deg) {
  return {fmt::format("up to 3 m, {:g} to {:g} deg aslant", from_deg, to_deg), [=](const TagSample& s) {
            const double slant_deg = degrees(std::abs(s.slant_rad));
            return s.distance_m < 3.0 && slant_deg >= from_deg && slant_deg < to_deg;
          }};
}

const std::vector<Bin>& bins() {
  static const std::vector<Bin> kBins{distance_bin(0.0, 1.0), distance_bin(1.0, 2.0), distance_bin(2.0, 3.0),
                                      distance_bin(3.0, 4.0), slant_bin(0.0, 15.0),   slant_bin(15.0, 30.0),
                                      slant_bin(30.0, 45.0),  slant_bin(45.0, 60.1),  distance_bin(0.0, 3.0)};
  return kBins;
}

Samples in_bin(const std::vector<TagSample>& samples, const Bin& bin, bool only_found = true) {
  Samples chosen;
  for (const TagSample& sample : samples)
    if (bin.holds(sample) && (sample.is_found || !only_found)) chosen.push_back(&sample);
  return chosen;
}

// Resampled by homes.
Interval over_homes(const Samples& samples, const Figure& figure) {
  std::map<int, Samples> by_home;
  for (const TagSample* sample : samples) by_home[sample->home].push_back(sample);
  std::vector<Samples> homes;
  homes.reserve(by_home.size());
  for (auto& [home, of_home] : by_home) homes.push_back(std::move(of_home));
  return resampled(homes.size(), [&](std::span<const std::size_t> taken) {
    Samples all;
    for (const std::size_t i : taken) all.insert(all.end(), homes[i].begin(), homes[i].end());
    return figure(all);
  });
}

template <class Of>
Figure share(Of of) {
  return [of](const Samples& samples) {
    const auto count = std::ranges::count_if(samples, [&](const TagSample* s) { return of(*s); });
    return samples.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(samples.size());
  };
}

template <class Of>
Figure quantile(double at, Of of) {
  return [at, of](const Samples& samples) {
    std::vector<double> values;
    values.reserve(samples.size());
    for (const TagSample* sample : samples) values.push_back(of(*sample));
    if (values.empty()) return 0.0;
    const auto rank = static_cast<std::ptrdiff_t>(at * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, values.begin() + rank);
    return values[static_cast<std::size_t>(rank)];
  };
}

std::string error_cells(const Samples& samples, PoseError TagSample::*which) {
  const auto position_mm = [which](const TagSample& s) { return 1000.0 * (s.*which).position_m; };
  const auto direction_deg = [which](const TagSample& s) { return degrees(std::abs((s.*which).direction_rad)); };
  return fmt::format(" {}; {:.0f} | {}; {:.1f} |", text_of(over_homes(samples, quantile(0.5, position_mm)), 1),
                     quantile(0.95, position_mm)(samples),
                     text_of(over_homes(samples, quantile(0.5, direction_deg)), 2),
                     quantile(0.95, direction_deg)(samples));
}

std::string coverage_cells(const Samples& samples, Normalized TagSample::*which) {
  std::string text;
  for (const auto component : {&Normalized::along, &Normalized::across, &Normalized::direction}) {
    const auto within = [=](double sigmas) {
      return share([=](const TagSample& s) { return std::abs((s.*which).*component) <= sigmas; })(samples);
    };
    text += fmt::format(" {:.2f}, {:.2f} |", within(1.0), within(2.0));
  }
  return text + fmt::format(" {:.1f} |", quantile(0.5, [=](const TagSample& s) { return (s.*which).nees; })(samples));
}

}  // namespace

PoseError error_of(const Pose2& T_robot_marker, const Pose2& truth, const Point& eye_m) {
  const Point to_eye_m = eye_m - truth.position();
  const double sight_rad = std::atan2(to_eye_m.y(), to_eye_m.x());
  const double off_rad = wrap_angle(T_robot_marker.theta_rad - truth.theta_rad);
  const double mirrored_rad = wrap_angle(2.0 * sight_rad - truth.theta_rad);
  const double off_mirrored_rad = wrap_angle(T_robot_marker.theta_rad - mirrored_rad);
  return {(T_robot_marker.position() - truth.position()).norm(), off_rad,
          std::abs(wrap_angle(truth.theta_rad - sight_rad)) > kSidesApart_rad &&
              std::abs(off_mirrored_rad) < std::abs(off_rad)};
}

Normalized normalized(const MarkerPose& pose, const Pose2& truth, const Point& eye_m) {
  const Pose2& seen = pose.T_robot_marker;
  const Eigen::Vector3d error(seen.x_m - truth.x_m, seen.y_m - truth.y_m, wrap_angle(seen.theta_rad - truth.theta_rad));
  const Point sight = (truth.position() - eye_m).normalized();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  axes.topLeftCorner<2, 2>() << sight.x(), sight.y(), -sight.y(), sight.x();
  const Eigen::Vector3d turned = axes * error;
  const Eigen::Vector3d sigma = (axes * pose.covariance * axes.transpose()).diagonal().cwiseSqrt();
  return {turned[0] / sigma[0], turned[1] / sigma[1], turned[2] / sigma[2],
          error.dot(pose.covariance.ldlt().solve(error))};
}

std::string found_table(const std::vector<TagSample>& samples) {
  std::string text = "| tags within sight | in pictures | found |\n|---|---:|---:|\n";
  for (const Bin& bin : bins()) {
    const Samples all = in_bin(samples, bin, false);
    const Interval found = over_homes(all, share([](const TagSample& s) { return s.is_found; }));
    text += fmt::format("| {} | {} | {} |\n", bin.name, all.size(), text_of(found, 4));
  }
  return text;
}

std::string errors_table(const std::vector<TagSample>& samples) {
  std::string text =
      "| tags within sight | sightings | position mm, median; 95 % | direction deg, median; 95 % | better of two kept: "
      "position | direction | libapriltag: position | direction |\n|---|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const Bin& bin : bins()) {
    const Samples found = in_bin(samples, bin);
    text += fmt::format("| {} | {} |", bin.name, found.size()) + error_cells(found, &TagSample::ours) +
            error_cells(found, &TagSample::ours_kept) + error_cells(found, &TagSample::raw) + "\n";
  }
  return text;
}

std::string sides_table(const std::vector<TagSample>& samples) {
  std::string text =
      "| tags within sight, 10 deg or more aslant | sightings | both sides kept | first pose on the wrong side | only "
      "pose on the wrong side | libapriltag on the wrong side |\n|---|---:|---:|---:|---:|---:|\n";
  for (const Bin& bin : bins()) {
    Samples found = in_bin(samples, bin);
    std::erase_if(found, [](const TagSample* s) { return std::abs(s->slant_rad) < kSidesApart_rad; });
    const auto cell = [&](const Figure& figure) { return text_of(over_homes(found, figure), 4); };
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", bin.name, found.size(),
                        cell(share([](const TagSample& s) { return s.keeps_two; })),
                        cell(share([](const TagSample& s) { return s.ours.is_flipped; })),
                        cell(share([](const TagSample& s) { return s.ours.is_flipped && !s.keeps_two; })),
                        cell(share([](const TagSample& s) { return s.raw.is_flipped; })));
  }
  return text;
}

std::string coverage_table(const std::vector<TagSample>& samples) {
  std::string text =
      "| tags within sight | along the line of sight, within 1 and 2 sigma | across | direction | NEES, median | by "
      "the "
      "corners' noise alone: along | across | direction | NEES, median "
      "|\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const Bin& bin : bins()) {
    const Samples found = in_bin(samples, bin);
    text += "| " + bin.name + " |" + coverage_cells(found, &TagSample::with_floor) +
            coverage_cells(found, &TagSample::of_corners) + "\n";
  }
  return text +
         "| normal errors | 0.68, 0.95 | 0.68, 0.95 | 0.68, 0.95 | 2.4 | 0.68, 0.95 | 0.68, 0.95 | 0.68, 0.95 | "
         "2.4 |\n";
}

}  // namespace cairn

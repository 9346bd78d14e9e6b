#include "framework/reporting/marker_figures.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace cairn {
namespace {

constexpr double kApart_m = 0.15;      // between places that count
constexpr double kVisitEnds_s = 10.0;  // without a sighting
constexpr double kMinSpread_m2 = 1.0;  // of the offsets, summed up
constexpr std::size_t kMinSightings = 10;
constexpr double kMaxRangeError = 0.04;  // of the ratio, from one
constexpr double kMaxReprojection_px = 1.0;

}  // namespace

MarkerFigures::Visit* MarkerFigures::visit(const MarkerId& marker, double time_s) {
  std::vector<Visit>& visits = visits_[marker];
  if (visits.empty() || time_s > visits.back().last_s + kVisitEnds_s) {
    if (visits.size() >= kMaxVisits) return nullptr;
    visits.emplace_back();
  }
  visits.back().last_s = time_s;
  return &visits.back();
}

void MarkerFigures::note(const WorldView& world) {
  if (world.observation == nullptr || world.pose.trust == PoseTrust::lost) return;
  for (const MarkerSighting& sighting : world.observation->markers) {
    ++sightings_;
    squares_px2_ += sighting.pose.reprojection_error_px * sighting.pose.reprojection_error_px;
    Visit* const now = visit(sighting.marker, world.time_s);
    if (now == nullptr) continue;
    std::vector<Seen>& seen = now->seen;
    const Point robot_m = world.pose.T_map_robot.position();
    const bool is_near = !seen.empty() && (seen.back().robot_m - robot_m).norm() < kApart_m;
    if (is_near || seen.size() >= kMaxSeen) continue;
    seen.push_back({robot_m, world.pose.T_map_robot * sighting.pose.T_robot_marker.position() - robot_m});
  }
}

double MarkerFigures::reprojection_error_px() const {
  return sightings_ == 0 ? 0.0 : std::sqrt(squares_px2_ / static_cast<double>(sightings_));
}

std::optional<double> MarkerFigures::range_ratio() const {
  double against = 0.0;
  double spread_m2 = 0.0;
  std::size_t count = 0;
  for (const auto& [marker, visits] : visits_)
    for (const auto& [last_s, seen] : visits) {
      Seen mean{{0.0, 0.0}, {0.0, 0.0}};
      for (const Seen& one : seen) {
        mean.robot_m += one.robot_m / static_cast<double>(seen.size());
        mean.offset_m += one.offset_m / static_cast<double>(seen.size());
      }
      for (const Seen& one : seen) {
        against -= (one.robot_m - mean.robot_m).dot(one.offset_m - mean.offset_m);
        spread_m2 += (one.offset_m - mean.offset_m).squaredNorm();
      }
      count += seen.size();
    }
  if (spread_m2 < kMinSpread_m2 || count < kMinSightings) return std::nullopt;
  return against / spread_m2;
}

std::string MarkerFigures::json() const {
  const auto rounded = [](double value) { return std::round(value * 1e6) / 1e6; };
  nlohmann::ordered_json figures = {
      {"markers", markers()}, {"sightings", sightings()}, {"reprojection_error_px", rounded(reprojection_error_px())}};
  if (const auto ratio = range_ratio()) figures["range_ratio"] = rounded(*ratio);
  if (const std::string sentence = warning(); !sentence.empty()) figures["warning"] = sentence;
  return figures.dump();
}

std::string MarkerFigures::warning() const {
  if (const auto ratio = range_ratio(); ratio && std::abs(*ratio - 1.0) > kMaxRangeError)
    return fmt::format(
        "markers are {:.2f} times as far away as the pictures say: the camera's focal_px or the markers' size_m is "
        "wrong by that ratio",
        *ratio);
  if (sightings_ >= kMinSightings && reprojection_error_px() > kMaxReprojection_px)
    return fmt::format(
        "the corners of markers are {:.1f} pixels from where the camera's description has them: its distortion, "
        "centre_px or tilt_deg is wrong",
        reprojection_error_px());
  return {};
}

}  // namespace cairn

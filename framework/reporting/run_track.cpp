#include "framework/reporting/run_track.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "framework/reporting/plan_end.hpp"
#include "maps/base/base64.hpp"

namespace cairn {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxPlanPoints = 200'000;  // of all plans
constexpr std::size_t kMaxPointsOfAPlan = 200;
constexpr std::size_t kMaxRangeSamples = 1000;
constexpr std::size_t kMaxRanges = 60;  // of a sample

double track_rounded(double value, double per_unit) {
  return std::isfinite(value) ? std::round(value * per_unit) / per_unit : 0.0;
}

// Tenths of a millimetre, of a milliradian and of a millisecond.
double track_number(double value) {
  return track_rounded(value, 1e4);
}

// Centimetres and centiradians; what is no range is left out.
Json json_of(const std::vector<ShownRange>& ranges) {
  Json list = Json::array();
  for (const auto& [time_s, T_map_sensor, reading] : ranges) {
    const double range_m = reading.range_m;
    if (std::isnan(range_m) || range_m < 0.0) continue;
    list.push_back({track_rounded(T_map_sensor.x_m, 1e2), track_rounded(T_map_sensor.y_m, 1e2),
                    track_rounded(T_map_sensor.theta_rad, 1e2), track_rounded(reading.half_beam_rad, 1e2),
                    track_rounded(std::isfinite(range_m) ? range_m : -reading.max_m, 1e2)});
  }
  return list;
}

std::span<const std::uint8_t> bytes_in(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::vector<Point> thinned_path(const std::vector<Point>& path) {
  const std::size_t every = (path.size() + kMaxPointsOfAPlan - 1) / kMaxPointsOfAPlan;
  std::vector<Point> points;
  for (std::size_t i = 0; i < path.size(); i += every) points.push_back(path[i]);
  if (!path.empty() && points.back() != path.back()) points.push_back(path.back());
  return points;
}

std::vector<Point> points_of(const std::vector<Pose2>& path) {
  std::vector<Point> points;
  points.reserve(path.size());
  for (const Pose2& pose : path) points.push_back(pose.position());
  return points;
}

}  // namespace

RunTrack::RunTrack(const HistoryConfig& history)
    : max_events_(history.max_events),
      poses_(history.max_samples),
      last_ranges_(kMaxRanges),
      ranges_(std::min(history.max_samples, kMaxRangeSamples)) {}

void RunTrack::on(const Event& event, const MissionView& view) {
  const double time_s = view.world.time_s;
  if (!plans_.empty() && !plans_.back().points.empty() &&
      is_end_of_plan(event, view.world, plans_.back().points.back()))
    note_plan({time_s});
  robot_radius_m_ = view.world.robot.radius_m;
  if (const auto* const tick = std::get_if<TickDone>(&event)) {
    const Eigen::Matrix3d& covariance = view.world.pose.covariance;
    poses_.add({time_s, view.world.pose.T_map_robot, {covariance(0, 0), covariance(0, 1), covariance(1, 1)}});
    note_ranges(view.world);
    return grid_.note(time_s, view.world.grid, tick->changes);
  }
  if (const auto* const plan = std::get_if<PlanDone>(&event))
    note_plan({time_s, thinned_path(points_of(plan->result.path)), true});
  const bool is_under_way = !plans_.empty() && !plans_.back().points.empty() && plans_.back().is_from_planner;
  if (const auto* const started = std::get_if<PathStarted>(&event); started != nullptr && !is_under_way)
    note_plan({time_s, thinned_path(started->path)});
  if (landmarks_.size() >= max_events_) return;
  if (const auto* const change = std::get_if<LandmarkChanged>(&event); change != nullptr && change->is_new)
    landmarks_.push_back({time_s, change->landmark.id, false});
  if (const auto* const retired = std::get_if<LandmarkRetired>(&event))
    landmarks_.push_back({time_s, retired->landmark.id, true});
}

void RunTrack::note_ranges(const WorldView& world) {
  const bool is_wanted = ranges_.wants_next();
  if (world.observation != nullptr && (is_wanted || LastRanges::fire_in_turn(*world.observation)))
    last_ranges_.note(world);
  if (is_wanted)
    ranges_.add({world.time_s, last_ranges_.ranges()});
  else
    ranges_.skip();
}

void RunTrack::note_plan(Plan plan) {
  if (plans_.size() >= max_events_ || plan_points_ + plan.points.size() > kMaxPlanPoints) return;
  plan_points_ += plan.points.size();
  plans_.push_back(std::move(plan));
}

std::string RunTrack::json() const {
  Json track{{"robot_radius_m", track_number(robot_radius_m_)},
             {"poses_every", poses_.every()},
             {"poses", Json::array()},
             {"plans", Json::array()},
             {"landmarks", Json::array()},
             {"grid", Json::array()},
             {"ranges", Json::array()}};
  for (const Sample& sample : poses_.samples())
    track["poses"].push_back({track_number(sample.time_s), track_number(sample.T_map_robot.x_m),
                              track_number(sample.T_map_robot.y_m), track_number(sample.T_map_robot.theta_rad),
                              track_rounded(sample.covariance_m2[0], 1e6), track_rounded(sample.covariance_m2[1], 1e6),
                              track_rounded(sample.covariance_m2[2], 1e6)});
  for (const Plan& plan : plans_) {
    Json points = Json::array();
    for (const Point& point : plan.points) points.push_back({track_number(point.x()), track_number(point.y())});
    track["plans"].push_back({{"time_s", track_number(plan.time_s)}, {"points", std::move(points)}});
  }
  for (const Change& change : landmarks_)
    track["landmarks"].push_back({{"time_s", track_number(change.time_s)},
                                  {"id", change.id},
                                  {"change", change.is_retired ? "retired" : "found"}});
  for (const GridDelta& delta : grid_.deltas()) {
    Json tiles = Json::array();
    for (const auto& [tile, packed] : delta.packed_ol) tiles.push_back({tile.x, tile.y, base64(bytes_in(packed))});
    track["grid"].push_back({{"time_s", track_number(delta.time_s)}, {"tiles", std::move(tiles)}});
  }
  for (const auto& [time_s, ranges] : ranges_.samples()) {
    if (ranges.empty()) continue;
    Json sample{track_number(time_s)};
    for (Json& range : json_of(ranges)) sample.push_back(std::move(range));
    track["ranges"].push_back(std::move(sample));
  }
  return track.dump() + "\n";
}

}  // namespace cairn

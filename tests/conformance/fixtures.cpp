#include "tests/conformance/fixtures.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::conformance {
namespace {

constexpr double kRoomX_m = 6.0;
constexpr double kRoomY_m = 5.0;
constexpr double kPostRadius_m = 0.5 * kPostDiameter_m;
const Point kPost_m = kPostOfRoom.position();
constexpr double kStep_m = 0.1;
constexpr double kStep_rad = radians(30.0);
constexpr double kSpeed_mps = 0.2;
constexpr double kTurn_radps = radians(60.0);
constexpr LogOdds kSure = 1000;
// The ring of occupied cells that ideal templates are drawn with; a tie counts as free.
constexpr double kRingOutside_cells = 1.0 - 1e-6;
constexpr double kRingInside_cells = -1.5;

// Along a ray from inside the room, to the walls or to the post.
double distance_along(const Pose2& T_map_sensor) {
  const Point from = T_map_sensor.position();
  const Point ahead = T_map_sensor.direction();
  double nearest_m = kInfinity;
  const auto meet = [&](double gap_m, double rate) {
    if (gap_m / rate >= 0.0) nearest_m = std::min(nearest_m, gap_m / rate);
  };
  if (ahead.x() != 0.0) meet((ahead.x() > 0.0 ? kRoomX_m : 0.0) - from.x(), ahead.x());
  if (ahead.y() != 0.0) meet((ahead.y() > 0.0 ? kRoomY_m : 0.0) - from.y(), ahead.y());
  const Point to_post = kPost_m - from;
  const double along_m = to_post.dot(ahead);
  const double aside2 = to_post.squaredNorm() - along_m * along_m;
  if (along_m > 0.0 && aside2 < kPostRadius_m * kPostRadius_m)
    nearest_m = std::min(nearest_m, along_m - std::sqrt(kPostRadius_m * kPostRadius_m - aside2));
  return nearest_m;
}

// Forward or turning on the spot, in even steps.
class Orbit {
 public:
  explicit Orbit(const RobotModel& robot) : robot_(robot) { observe(0.0); }

  void forward(double distance_m) {
    for (int i = 0; i < std::lround(distance_m / kStep_m); ++i) {
      T_map_robot_ = T_map_robot_ * Pose2{kStep_m, 0.0, 0.0};
      observe(kStep_m / kSpeed_mps);
    }
  }
  void turn(double angle_rad) {
    for (int i = 0; i < std::lround(angle_rad / kStep_rad); ++i) {
      T_map_robot_ = T_map_robot_ * Pose2{0.0, 0.0, kStep_rad};
      observe(kStep_rad / kTurn_radps);
    }
  }
  [[nodiscard]] const std::vector<DriveStep>& steps() const { return steps_; }

 private:
  void observe(double took_s) {
    stamp_s_ += took_s;
    steps_.push_back({seen_in_room(T_map_robot_, stamp_s_, robot_), T_map_robot_});
  }

  const RobotModel& robot_;
  Pose2 T_map_robot_ = kRoomStart;
  double stamp_s_ = 0.0;
  std::vector<DriveStep> steps_;
};

}  // namespace

RobotModel eight_sonar_robot() {
  RobotModel robot;
  robot.name = "eight sonars";
  for (const double angle_deg : {90.0, 45.0, 15.0, -15.0, -45.0, -90.0, -150.0, 150.0}) {
    SonarModel sonar;
    const Pose2 turned{0.0, 0.0, radians(angle_deg)};
    sonar.T_robot_sonar = turned * Pose2{0.15, 0.0, 0.0};
    robot.sonars.push_back(sonar);
  }
  robot.odometry_error = {0.01, 0.0, radians(0.5)};
  robot.compass_error.noise_rad = radians(2.0);
  return robot;
}

World room() {
  World world;
  world.max_m = {kRoomX_m, kRoomY_m};
  world.walls = {{{{0.0, 0.0}, {kRoomX_m, 0.0}, {kRoomX_m, kRoomY_m}, {0.0, kRoomY_m}, {0.0, 0.0}}, Surface::rough}};
  world.objects = {{"", Contour::circle(2.0 * kPostRadius_m), {kPost_m.x(), kPost_m.y(), 0.0}, Surface::rough}};
  return world;
}

OccupancyGrid grid_of_room(double cell_m) {
  OccupancyGrid grid(cell_m);
  const Cell corner = grid.cell_at({kRoomX_m + 0.5 * cell_m, kRoomY_m + 0.5 * cell_m});
  for (int y = -1; y <= corner.y; ++y)
    for (int x = -1; x <= corner.x; ++x) {
      const Point at = grid.centre_of({x, y});
      const bool is_floor = at.x() > 0.0 && at.y() > 0.0 && at.x() < kRoomX_m && at.y() < kRoomY_m;
      const bool is_post = (at - kPost_m).norm() < kPostRadius_m;
      grid.set_log_odds({x, y}, is_floor && !is_post ? static_cast<LogOdds>(-kSure) : kSure);
    }
  return grid;
}

Observation seen_in_room(const Pose2& T_map_robot, double stamp_s, const RobotModel& robot) {
  Observation seen;
  seen.stamp_s = stamp_s;
  seen.T_odom_robot = inverse(kRoomStart) * T_map_robot;
  seen.compass_rad = T_map_robot.theta_rad;
  for (std::size_t i = 0; i < robot.sonars.size(); ++i) {
    const SonarModel& sonar = robot.sonars[i];
    const double range_m = distance_along(T_map_robot * sonar.T_robot_sonar);
    seen.ranges.push_back({sonar.T_robot_sonar, sonar.half_beam_rad, sonar.min_m, sonar.max_m,
                           range_m < sonar.min_m   ? -kInfinity
                           : range_m > sonar.max_m ? kInfinity
                                                   : range_m,
                           static_cast<int>(i)});
  }
  return seen;
}

std::vector<DriveStep> drive_through_room(const RobotModel& robot) {
  Orbit orbit(robot);
  for (const double side_m : {4.0, 3.0, 4.0, 3.0}) {
    orbit.forward(side_m);
    orbit.turn(radians(90.0));
  }
  return orbit.steps();
}

TemplateSet three_templates() {
  const std::vector<LandmarkShape> shapes{
      {"circle", Contour::circle(0.5)},
      {"square", Contour::polygon({{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}})},
      {"triangle", Contour::polygon({{0.0, 0.0}, {0.6, 0.0}, {0.3, 0.3 * std::sqrt(3.0)}})}};
  return render_ideal_set(shapes, radians(15.0), 0.05);
}

OccupancyGrid grid_with_landmark(const LandmarkShape& shape, const Pose2& T_map_landmark, double cell_m) {
  OccupancyGrid grid(cell_m);
  const Point at_m = T_map_landmark.position();
  const Cell low = grid.cell_at(at_m - Point(1.5, 1.5));
  const Cell high = grid.cell_at(at_m + Point(1.5, 1.5));
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      const double out_m = shape.contour.signed_distance(inverse(T_map_landmark) * grid.centre_of({x, y}));
      const bool is_free = out_m > kRingOutside_cells * cell_m;
      const bool is_unseen = out_m < kRingInside_cells * cell_m;
      grid.set_log_odds({x, y}, is_free ? static_cast<LogOdds>(-kSure) : is_unseen ? LogOdds{0} : kSure);
    }
  return grid;
}

CellChanges everything_changed(const OccupancyGrid& grid) {
  CellChanges changes;
  const CellBox box = grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y) changes.spans.push_back({y, box.min.x, box.max.x});
  return changes;
}

std::vector<OddReading> odd_readings() {
  const RangeReading plain{{}, radians(15.0), 0.1, 5.0, 2.0, 0};
  std::vector<OddReading> odd;
  const auto add = [&](const std::string& what, auto change) {
    odd.push_back({what, plain});
    change(odd.back().reading);
  };
  for (const double range_m : {kNan, kInfinity, -kInfinity, -1.0, 0.0, 0.05, 5.0, 7.0, kHuge, -kHuge})
    add("range_m " + std::to_string(range_m), [&](RangeReading& r) { r.range_m = range_m; });
  for (const double max_m : {0.0, -1.0, kNan, kInfinity, kHuge}) {
    add("an echo and max_m " + std::to_string(max_m), [&](RangeReading& r) { r.max_m = max_m; });
    add("no echo and max_m " + std::to_string(max_m), [&](RangeReading& r) {
      r.max_m = max_m;
      r.range_m = kInfinity;
    });
  }
  for (const double half_beam_rad : {0.0, -1.0, 1.6, 4.0, kNan, kInfinity, kHuge})
    add("half_beam_rad " + std::to_string(half_beam_rad), [&](RangeReading& r) { r.half_beam_rad = half_beam_rad; });
  for (const double min_m : {-1.0, kNan, 9.0, kInfinity})
    add("min_m " + std::to_string(min_m), [&](RangeReading& r) { r.min_m = min_m; });
  for (const Pose2& pose : odd_poses())
    add("a sensor at x_m " + std::to_string(pose.x_m) + ", theta_rad " + std::to_string(pose.theta_rad),
        [&](RangeReading& r) { r.T_robot_sensor = pose; });
  add("sensor -1", [](RangeReading& r) { r.sensor = -1; });
  add("sensor 2147483647", [](RangeReading& r) { r.sensor = std::numeric_limits<int>::max(); });
  return odd;
}

std::vector<Pose2> odd_poses() {
  return {{kNan, 0.0, 0.0},  {0.0, kNan, 0.0},   {0.0, 0.0, kNan},  {kInfinity, 0.0, 0.0}, {0.0, -kInfinity, 0.0},
          {kHuge, 0.0, 0.0}, {0.0, -kHuge, 0.0}, {0.0, 0.0, kHuge}, {1e9, 1e9, 0.0}};
}

}  // namespace cairn::conformance

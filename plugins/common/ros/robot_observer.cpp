#include "plugins/common/ros/robot_observer.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace cairn::ros {
namespace {

// An odometry that is older than the last by more is of a clock that was set. Less than the wheels may turn in silence.
constexpr double kOvertakenWithin_s = 0.25;

double wall_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

RobotObserver::RobotObserver(const RobotTopics& topics, const RobotModel& robot)
    : topics_(topics), ranges_(topics, robot), places_(topics), continuity_(robot), bumped_(topics.bumpers.size(), 0) {}

void RobotObserver::mark(const std::string& topic, const Header& header, double arrived_s) {
  heard_.add(topic, arrived_s, header.frame, header.stamp_s, wall_s());
}

void RobotObserver::take(const RangeTopic& topic, const Range& range, double arrived_s) {
  mark(topic.topic, range.header, arrived_s);
  ranges_.add(topic, range, arrived_s, places_);
}

void RobotObserver::take(const RangeTopic& topic, const Scan& scan, double arrived_s) {
  mark(topic.topic, scan.header, arrived_s);
  ranges_.add(topic, scan, arrived_s, places_);
}

void RobotObserver::take(const RangeTopic& topic, const Header& header, const std::vector<Point>& points_m,
                         double arrived_s) {
  mark(topic.topic, header, arrived_s);
  ranges_.add(topic, header, points_m, arrived_s, places_);
}

void RobotObserver::take_compass(const Header& header, const std::optional<double>& heading_rad, double arrived_s) {
  mark(topics_.compass.topic, header, arrived_s);
  compass_rad_ = heading_rad;
}

void RobotObserver::take_battery(const Header& header, double percentage, double arrived_s) {
  mark(topics_.battery, header, arrived_s);
  battery_ratio_ = battery_ratio(percentage);
}

void RobotObserver::take_bumper(std::size_t number, bool is_touched, double arrived_s) {
  heard_.add(topics_.bumpers[number], arrived_s);
  bumped_[number] = is_touched ? 1 : 0;
}

void RobotObserver::take_emergency(bool is_on, double arrived_s) {
  heard_.add(topics_.emergency, arrived_s);
  is_emergency_ = is_on;
}

bool RobotObserver::is_overtaken(double stamp_s) const {
  return last_stamp_s_ && stamp_s < *last_stamp_s_ && *last_stamp_s_ - stamp_s <= kOvertakenWithin_s;
}

// Each reading as seen from where the robot is now.
std::optional<Observation> RobotObserver::take(const Odometry& odometry, double arrived_s) {
  mark(topics_.odometry, odometry.header, arrived_s);
  places_.found_base(odometry.child_frame);
  const std::optional<Pose2> pose = pose_of(odometry.position_m, odometry.orientation);
  const double stamp = stamp_s(topics_, odometry.header, arrived_s);
  if (!pose || is_overtaken(stamp)) return std::nullopt;
  last_stamp_s_ = stamp;
  Observation observation;
  observation.stamp_s = stamp;
  observation.T_odom_robot = *pose;
  observation.compass_rad = std::exchange(compass_rad_, std::nullopt);
  observation.battery_ratio = battery_ratio_;
  observation.bumped = std::ranges::find(bumped_, 1) != bumped_.end();
  if (is_emergency_) observation.stopped_by = "the emergency topic " + topics_.emergency;
  base_ahead_s_ = odometry.header.stamp_s - arrived_s;
  poses_.add(observation.stamp_s, *pose);
  observation.ranges = ranges_.seen_from(observation.stamp_s, *pose, poses_);
  return continuity_.continued(std::move(observation), arrived_s);
}

}  // namespace cairn::ros

#include "plugins/ros2_robot/ros_link.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>

#include "framework/live/steady_time.hpp"
#include "maps/base/spelling.hpp"

namespace cairn::ros2_robot {
namespace {

constexpr double kFindWithin_s = 2.0;
constexpr std::chrono::milliseconds kLookEvery(5);
constexpr std::chrono::milliseconds kReceiveWithin(20);
constexpr double kLookWhoListensEvery_s = 0.5;
constexpr double kMaxReadingAge_s = 1.0;
constexpr double kMaxReadingAhead_s = 0.3;  // of the odometry; it waits for the next
constexpr double kTwoPublishersWithin_s = 1.0;
constexpr std::size_t kMaxHeard = 20000;
constexpr std::size_t kMaxListed = 8;

double wall_clock_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

const dds_topic_descriptor_t& type_of(RangeKind kind) {
  switch (kind) {
    case RangeKind::range:
      return sensor_msgs_msg_dds__Range__desc;
    case RangeKind::laser:
      return sensor_msgs_msg_dds__LaserScan__desc;
    case RangeKind::point_cloud:
      return sensor_msgs_msg_dds__PointCloud__desc;
    case RangeKind::point_cloud2:
      break;
  }
  return sensor_msgs_msg_dds__PointCloud2__desc;
}

void check_topic(const char* key, const std::string& topic, bool may_be_empty) {
  if (topic.empty() && may_be_empty) return;
  if (!topic.starts_with('/') || topic.ends_with('/'))
    throw std::invalid_argument(
        fmt::format("ros2_robot: `{}` is \"{}\"; a topic is given by its full name, as /scan", key, topic));
}

}  // namespace

RosLink::RosLink(const Config& config, const RobotModel& robot)
    : config_(config), robot_(robot), places_(config), continuity_(robot_) {
  check_topic("odometry", config.odometry, false);
  check_topic("command.topic", config.command.topic, false);
  check_topic("compass.topic", config.compass.topic, true);
  check_topic("battery", config.battery, true);
  check_topic("emergency", config.emergency, true);
  check_topic("static_frames", config.static_frames, true);
  for (const std::string& bumper : config.bumpers) check_topic("bumpers", bumper, false);
  if (config.mounting == Mounting::frames && config.static_frames.empty())
    throw std::invalid_argument("ros2_robot: `mounting: frames` needs `static_frames`, which is empty");
  if (config.ranges.empty()) throw std::invalid_argument("ros2_robot: `ranges` names no topic: what does it see by?");
  for (const RangeTopic& range : config_.ranges) {
    check_topic("ranges.topic", range.topic, false);
    const bool is_laser = range.kind == RangeKind::laser;
    const std::size_t known = is_laser ? robot.lasers.size() : robot.sonars.size();
    const std::size_t wanted = static_cast<std::size_t>(range.first) + std::max<std::size_t>(1, range.frames.size());
    if (wanted > known)
      throw std::invalid_argument(fmt::format("ros2_robot: {} is of {} {}, and the robot's file has {}", range.topic,
                                              is_laser ? "laser" : "sonar", wanted - 1, known));
  }
}

std::string RosLink::name() const {
  return fmt::format("the robot in ROS domain {}", config_.domain);
}

bool RosLink::connect(const Budget& budget, std::string& why) {
  if (!participant_) make_endpoints();
  const double until_s = live::now_s() + kFindWithin_s;
  do {
    choose_command_type();
    dds_subscription_matched_status_t matched{};
    (void)dds_get_subscription_matched_status(odometry_.get(), &matched);
    if (matched.current_count > 0) {
      continuity_.interrupt();
      return true;
    }
    std::this_thread::sleep_for(kLookEvery);
  } while (live::now_s() < until_s && !budget.exhausted());
  why = nobody_there();
  return false;
}

// Nothing is deleted: who was there may come back, and discovery takes seconds.
void RosLink::disconnect() {
  heard_.clear();
}

void RosLink::make_endpoints() {
  participant_.emplace(
      NetworkChoice{config_.domain, config_.network == Network::localhost, config_.interface, config_.peers});
  odometry_ = participant_->reader(config_.odometry, nav_msgs_msg_dds__Odometry__desc);
  for (const RangeTopic& range : config_.ranges)
    ranges_.push_back({&range, participant_->reader(range.topic, type_of(range.kind))});
  const CompassTopic& compass = config_.compass;
  if (!compass.topic.empty())
    compass_ = participant_->reader(compass.topic, compass.kind == CompassKind::imu
                                                       ? sensor_msgs_msg_dds__Imu__desc
                                                       : sensor_msgs_msg_dds__MagneticField__desc);
  if (!config_.static_frames.empty())
    static_frames_ = participant_->latched_reader(config_.static_frames, tf2_msgs_msg_dds__TFMessage__desc);
  for (const std::string& bumper : config_.bumpers)
    bumpers_.push_back(participant_->reader(bumper, std_msgs_msg_dds__Bool__desc));
  bumped_.assign(bumpers_.size(), 0);
  if (!config_.battery.empty())
    battery_ = participant_->reader(config_.battery, sensor_msgs_msg_dds__BatteryState__desc);
  if (!config_.emergency.empty()) emergency_ = participant_->reader(config_.emergency, std_msgs_msg_dds__Bool__desc);
  const CommandTopic& command = config_.command;
  if (command.kind != CommandKind::twist_stamped)
    twist_ = participant_->writer(command.topic, geometry_msgs_msg_dds__Twist__desc);
  if (command.kind != CommandKind::twist)
    twist_stamped_ = participant_->writer(command.topic, geometry_msgs_msg_dds__TwistStamped__desc);
}

// By who listens: both where both do.
void RosLink::choose_command_type() {
  const double now_s = live::now_s();
  if (now_s - looked_s_ < kLookWhoListensEvery_s) return;
  looked_s_ = now_s;
  const auto listens = [](const Entity& writer) {
    dds_publication_matched_status_t matched{};
    return writer && dds_get_publication_matched_status(writer.get(), &matched) == 0 && matched.current_count > 0;
  };
  sends_twist_ = listens(twist_);
  sends_stamped_ = listens(twist_stamped_);
}

std::string RosLink::nobody_there() const {
  std::set<std::string> offered;
  bool has_topic = false;
  for (const Endpoint& endpoint : participant_->publishers()) {
    if (endpoint.topic == config_.odometry) {
      has_topic = true;
      offered.insert(endpoint.topic + " as " + endpoint.type);
    } else if (endpoint.topic.starts_with('/')) {
      offered.insert(endpoint.topic);
    }
  }
  if (has_topic) return fmt::format("{} is there, but does not fit: {}", config_.odometry, fmt::join(offered, ", "));
  if (offered.empty())
    return fmt::format("nobody publishes anything in domain {}: is ROS_DOMAIN_ID the same, and the network?",
                       config_.domain);
  const std::vector<std::string> all(offered.begin(), offered.end());
  const std::vector<std::string> some(all.begin(), all.begin() + std::min<std::ptrdiff_t>(std::ssize(all), kMaxListed));
  return fmt::format("nobody publishes {}{}; there are {}{}", config_.odometry, did_you_mean(config_.odometry, all),
                     fmt::join(some, ", "), all.size() > some.size() ? ", ..." : "");
}

bool RosLink::receive(std::vector<Observation>& seen) {
  choose_command_type();
  const auto until = std::chrono::steady_clock::now() + kReceiveWithin;
  do {
    if (static_frames_)
      take_all<TFMessage>(static_frames_.get(), [this](const TFMessage& frames) { places_.add(frames); });
    for (const RangeReader& from : ranges_) take_ranges(from);
    take_others();
    take_odometry(seen);
    if (!seen.empty()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  } while (std::chrono::steady_clock::now() < until);
  return true;
}

double RosLink::stamp_s(const Header& header, double arrived_s) const {
  return config_.stamp == Stamp::header ? seconds_of(header.stamp) : arrived_s;
}

int RosLink::sonar_of(const RangeTopic& topic, const std::string& frame) const {
  if (topic.frames.empty()) return topic.first;
  const auto found = std::ranges::find(topic.frames, frame);
  if (found == topic.frames.end())
    throw std::runtime_error(fmt::format("{} has the frame \"{}\", and `frames` does not{}", topic.topic, frame,
                                         did_you_mean(frame, topic.frames)));
  return topic.first + static_cast<int>(found - topic.frames.begin());
}

void RosLink::take_ranges(const RangeReader& from) {
  const double arrived_s = live::now_s();
  const RangeTopic& topic = *from.topic;
  const dds_entity_t reader = from.reader.get();
  const auto take_cloud = [&](const auto& cloud) {
    try {
      take_points(topic, cloud.header, points_of(cloud), arrived_s);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(topic.topic + ": " + error.what());
    }
  };
  if (topic.kind == RangeKind::range)
    take_all<Range>(reader, [&](const Range& range) { take_range(topic, range, arrived_s); });
  else if (topic.kind == RangeKind::laser)
    take_all<LaserScan>(reader, [&](const LaserScan& scan) { take_scan(topic, scan, arrived_s); });
  else if (topic.kind == RangeKind::point_cloud)
    take_all<PointCloud>(reader, take_cloud);
  else
    take_all<PointCloud2>(reader, take_cloud);
  if (heard_.size() > kMaxHeard) heard_.erase(heard_.begin(), heard_.end() - kMaxHeard);
}

void RosLink::take_range(const RangeTopic& topic, const Range& range, double arrived_s) {
  const int number = sonar_of(topic, range.header.frame_id);
  SonarModel sonar = robot_.sonars[static_cast<std::size_t>(number)];
  const auto place = places_.of_sensor(range.header.frame_id, sonar.T_robot_sonar, arrived_s);
  if (!place) return;
  sonar.T_robot_sonar = place->T_base_sensor;
  heard_.push_back({stamp_s(range.header, arrived_s), reading_of(range, sonar, number, config_.no_echo_from_m)});
}

void RosLink::take_scan(const RangeTopic& topic, const LaserScan& scan, double arrived_s) {
  const auto number = static_cast<std::size_t>(topic.first);
  LaserModel laser = robot_.lasers[number];
  const auto place = places_.of_sensor(scan.header.frame_id, laser.T_robot_laser, arrived_s);
  if (!place) return;
  laser.T_robot_laser = place->T_base_sensor;
  for (const RangeReading& reading :
       readings_of(scan, laser, first_beam_of(robot_, number), config_.no_echo_from_m, place->is_upside_down))
    heard_.push_back({stamp_s(scan.header, arrived_s), reading});
}

void RosLink::take_points(const RangeTopic& topic, const Header& header, const std::vector<Point>& points_m,
                          double arrived_s) {
  const std::size_t known = robot_.sonars.size() - static_cast<std::size_t>(topic.first);
  if (points_m.size() > known)
    throw std::runtime_error(fmt::format("has {} points, and the robot's file {} sonars from number {} on",
                                         points_m.size(), known, topic.first));
  const auto place = places_.of_frame(header.frame_id, arrived_s);
  if (!place) return;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const int number = topic.first + static_cast<int>(i);
    const Point seen_m(points_m[i].x(), place->is_upside_down ? -points_m[i].y() : points_m[i].y());
    heard_.push_back({stamp_s(header, arrived_s),
                      reading_of(place->T_base_sensor * seen_m, robot_.sonars[static_cast<std::size_t>(number)], number,
                                 config_.no_echo_from_m)});
  }
}

void RosLink::take_others() {
  const auto take_compass = [&](const auto& message) {
    compass_rad_ = compass_rad(message, config_.compass.offset_rad);
  };
  if (compass_ && config_.compass.kind == CompassKind::imu) take_all<Imu>(compass_.get(), take_compass);
  if (compass_ && config_.compass.kind == CompassKind::magnetic_field)
    take_all<MagneticField>(compass_.get(), take_compass);
  for (std::size_t i = 0; i < bumpers_.size(); ++i)
    take_all<Bool>(bumpers_[i].get(), [&](const Bool& bumper) { bumped_[i] = bumper.data ? 1 : 0; });
  if (battery_)
    take_all<BatteryState>(battery_.get(),
                           [&](const BatteryState& battery) { battery_ratio_ = battery_ratio(battery); });
  if (emergency_) take_all<Bool>(emergency_.get(), [&](const Bool& stop) { is_emergency_ = stop.data; });
}

void RosLink::take_odometry(std::vector<Observation>& seen) {
  const double arrived_s = live::now_s();
  take_all_from<Odometry>(odometry_.get(), [&](const Odometry& odometry, dds_instance_handle_t publisher) {
    check_publisher(publisher, arrived_s);
    places_.found_base(odometry.child_frame_id);
    observe(odometry, arrived_s, seen);
  });
}

// One that takes over from another, which was killed, is no fault; two that take turns are.
void RosLink::check_publisher(dds_instance_handle_t publisher, double now_s) {
  if (publisher == publisher_) return;
  if (publisher == publisher_before_ && now_s - publisher_changed_s_ < kTwoPublishersWithin_s)
    throw std::runtime_error(fmt::format("two publish {}: end one of them", config_.odometry));
  publisher_before_ = std::exchange(publisher_, publisher);
  publisher_changed_s_ = now_s;
}

double RosLink::base_time_s() const {
  const double ahead_s = base_ahead_s_;
  return ahead_s == 0.0 ? wall_clock_s() : live::now_s() + ahead_s;
}

// Each reading as seen from where the robot is now.
void RosLink::observe(const Odometry& odometry, double arrived_s, std::vector<Observation>& seen) {
  const std::optional<Pose2> pose = pose_of(odometry);
  if (!pose) return;
  Observation observation;
  observation.stamp_s = stamp_s(odometry.header, arrived_s);
  observation.T_odom_robot = *pose;
  observation.compass_rad = std::exchange(compass_rad_, std::nullopt);
  observation.battery_ratio = battery_ratio_;
  observation.bumped = std::ranges::find(bumped_, 1) != bumped_.end();
  base_ahead_s_ = seconds_of(odometry.header.stamp) - arrived_s;
  poses_.add(observation.stamp_s, *pose);
  std::vector<HeardRange> ahead;
  for (HeardRange& heard : heard_) {
    const double age_s = observation.stamp_s - heard.stamp_s;
    if (age_s < 0.0 && age_s >= -kMaxReadingAhead_s) ahead.push_back(heard);
    if (age_s < 0.0 || age_s > kMaxReadingAge_s) continue;
    const Pose2 T_now_then = inverse(*pose) * poses_.at(heard.stamp_s).value_or(*pose);
    heard.reading.T_robot_sensor = T_now_then * heard.reading.T_robot_sensor;
    observation.ranges.push_back(heard.reading);
  }
  heard_ = std::move(ahead);
  seen.push_back(continuity_.continued(std::move(observation), arrived_s));
}

void RosLink::send(const Twist& wanted) noexcept {
  const Twist twist = is_emergency_ ? Twist{} : wanted;
  TwistMessage message{{twist.v_mps, 0.0, 0.0}, {0.0, 0.0, twist.w_radps}};
  if (sends_twist_) (void)dds_write(twist_.get(), &message);
  if (!sends_stamped_) return;
  std::array<char, 256> frame{};
  config_.command.frame.copy(frame.data(), frame.size() - 1);
  const TwistStamped stamped{{time_of(base_time_s()), frame.data()}, message};
  (void)dds_write(twist_stamped_.get(), &stamped);
}

}  // namespace cairn::ros2_robot

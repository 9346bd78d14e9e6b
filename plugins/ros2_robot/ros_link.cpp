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
#include "plugins/ros2_robot/settings_check.hpp"

namespace cairn::ros2_robot {
namespace {

constexpr double kFindWithin_s = 2.0;
constexpr std::chrono::milliseconds kLookEvery(5);
constexpr std::chrono::milliseconds kReceiveWithin(20);
constexpr double kLookWhoListensEvery_s = 0.5;
constexpr double kTwoPublishersWithin_s = 1.0;
constexpr std::size_t kMaxListed = 8;

double wall_clock_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

RosLink::RosLink(const Config& config, const RobotModel& robot, const Budget& budget)
    : config_(config),
      robot_(robot),
      budget_(budget),
      ranges_(config_, robot_),
      places_(config),
      continuity_(robot_),
      display_(config_.show, config_.goal) {
  check_settings(config, robot);
}

std::string RosLink::name() const {
  return fmt::format("the robot in ROS domain {}", config_.domain);
}

// Whoever gives the pose has found this participant by then, or gives it again.
std::optional<Pose2> RosLink::start() {
  const InitialPoseTopic& initial = config_.initial_pose;
  if (initial.topic.empty()) return std::nullopt;
  if (!participant_) make_endpoints();
  const Entity reader =
      participant_->reader(initial.topic, geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc, Reading::reliable);
  std::optional<Pose2> given;
  for (const double until_s = live::now_s() + initial.wait_s; !given && live::now_s() < until_s && !budget_.cancelled();
       std::this_thread::sleep_for(kLookEvery))
    take_all<PoseWithCovarianceStamped>(reader.get(), [&](const PoseWithCovarianceStamped& pose) {
      if (is_in_frame(pose.header, config_.show.map_frame)) given = pose_of(pose.pose.pose);
    });
  if (!given)
    throw std::runtime_error(fmt::format("nobody has given a pose on {} in the frame {} for {:g} s", initial.topic,
                                         config_.show.map_frame, initial.wait_s));
  return given;
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
  ranges_.clear();
}

void RosLink::make_endpoints() {
  participant_.emplace(
      NetworkChoice{config_.domain, config_.network == Network::localhost, config_.interface, config_.peers});
  odometry_ = participant_->reader(config_.odometry, nav_msgs_msg_dds__Odometry__desc);
  ranges_.open(*participant_);
  const CompassTopic& compass = config_.compass;
  if (!compass.topic.empty())
    compass_ = participant_->reader(compass.topic, compass.kind == CompassKind::imu
                                                       ? sensor_msgs_msg_dds__Imu__desc
                                                       : sensor_msgs_msg_dds__MagneticField__desc);
  if (!config_.static_frames.empty())
    static_frames_ = participant_->reader(config_.static_frames, tf2_msgs_msg_dds__TFMessage__desc, Reading::latched);
  for (const std::string& bumper : config_.bumpers)
    bumpers_.push_back(participant_->reader(bumper, std_msgs_msg_dds__Bool__desc));
  bumped_.assign(bumpers_.size(), 0);
  if (!config_.battery.empty())
    battery_ = participant_->reader(config_.battery, sensor_msgs_msg_dds__BatteryState__desc);
  if (!config_.emergency.empty()) emergency_ = participant_->reader(config_.emergency, std_msgs_msg_dds__Bool__desc);
  display_.open(*participant_);
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
  sends_twist_ = is_read(twist_);
  sends_stamped_ = is_read(twist_stamped_);
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
    ranges_.take(places_);
    take_others();
    take_odometry(seen);
    if (!seen.empty()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  } while (std::chrono::steady_clock::now() < until);
  return true;
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
  observation.stamp_s = stamp_s(config_, odometry.header, arrived_s);
  observation.T_odom_robot = *pose;
  observation.compass_rad = std::exchange(compass_rad_, std::nullopt);
  observation.battery_ratio = battery_ratio_;
  observation.bumped = std::ranges::find(bumped_, 1) != bumped_.end();
  base_ahead_s_ = seconds_of(odometry.header.stamp) - arrived_s;
  poses_.add(observation.stamp_s, *pose);
  display_.observed(odometry.header, *pose);
  observation.ranges = ranges_.seen_from(observation.stamp_s, *pose, poses_);
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

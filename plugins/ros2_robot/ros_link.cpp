#include "plugins/ros2_robot/ros_link.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <stdexcept>
#include <thread>

#include "framework/live/steady_time.hpp"
#include "maps/base/spelling.hpp"
#include "plugins/ros2_robot/dds/topic_report.hpp"
#include "plugins/ros2_robot/guard.hpp"
#include "plugins/ros2_robot/settings_check.hpp"

namespace cairn::ros2_robot {
namespace {

constexpr double kFindWithin_s = 2.0;
constexpr std::chrono::milliseconds kLookEvery(5);
constexpr std::chrono::milliseconds kReceiveWithin(20);
constexpr double kTwoPublishersWithin_s = 1.0;
constexpr std::size_t kMaxListed = 8;

}  // namespace

RosLink::RosLink(const Config& config, const RobotModel& robot, const Budget& budget, std::filesystem::path guard,
                 bool wants_images)
    : config_(config),
      chosen_(choose_network(config)),
      robot_(robot),
      budget_(budget),
      guard_program_(std::move(guard)),
      ranges_(config_),
      images_(config_, robot_, wants_images),
      observer_(config_, robot_),
      display_(config_.show, config_.goal) {
  check_settings(config, robot);
}

std::string RosLink::name() const {
  return fmt::format("the robot in ROS domain {}", chosen_.network.domain);
}

std::string RosLink::awaited() const {
  return fmt::format("{} in ROS domain {}", config_.odometry, chosen_.network.domain);
}

std::string RosLink::awaited_start() const {
  const InitialPoseTopic& initial = config_.initial_pose;
  if (initial.topic.empty()) return {};
  return fmt::format(
      "a pose on {} in the frame {} of ROS domain {}, {:g} s at most: RViz gives one by `2D Pose Estimate`",
      initial.topic, config_.show.map_frame, chosen_.network.domain, initial.wait_s);
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
  if (!given && !budget_.cancelled())
    throw std::runtime_error(fmt::format("nobody has given a pose on {} in the frame {} for {:g} s", initial.topic,
                                         config_.show.map_frame, initial.wait_s));
  return given;
}

bool RosLink::connect(const Budget& budget, std::string& why) {
  if (!participant_) make_endpoints();
  make_guard();
  const double until_s = live::now_s() + kFindWithin_s;
  do {
    velocity_->look_who_listens(live::now_s());
    dds_subscription_matched_status_t matched{};
    (void)dds_get_subscription_matched_status(odometry_.get(), &matched);
    if (matched.current_count > 0) {
      is_reading_ = true;
      velocity_->meet(live::now_s());
      observer_.interrupt();
      ranges_until_s_ = live::now_s() + config_.stop_when.reconnect_s;
      return true;
    }
    std::this_thread::sleep_for(kLookEvery);
  } while (live::now_s() < until_s && !budget.exhausted());
  why = nobody_there(config_.odometry);
  return false;
}

// Nothing is deleted: who was there may come back, and discovery takes seconds.
void RosLink::disconnect() {
  is_reading_ = false;
  observer_.forget_readings();
}

void RosLink::make_endpoints() {
  participant_.emplace(chosen_.network);
  odometry_ = participant_->reader(config_.odometry, nav_msgs_msg_dds__Odometry__desc);
  ranges_.open(*participant_);
  images_.open(*participant_);
  const CompassTopic& compass = config_.compass;
  if (!compass.topic.empty())
    compass_ = participant_->reader(compass.topic, compass.kind == CompassKind::imu
                                                       ? sensor_msgs_msg_dds__Imu__desc
                                                       : sensor_msgs_msg_dds__MagneticField__desc);
  if (!config_.static_frames.empty())
    static_frames_ = participant_->reader(config_.static_frames, tf2_msgs_msg_dds__TFMessage__desc, Reading::latched);
  for (const std::string& bumper : config_.bumpers)
    bumpers_.push_back(participant_->reader(bumper, std_msgs_msg_dds__Bool__desc));
  if (!config_.battery.empty())
    battery_ = participant_->reader(config_.battery, sensor_msgs_msg_dds__BatteryState__desc);
  if (!config_.emergency.empty()) emergency_ = participant_->reader(config_.emergency, std_msgs_msg_dds__Bool__desc);
  display_.open(*participant_);
  velocity_.emplace(*participant_, config_.command);
}

void RosLink::make_guard() {
  if (guard_program_.empty() || (guard_ && guard_->is_there())) return;
  const std::scoped_lock lock(guarding_);
  const std::chrono::milliseconds silence(std::lround(1e3 * config_.guard_s));
  guard_ = guard_of({chosen_.network, config_.command, silence}, guard_program_);
}

const std::string& RosLink::about_peers() {
  if (!about_peers_) {
    const std::vector<std::string> unknown = unknown_peers(chosen_.network);
    about_peers_ =
        unknown.empty() ? "" : fmt::format("no name service knows the peer {}", fmt::join(unknown, ", nor "));
  }
  return *about_peers_;
}

std::string RosLink::nobody_there(const std::string& topic) {
  std::set<std::string> offered;
  bool has_topic = false;
  for (const Endpoint& endpoint : participant_->publishers()) {
    if (endpoint.topic == topic) {
      has_topic = true;
      offered.insert(endpoint.topic + " as " + endpoint.type);
    } else if (endpoint.topic.starts_with('/') && endpoint.topic != config_.command.topic) {  // that is the guard's
      offered.insert(endpoint.topic);
    }
  }
  if (has_topic) return fmt::format("{} is there, but does not fit: {}", topic, fmt::join(offered, ", "));
  if (offered.empty())
    return fmt::format("nobody publishes anything in domain {}: {}", chosen_.network.domain,
                       about_peers().empty() ? "is ROS_DOMAIN_ID the same, and the network?" : about_peers());
  const std::vector<std::string> all(offered.begin(), offered.end());
  const std::vector<std::string> some(all.begin(), all.begin() + std::min<std::ptrdiff_t>(std::ssize(all), kMaxListed));
  return fmt::format("nobody publishes {}{}; there are {}{}", topic, did_you_mean(topic, all), fmt::join(some, ", "),
                     all.size() > some.size() ? ", ..." : "");
}

void RosLink::check_ranges_are_there(double now_s) {
  if (!ranges_until_s_) return;
  const std::vector<Endpoint> publishers = participant_->publishers();
  const auto missing = std::ranges::find_if(config_.ranges, [&](const ros::RangeTopic& range) {
    return std::ranges::none_of(publishers, [&](const Endpoint& endpoint) { return endpoint.topic == range.topic; });
  });
  if (missing == config_.ranges.end())
    ranges_until_s_.reset();
  else if (now_s >= *ranges_until_s_)
    throw std::runtime_error(nobody_there(missing->topic));
}

bool RosLink::receive(std::vector<Observation>& seen) {
  if (guard_ && !guard_->is_there()) return false;
  velocity_->look_who_listens(live::now_s());
  check_ranges_are_there(live::now_s());
  const auto until = std::chrono::steady_clock::now() + kReceiveWithin;
  do {
    take_frames();
    ranges_.take(observer_);
    images_.take(observer_.heard());
    take_others();
    take_odometry(seen);
    if (!seen.empty()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  } while (std::chrono::steady_clock::now() < until);
  return true;
}

void RosLink::take_frames() {
  if (!static_frames_) return;
  take_all<TFMessage>(static_frames_.get(), [this](const TFMessage& frames) {
    observer_.heard().add(config_.static_frames, live::now_s());
    for (std::uint32_t i = 0; i < frames.transforms._length; ++i) {
      const auto& [header, child, transform] = frames.transforms._buffer[i];
      const auto& [t, r] = transform;
      observer_.take_frame(header.frame_id, child, {t.x, t.y, t.z}, {r.w, r.x, r.y, r.z});
    }
  });
}

void RosLink::take_others() {
  const double arrived_s = live::now_s();
  const auto take_compass = [&](const auto& message) {
    observer_.take_compass(header_of(message.header), ros::compass_rad(message_of(message), config_.compass.offset_rad),
                           arrived_s);
  };
  if (compass_ && config_.compass.kind == CompassKind::imu) take_all<Imu>(compass_.get(), take_compass);
  if (compass_ && config_.compass.kind == CompassKind::magnetic_field)
    take_all<MagneticField>(compass_.get(), take_compass);
  for (std::size_t i = 0; i < bumpers_.size(); ++i)
    take_all<Bool>(bumpers_[i].get(), [&](const Bool& bumper) { observer_.take_bumper(i, bumper.data, arrived_s); });
  if (battery_)
    take_all<BatteryState>(battery_.get(), [&](const BatteryState& battery) {
      observer_.take_battery(header_of(battery.header), battery.percentage, arrived_s);
    });
  if (emergency_)
    take_all<Bool>(emergency_.get(), [&](const Bool& stop) { observer_.take_emergency(stop.data, arrived_s); });
}

void RosLink::take_odometry(std::vector<Observation>& seen) {
  const double arrived_s = live::now_s();
  take_all_from<Odometry>(odometry_.get(), [&](const Odometry& odometry, dds_instance_handle_t publisher) {
    check_publisher(publisher, arrived_s);
    const auto pose = pose_of(odometry.pose.pose);
    if (pose) display_.observed(odometry.header, *pose);
    const ros::Odometry said = message_of(odometry);
    auto observation = observer_.take(said, arrived_s);
    if (!observation) return;
    images_.move_into(*observation, config_.stamp == Stamp::header ? said.header.stamp_s : arrived_s);
    if (observation->stopped_by.empty() && !velocity_->is_heard(arrived_s))
      observation->stopped_by = "a base that nobody has met: no one listens to " + config_.command.topic;
    seen.push_back(std::move(*observation));
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

std::vector<ConnectionPart> RosLink::parts() {
  if (!participant_) make_endpoints();
  const TopicReport report(*participant_, is_reading_ ? &observer_.heard() : nullptr, live::now_s());
  std::vector<ConnectionPart> parts{
      report.of_network(fmt::format("ROS domain {}", chosen_.network.domain), config_.command.topic)};
  if (!chosen_.variables.empty())
    parts.back().values.push_back({"environment", fmt::format("{}", fmt::join(chosen_.variables, ", "))});
  if (!about_peers().empty()) parts.back().problem = about_peers();
  parts.push_back(report.of_reader(odometry_, Importance::steady));
  for (std::size_t i = 0; i < config_.ranges.size(); ++i) {
    parts.push_back(report.of_reader(ranges_.readers()[i], Importance::steady));
    if (parts.back().problem.empty() && config_.stamp == Stamp::header)
      parts.back().problem = observer_.heard().clocks_apart(config_.ranges[i].topic, config_.odometry);
  }
  for (std::size_t i = 0; i < images_.readers().size(); ++i) {
    parts.push_back(report.of_reader(images_.readers()[i], Importance::steady));
    if (parts.back().problem.empty() && config_.stamp == Stamp::header)
      parts.back().problem = observer_.heard().clocks_apart(config_.images[i].topic, config_.odometry);
  }
  if (compass_) parts.push_back(report.of_reader(compass_, Importance::steady));
  if (battery_) parts.push_back(report.of_reader(battery_, Importance::said_rarely));
  for (const Entity& bumper : bumpers_) parts.push_back(report.of_reader(bumper, Importance::said_rarely));
  if (emergency_) parts.push_back(report.of_reader(emergency_, Importance::said_rarely));
  if (static_frames_)
    parts.push_back(report.of_reader(
        static_frames_, config_.mounting == Mounting::frames ? Importance::said_rarely : Importance::optional));
  parts.push_back(
      report.of_velocities(config_.command.topic, velocity_->twist(), velocity_->twist_stamped(), guard_ != nullptr));
  return parts;
}

void RosLink::send(const Twist& wanted) noexcept {
  velocity_->send(observer_.is_emergency() ? Twist{} : wanted, observer_.base_ahead_s());
}

void RosLink::beat() noexcept {
  const std::unique_lock lock(guarding_, std::try_to_lock);
  if (lock.owns_lock() && guard_) guard_->beat(observer_.base_ahead_s());
}

}  // namespace cairn::ros2_robot

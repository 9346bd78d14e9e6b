#include "plugins/mcap_log/mcap_log.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "maps/base/text.hpp"
#include "plugins/common/frames/static_frames.hpp"
#include "plugins/common/pictures/grey_picture.hpp"
#include "plugins/mcap_log/bag.hpp"
#include "plugins/mcap_log/pose_track.hpp"
#include "plugins/mcap_log/topics.hpp"

namespace cairn::mcap_log {
namespace {

using frames::Mounted;
using log_common::ScanLog;
using pictures::RecordedPicture;

constexpr double kFarthest_m = 1e5;
constexpr std::size_t kMaxBeams = 100'000;
constexpr std::string_view kStaticTopic = "tf_static";

// One message with ranges.
struct Item {
  const std::string* topic = nullptr;
  const Timed<ros2::RangeMessage>* range = nullptr;
  const Timed<ros2::LaserScanMessage>* scan = nullptr;

  [[nodiscard]] const Moment& at() const { return range != nullptr ? range->at : scan->at; }
};

log_common::LogRules rules_of(const Config& config) {
  log_common::LogRules rules = config;
  for (double& value : rules.no_echo) value = static_cast<float>(value);  // as messages have it
  return rules;
}

std::optional<Pose2> pose_of(const ros2::ReadPose& pose) {
  const auto heading = ros2::heading_rad(pose);
  if (!heading || !(std::abs(pose.x_m) <= kFarthest_m && std::abs(pose.y_m) <= kFarthest_m)) return std::nullopt;
  return Pose2{pose.x_m, pose.y_m, *heading};
}

class LogReader {
 public:
  // cameras: whose pictures are wanted; null: none are.
  LogReader(const Config& config, const Budget& budget, const std::vector<CameraModel>* cameras = nullptr)
      : config_(config),
        scans_(config.file.string(), rules_of(config), budget),
        cameras_(cameras),
        store_(cameras == nullptr ? nullptr : std::make_shared<PictureStore>()) {
    scans_.count_in("record");
    bag_ = read_bag(config, scans_, budget, store_.get());
  }
  LogWithPictures read();

 private:
  void number_all_parts();
  void learn_frames();
  void learn_poses();
  void add_transform(const Timed<ros2::TransformMessage>& transform);
  void learn_compass();
  void add_pose(const Moment& at, std::uint64_t offset, const ros2::ReadPose& pose, const std::string& child);
  [[nodiscard]] std::vector<Item> items() const;
  [[nodiscard]] const CameraModel& camera_of(const ImageTopic& images) const;
  void collect_pictures();
  void add_pictures_until(const Moment& at);
  void add_ranges(std::span<const Item> items);
  void add_scan(const Item& item);
  [[nodiscard]] RangeReading reading_of(const Item& item);
  [[nodiscard]] Mounted place_of(const std::string& frame) const;
  [[nodiscard]] log_common::Scan scan_at(const Moment& at);
  template <class Read>
  void guarded(std::uint64_t offset, Read read) {
    try {
      read();
    } catch (const ros2::MessageError& error) {
      scans_.bad_line(
          ConfigError({config_.file.string(), 0, 0}, "byte " + std::to_string(offset) + ": " + error.what()));
    }
  }

  const Config& config_;
  ScanLog scans_;
  Bag bag_;
  ChosenTopics chosen_;
  frames::StaticFrames frames_;
  std::string base_;
  PoseTrack poses_;
  PoseTrack headings_;
  std::map<std::string, int> sensors_;  // numbers of transducers, by topic and frame
  int next_sensor_ = 0;
  const std::vector<CameraModel>* cameras_;
  std::shared_ptr<PictureStore> store_;
  std::vector<std::pair<Moment, RecordedPicture>> waiting_;  // the next one last
  std::vector<RecordedPicture> pictures_;
};

LogWithPictures LogReader::read() {
  chosen_ = chosen_topics(config_, bag_, cameras_ != nullptr);
  number_all_parts();
  learn_frames();
  learn_poses();
  learn_compass();
  collect_pictures();
  const std::vector<Item> all = items();
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i + 1;
    add_pictures_until(all[i].at());
    if (all[i].scan != nullptr) {
      guarded(all[i].scan->offset, [&] { add_scan(all[i]); });
    } else {
      while (end < all.size() && all[end].range != nullptr && all[end].at() == all[i].at()) ++end;
      add_ranges(std::span(all).subspan(i, end - i));
    }
    i = end;
  }
  if (!config_.compass_from_pose) scans_.forget_start();
  scans_.finish();
  return {std::move(scans_), std::move(pictures_)};
}

// Throws ConfigError.
const CameraModel& LogReader::camera_of(const ImageTopic& images) const {
  try {
    return pictures::camera_of(images.camera, *cameras_);
  } catch (const std::runtime_error& error) {
    throw ConfigError({config_.file.string(), 0, 0}, "images: " + in_quotes(images.topic) + ": " + error.what());
  }
}

void LogReader::collect_pictures() {
  for (const ImageTopic& images : chosen_.images) {
    const CameraModel& camera = camera_of(images);
    for (const Timed<StoredPicture>& image : bag_.images[images.topic])
      guarded(image.offset, [&] {
        check_size(image.message, camera);
        waiting_.emplace_back(image.at,
                              RecordedPicture{image.at.stamp_s, 0, reader_of(store_, image.message, images.camera)});
      });
  }
  std::ranges::stable_sort(waiting_, [](const auto& a, const auto& b) { return b.first < a.first; });
}

// They go with the next observation.
void LogReader::add_pictures_until(const Moment& at) {
  for (; !waiting_.empty() && waiting_.back().first <= at; waiting_.pop_back()) {
    pictures_.push_back(std::move(waiting_.back().second));
    pictures_.back().observation = scans_.size();
  }
}

void LogReader::number_all_parts() {
  std::vector<Moment*> moments;
  const auto add = [&](auto& topics, const std::string& topic) {
    const auto found = topics.find(topic);
    if (found == topics.end()) return;
    for (auto& timed : found->second) moments.push_back(&timed.at);
  };
  for (const std::string& topic : chosen_.ranges) {
    add(bag_.ranges, topic);
    add(bag_.scans, topic);
  }
  add(bag_.odometry, chosen_.odometry);
  add(bag_.transforms, chosen_.transforms);
  add(bag_.compasses, config_.compass);
  for (const ImageTopic& images : chosen_.images) add(bag_.images, images.topic);
  number_parts(std::move(moments));
}

// Static ones first; of what moves, the first place that is said, for robots that publish their sensors' frames so.
void LogReader::learn_frames() {
  std::map<std::string, bool> is_known;  // by child
  for (const bool is_static : {true, false})
    for (const auto& [topic, transforms] : bag_.transforms) {
      if (topic.ends_with(kStaticTopic) != is_static) continue;
      for (const auto& transform : transforms) {
        const ros2::TransformMessage& message = transform.message;
        const ros2::ReadPose& pose = message.pose;
        if (!is_static && (is_known[message.child_frame] || message.header.frame == config_.odometry_frame)) continue;
        is_known[message.child_frame] =
            frames_.add(message.header.frame, message.child_frame, {pose.x_m, pose.y_m, pose.z_m},
                        {pose.qw, pose.qx, pose.qy, pose.qz});
      }
    }
}

void LogReader::add_pose(const Moment& at, std::uint64_t offset, const ros2::ReadPose& said, const std::string& child) {
  guarded(offset, [&] {
    const auto pose = pose_of(said);
    if (!pose) throw ros2::MessageError("the odometry says no pose");
    if (base_.empty()) base_ = child;
    if (child == base_ || child.empty()) return poses_.add(at, *pose);
    const auto T_child_base = frames_.find(child, base_);
    if (!T_child_base)
      throw ros2::MessageError("no transform leads from " + in_quotes(child) + ", which the odometry is of, to " +
                               in_quotes(base_));
    poses_.add(at, *pose * T_child_base->T_base_sensor);
  });
}

void LogReader::learn_poses() {
  base_ = config_.base_frame;
  if (const auto found = bag_.odometry.find(chosen_.odometry); found != bag_.odometry.end())
    for (const auto& [at, offset, message] : found->second) add_pose(at, offset, message.pose, message.child_frame);
  if (const auto found = bag_.transforms.find(chosen_.transforms); found != bag_.transforms.end())
    for (const auto& [at, offset, message] : found->second)
      if (message.header.frame == config_.odometry_frame) add_pose(at, offset, message.pose, message.child_frame);
  poses_.sort();
}

void LogReader::learn_compass() {
  if (const auto found = bag_.compasses.find(config_.compass); found != bag_.compasses.end())
    for (const auto& [at, offset, message] : found->second)
      if (message.heading_rad)
        headings_.add(at, {0.0, 0.0, wrap_angle(*message.heading_rad + config_.compass_offset_rad)});
  headings_.sort();
}

std::vector<Item> LogReader::items() const {
  std::vector<Item> all;
  for (const std::string& topic : chosen_.ranges) {
    if (const auto found = bag_.ranges.find(topic); found != bag_.ranges.end())
      for (const auto& range : found->second) all.push_back({&topic, &range, nullptr});
    if (const auto found = bag_.scans.find(topic); found != bag_.scans.end())
      for (const auto& scan : found->second) all.push_back({&topic, nullptr, &scan});
  }
  const auto is_before = [](const Item& a, const Item& b) {
    return a.at() == b.at() ? a.at().order < b.at().order : a.at() < b.at();
  };
  std::ranges::stable_sort(all, is_before);
  return all;
}

Mounted LogReader::place_of(const std::string& frame) const {
  for (const FramePlace& place : config_.frames)
    if (place.frame == frame) return {{place.x_m, place.y_m, place.angle_rad}, false};
  if (frame == base_ || frame.empty()) return {};
  if (const auto found = frames_.find(base_, frame)) return *found;
  std::string known;
  for (const std::string& name : frames_.names()) known += (known.empty() ? "" : ", ") + name;
  throw ros2::MessageError("no transform leads from the robot's frame " + in_quotes(base_) + " to " + in_quotes(frame) +
                           " (or it looks up or down); say by `frames` where that sensor is, or by `base_frame` which "
                           "frame is the robot's. Frames of the log: " +
                           (known.empty() ? "none" : known));
}

log_common::Scan LogReader::scan_at(const Moment& at) {
  log_common::Scan scan;
  scan.stamp_s = at.stamp_s;
  if (const auto pose = poses_.at(at)) scans_.set_pose(*pose, scan);
  if (const auto heading = headings_.at(at)) scan.compass_rad = heading->theta_rad;
  return scan;
}

RangeReading LogReader::reading_of(const Item& item) {
  const ros2::RangeMessage& message = item.range->message;
  const Mounted place = place_of(message.header.frame);
  const auto [number, is_new] = sensors_.try_emplace(*item.topic + " " + message.header.frame, next_sensor_);
  if (is_new) ++next_sensor_;
  const SonarConfig& sonar = config_.sonar;
  RangeReading reading{place.T_base_sensor,
                       sonar.half_beam_rad.value_or(0.5 * message.field_of_view_rad),
                       sonar.min_m.value_or(message.min_m),
                       sonar.max_m.value_or(message.max_m),
                       0.0,
                       number->second};
  const bool has_beam = reading.half_beam_rad >= 0.0 && reading.half_beam_rad <= 0.5 * std::numbers::pi;
  if (!has_beam || !(reading.min_m >= 0.0 && reading.min_m < reading.max_m && reading.max_m <= kFarthest_m))
    throw ros2::MessageError("field_of_view, min_range and max_range are those of no sensor");
  return reading;
}

void LogReader::add_ranges(std::span<const Item> items) {
  std::vector<RangeReading> readings;
  std::vector<double> ranges;
  std::string key = "range";
  for (const Item& item : items)
    guarded(item.range->offset, [&] {
      const RangeReading reading = reading_of(item);
      readings.push_back(reading);
      ranges.push_back(item.range->message.range_m);
      key += " " + std::to_string(reading.sensor);
      for (const double value : {reading.half_beam_rad, reading.min_m, reading.max_m})
        key += " " + config_detail::number_text(value);
    });
  if (readings.empty()) return;
  const std::size_t source = scans_.source(key, [&] { return readings; });
  scans_.add_recorded(scan_at(items.front().at()), source, std::move(ranges));
}

void LogReader::add_scan(const Item& item) {
  const ros2::LaserScanMessage& message = item.scan->message;
  const Mounted place = place_of(message.header.frame);
  const std::size_t count = message.ranges_m.size();
  if (count == 0 || count > kMaxBeams || !std::isfinite(message.first_rad) || !std::isfinite(message.step_rad))
    throw ros2::MessageError("the angles are those of no laser");
  log_common::LaserConfig laser = config_.laser;
  if (message.min_m >= 0.0) laser.min_m = std::max(laser.min_m, message.min_m);
  const double max_m = laser.max_m.value_or(message.max_m);
  if (!(laser.min_m < max_m && max_m <= kFarthest_m))
    throw ros2::MessageError("range_min and range_max are those of no laser");
  const double sense = place.is_upside_down ? -1.0 : 1.0;
  const log_common::Fan fan{laser.placed(place.T_base_sensor), sense * message.first_rad, sense * message.step_rad,
                            max_m};
  const std::string key =
      "laser " + *item.topic + " " + config_detail::number_text(laser.min_m) + " " + log_common::key_of(fan, count);
  const std::size_t source = scans_.source(key, [&] {
    const int first = next_sensor_;
    next_sensor_ += static_cast<int>(count);
    return log_common::readings_of(fan, count, laser, first);
  });
  scans_.add_recorded(scan_at(item.at()), source, {message.ranges_m.begin(), message.ranges_m.end()});
}

}  // namespace

ScanLog read_mcap_log(const Config& config, const Budget& budget) {
  log_common::check_limits(config.file, "laser", config.laser);
  return LogReader(config, budget).read().scans;
}

LogWithPictures read_with_pictures(const Config& config, const std::vector<CameraModel>& cameras,
                                   const Budget& budget) {
  log_common::check_limits(config.file, "laser", config.laser);
  return LogReader(config, budget, &cameras).read();
}

}  // namespace cairn::mcap_log

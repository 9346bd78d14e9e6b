#include "plugins/ros2_robot/image_topics.hpp"

#include <chrono>
#include <optional>
#include <stdexcept>

#include "framework/live/steady_time.hpp"
#include "plugins/common/pictures/grey_picture.hpp"
#include "plugins/ros2_robot/messages.hpp"

namespace cairn::ros2_robot {
namespace {

constexpr std::size_t kMaxWaiting = 16;
constexpr int kKeptImages = 2;  // of a topic, until they are taken: those behind are of no use

double system_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

ImageTopics::ImageTopics(const Config& config, const RobotModel& robot, bool wants_images)
    : config_(config), robot_(robot), wants_images_(wants_images), damaged_(config.images.size()) {
  if (!wants_images) return;
  for (const ImageTopic& image : config.images) try {
      (void)pictures::camera_of(image.camera, robot.cameras);
    } catch (const std::runtime_error& error) {
      throw std::invalid_argument("ros2_robot: " + image.topic + ": " + error.what());
    }
}

void ImageTopics::open(const Participant& participant) {
  if (!wants_images_) return;
  readers_.reserve(config_.images.size());
  for (const ImageTopic& image : config_.images)
    readers_.push_back(participant.reader(
        image.topic,
        image.kind == ImageKind::raw ? sensor_msgs_msg_dds__Image__desc : sensor_msgs_msg_dds__CompressedImage__desc,
        Reading::best_effort, kKeptImages));
}

template <class Message>
std::optional<CameraImage> ImageTopics::undamaged(const Message& message, std::size_t i) {
  const ImageTopic& topic = config_.images[i];
  bool is_read = false;
  try {
    CameraImage image = picture_of(message);
    is_read = true;
    pictures::check_size(image.width_px, image.height_px, pictures::camera_of(topic.camera, robot_.cameras));
    damaged_[i] = 0;
    return image;
  } catch (const std::runtime_error& error) {
    if (!is_read && ++damaged_[i] < kMaxDamaged) return std::nullopt;
    throw std::runtime_error(topic.topic + ": " + error.what());
  }
}

void ImageTopics::take(ros::HeardTopics& heard) {
  for (std::size_t i = 0; i < readers_.size(); ++i) {
    const ImageTopic& topic = config_.images[i];
    const auto take = [&](const auto& message) {
      const double arrived_s = live::now_s();
      const ros::Header header = header_of(message.header);
      heard.add(topic.topic, arrived_s, header.frame, header.stamp_s, system_s());
      std::optional<CameraImage> image = undamaged(message, i);
      if (!image) return;
      image->camera = topic.camera;
      image->stamp_s = config_.stamp == Stamp::header ? header.stamp_s : arrived_s;
      if (waiting_.size() == kMaxWaiting) waiting_.erase(waiting_.begin());
      waiting_.push_back(std::move(*image));
    };
    if (topic.kind == ImageKind::raw)
      take_all<Image>(readers_[i].get(), take);
    else
      take_all<CompressedImage>(readers_[i].get(), take);
  }
}

void ImageTopics::move_into(Observation& observation, double said_s) {
  std::vector<CameraImage> ahead;
  for (CameraImage& image : waiting_) {
    const double age_s = said_s - image.stamp_s;
    if (age_s < 0.0 && age_s >= -kMaxAhead_s) ahead.push_back(std::move(image));
    if (age_s < 0.0 || age_s > kMaxBehind_s) continue;
    image.stamp_s = observation.stamp_s - age_s;
    observation.images.push_back(std::move(image));
  }
  waiting_ = std::move(ahead);
}

}  // namespace cairn::ros2_robot

#include "plugins/ros2_robot/range_topics.hpp"

#include <stdexcept>

#include "framework/live/steady_time.hpp"
#include "plugins/ros2_robot/messages.hpp"

namespace cairn::ros2_robot {
namespace {

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

void take_from(dds_entity_t reader, const RangeTopic& topic, ros::RobotObserver& observer) {
  const double arrived_s = live::now_s();
  const auto take = [&](const auto& message) { observer.take(topic, message_of(message), arrived_s); };
  const auto take_cloud = [&](const auto& cloud) {
    std::vector<Point> points_m;
    try {
      points_m = points_of(cloud);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(topic.topic + ": " + error.what());
    }
    observer.take(topic, header_of(cloud.header), points_m, arrived_s);
  };
  if (topic.kind == RangeKind::range)
    take_all<Range>(reader, take);
  else if (topic.kind == RangeKind::laser)
    take_all<LaserScan>(reader, take);
  else if (topic.kind == RangeKind::point_cloud)
    take_all<PointCloud>(reader, take_cloud);
  else
    take_all<PointCloud2>(reader, take_cloud);
}

}  // namespace

void RangeTopics::open(const Participant& participant) {
  for (const RangeTopic& range : config_.ranges)
    readers_.push_back(participant.reader(range.topic, type_of(range.kind)));
}

void RangeTopics::take(ros::RobotObserver& observer) const {
  for (std::size_t i = 0; i < readers_.size(); ++i) take_from(readers_[i].get(), config_.ranges[i], observer);
}

}  // namespace cairn::ros2_robot

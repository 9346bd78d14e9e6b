// What there is of the topics that this robot is connected by, for people who look at it.
#pragma once

#include <string>

#include "framework/contracts/optional/connection_report.hpp"
#include "plugins/common/ros/heard_topics.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"

namespace cairn::ros2_robot {

// steady: it is published all the time, so that silence is a fault. said_rarely: somebody must publish it, once or now
// and then. optional: somebody may.
enum class Importance { steady, said_rarely, optional };

class TopicReport {
 public:
  // All as they are now; participant and heard must outlive it. heard null: nothing was read yet.
  TopicReport(const Participant& participant, const ros::HeardTopics* heard, double now_s);

  // Who publishes what the reader reads, and what has come.
  [[nodiscard]] ConnectionPart of_reader(const Entity& reader, Importance importance) const;
  // Who listens to velocities, and who else publishes them but the guard, if there is one. One of the writers may be
  // empty.
  [[nodiscard]] ConnectionPart of_velocities(const std::string& topic, const Entity& twist, const Entity& twist_stamped,
                                             bool has_guard) const;
  // What others publish, velocities left out.
  [[nodiscard]] ConnectionPart of_network(const std::string& name, const std::string& velocities) const;

 private:
  const ros::HeardTopics* heard_;
  double now_s_;
  std::vector<Endpoint> publishers_;
  std::vector<Endpoint> subscribers_;
};

}  // namespace cairn::ros2_robot

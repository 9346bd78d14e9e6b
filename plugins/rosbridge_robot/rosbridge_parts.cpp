// What a robot behind a rosbridge_server is connected by, for people who look at it.
#include <fmt/format.h>

#include <algorithm>

#include "framework/live/steady_time.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"
#include "plugins/rosbridge_robot/json_messages.hpp"
#include "plugins/rosbridge_robot/rosbridge_link.hpp"

namespace cairn::rosbridge_robot {

std::vector<ConnectionPart> RosbridgeLink::parts() {
  std::vector<ConnectionPart> parts{server_part()};
  for (const Subscriptions::Topic& topic : subscriptions_.topics()) parts.push_back(topic_part(topic, live::now_s()));
  parts.push_back(velocity_part());
  return parts;
}

ConnectionPart RosbridgeLink::server_part() const {
  ConnectionPart part{address_.text(), {{"ros", std::to_string(config_.ros)}}, closed_why_};
  part.values.push_back({"rosapi", known_.types() ? counted(known_.types()->size(), "topic") : "does not answer"});
  part.values.push_back({"messages not understood", std::to_string(not_understood_)});
  if (!last_warning_.empty()) part.values.push_back({"last warning", last_warning_});
  return part;
}

ConnectionPart RosbridgeLink::topic_part(const Subscriptions::Topic& topic, double now_s) const {
  ConnectionPart part{topic.name, {{"type", topic.type}}, {}};
  const ros::HeardTopics& heard = observer_.heard();
  const bool is_heard = heard.find(topic.name) != nullptr;
  std::ranges::move(heard.values_of(topic.name, now_s), std::back_inserter(part.values));
  const auto& known = known_.types();
  if (known && known->contains(topic.name) && known->at(topic.name) != topic.type)
    part.problem =
        fmt::format("it is {}, and {} is read: see `ros` and the topic's `type`", known->at(topic.name), topic.type);
  else if (topic.is_steady && !is_heard && known && !known->contains(topic.name)) {
    std::vector<std::string> names;
    for (const auto& [name, type] : *known) names.push_back(name);
    part.problem = "nobody publishes it" + did_you_mean(topic.name, names);
  } else if (topic.is_steady && !is_heard) {
    part.problem = "nothing comes: does its driver run?";
  } else if (config_.stamp == ros::Stamp::header &&
             std::ranges::find(config_.ranges, topic.name, &ros::RangeTopic::topic) != config_.ranges.end()) {
    part.problem = heard.clocks_apart(topic.name, config_.odometry);
  }
  return part;
}

ConnectionPart RosbridgeLink::velocity_part() const {
  const CommandTopic& command = config_.command;
  const std::string type =
      type_name(command.kind == CommandKind::twist ? "geometry_msgs/Twist" : "geometry_msgs/TwistStamped", config_.ros);
  ConnectionPart part{command.topic, {{"type", type}}, {}};
  const auto listeners = known_.listeners();
  part.values.push_back({"heard by", listeners ? counted(*listeners, "subscriber") : "not known"});
  const auto& known = known_.types();
  if (known && known->contains(command.topic) && known->at(command.topic) != type)
    part.problem = fmt::format("{} is wanted: set `command: {{type: {}}}`", known->at(command.topic),
                               command.kind == CommandKind::twist ? "twist_stamped" : "twist");
  else if (listeners == std::size_t{0})
    part.problem = "no base listens to it: the robot would not move";
  return part;
}

}  // namespace cairn::rosbridge_robot

// The topics that are read: asked for, asked for again while they are silent, and taken apart.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "plugins/common/ros/robot_observer.hpp"
#include "plugins/rosbridge_robot/config.hpp"

namespace cairn::rosbridge_robot {

class Subscriptions {
 public:
  // steady: published all the time, so that silence is a fault.
  struct Topic {
    std::string name;
    std::string type;  // as this version of ROS names it
    int queue_length = 1;
    int throttle_ms = 0;
    bool is_steady = false;
    bool is_asked_again = true;  // not what is said once, which could be missed meanwhile
    std::function<void(const nlohmann::json& msg, double arrived_s)> take{};
    double asked_s = 0.0;
    bool is_heard = false;  // since it was first asked for
  };

  // Both must outlive it.
  Subscriptions(const Config& config, ros::RobotObserver& observer);

  // What asks for all of them.
  [[nodiscard]] std::vector<std::string> requests(double now_s);
  // The same for those that have said nothing for two seconds since: a rosbridge that was asked before somebody
  // published a topic may have chosen qualities of service that do not fit.
  [[nodiscard]] std::vector<std::string> repeated_requests(double now_s);
  // The observation that the odometry makes. Throws std::runtime_error with the topic and what about it cannot be.
  [[nodiscard]] std::optional<Observation> take(const std::string& topic, const nlohmann::json& msg, double arrived_s);

  [[nodiscard]] const std::vector<Topic>& topics() const { return topics_; }

 private:
  void add(const std::string& name, const std::string& type, bool is_steady,
           std::function<void(const nlohmann::json&, double)> take);
  void add_ranges();

  const Config& config_;
  ros::RobotObserver& observer_;
  std::vector<Topic> topics_;
  std::vector<float> ranges_m_;
  std::optional<Observation> observed_;
};

}  // namespace cairn::rosbridge_robot

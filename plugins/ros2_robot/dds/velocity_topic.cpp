#include "plugins/ros2_robot/dds/velocity_topic.hpp"

#include <array>
#include <chrono>

#include "framework/live/steady_time.hpp"
#include "plugins/ros2_robot/messages.hpp"

namespace cairn::ros2_robot {
namespace {

constexpr double kLookEvery_s = 0.5;

double base_time_s(double ahead_s) {
  if (ahead_s != 0.0) return live::now_s() + ahead_s;
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

VelocityTopic::VelocityTopic(const Participant& participant, const CommandTopic& topic) : frame_(topic.frame) {
  if (topic.kind != CommandKind::twist_stamped)
    twist_ = participant.writer(topic.topic, geometry_msgs_msg_dds__Twist__desc);
  if (topic.kind != CommandKind::twist)
    twist_stamped_ = participant.writer(topic.topic, geometry_msgs_msg_dds__TwistStamped__desc);
}

void VelocityTopic::look_who_listens(double now_s) {
  if (now_s - looked_s_ < kLookEvery_s) return;
  looked_s_ = now_s;
  sends_twist_ = is_read(twist_);
  sends_stamped_ = is_read(twist_stamped_);
  if (sends_twist_ || sends_stamped_) heard_s_ = now_s;
}

void VelocityTopic::send(const Twist& twist, double base_ahead_s) noexcept {
  const TwistMessage message{{twist.v_mps, 0.0, 0.0}, {0.0, 0.0, twist.w_radps}};
  if (sends_twist_) (void)dds_write(twist_.get(), &message);
  if (!sends_stamped_) return;
  std::array<char, 256> frame{};
  frame_.copy(frame.data(), frame.size() - 1);
  const TwistStamped stamped{{time_of(base_time_s(base_ahead_s)), frame.data()}, message};
  (void)dds_write(twist_stamped_.get(), &stamped);
}

}  // namespace cairn::ros2_robot

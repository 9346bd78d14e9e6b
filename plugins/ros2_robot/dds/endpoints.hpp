// A participant of a ROS 2 network without ROS: DDS topics under ROS's names, by CycloneDDS.
#pragma once

#include <dds/dds.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "plugins/ros2_robot/dds/qos_profile.hpp"

namespace cairn::ros2_robot {

// A DDS entity that is deleted with its owner, and with all that belongs to it.
class Entity {
 public:
  explicit Entity(dds_entity_t handle = 0) : handle_(handle) {}
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Entity() {
    if (handle_ > 0) dds_delete(handle_);
  }
  [[nodiscard]] dds_entity_t get() const { return handle_; }
  [[nodiscard]] explicit operator bool() const { return handle_ > 0; }
  // It is deleted with its parent from now on.
  [[nodiscard]] dds_entity_t release() { return std::exchange(handle_, 0); }

 private:
  dds_entity_t handle_;
};

struct NetworkChoice {
  int domain = 0;
  bool is_local = false;  // the loopback interface only
  std::string interface;
  std::vector<std::string> peers;
  bool is_without_multicast = false;  // only this computer and the peers are asked
};

// Whether a name or address has no character that could end what it stands in.
[[nodiscard]] bool is_plain(const std::string& text);

// "rt/scan" is /scan; what has no such name is as it is.
[[nodiscard]] std::string ros_name_of(const std::string& topic);
// "sensor_msgs::msg::dds_::LaserScan_" is sensor_msgs/msg/LaserScan.
[[nodiscard]] std::string ros_type_of(std::string type);

// What others offer or want.
struct Endpoint {
  std::string topic;  // as ROS names it: /scan
  std::string type;   // sensor_msgs/msg/LaserScan
  QosProfile profile;
  std::array<unsigned char, 16> participant{};  // whose it is
};

// best_effort fits whatever is offered; reliable is for what is said once; latched is also what was written before the
// reader was there, as /tf_static.
enum class Reading { best_effort, reliable, latched };
// latched: the last message is for those, too, who come later.
enum class Writing { passing, latched };

class Participant {
 public:
  // Throws std::runtime_error with DDS's reason.
  explicit Participant(const NetworkChoice& network);

  static constexpr int kKept = 50;  // messages of a reader

  // Throw std::runtime_error.
  [[nodiscard]] Entity reader(const std::string& name, const dds_topic_descriptor_t& type,
                              Reading reading = Reading::best_effort, int kept = kKept) const;
  // Writes reliably: that fits whatever is wanted.
  [[nodiscard]] Entity writer(const std::string& name, const dds_topic_descriptor_t& type,
                              Writing writing = Writing::passing) const;

  // Of others, as known now.
  [[nodiscard]] std::vector<Endpoint> publishers() const { return others(publications_); }
  [[nodiscard]] std::vector<Endpoint> subscribers() const { return others(subscriptions_); }

 private:
  [[nodiscard]] Entity topic(const std::string& name, const dds_topic_descriptor_t& type) const;
  [[nodiscard]] std::vector<Endpoint> others(const Entity& builtin) const;

  Entity domain_;
  Entity participant_;
  Entity publications_;
  Entity subscriptions_;
};

// Somebody has subscribed to what it writes.
[[nodiscard]] bool is_read(const Entity& writer);

// Samples that DDS has lent, which go back to it whatever happens.
class Loan {
 public:
  Loan(dds_entity_t reader, void** samples, dds_return_t count) : reader_(reader), samples_(samples), count_(count) {}
  ~Loan() {
    if (count_ > 0) (void)dds_return_loan(reader_, samples_, count_);
  }
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;

 private:
  dds_entity_t reader_;
  void** samples_;
  dds_return_t count_;
};

// The messages that have come, oldest first, at most as many as the reader keeps, each with who has written it.
template <class Message>
void take_all_from(dds_entity_t reader, const std::function<void(const Message&, dds_instance_handle_t)>& take) {
  constexpr std::size_t kAtOnce = 16;
  for (;;) {
    void* samples[kAtOnce] = {};
    dds_sample_info_t infos[kAtOnce];
    const dds_return_t count = dds_take(reader, samples, infos, kAtOnce, kAtOnce);
    const Loan loan(reader, samples, count);
    for (dds_return_t i = 0; i < count; ++i)
      if (infos[i].valid_data) take(*static_cast<const Message*>(samples[i]), infos[i].publication_handle);
    if (count < static_cast<dds_return_t>(kAtOnce)) return;
  }
}

template <class Message>
void take_all(dds_entity_t reader, const std::function<void(const Message&)>& take) {
  take_all_from<Message>(reader, [&](const Message& message, dds_instance_handle_t) { take(message); });
}

}  // namespace cairn::ros2_robot

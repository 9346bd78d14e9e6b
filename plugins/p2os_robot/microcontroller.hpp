// The microcontroller of a Pioneer at a serial line.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "framework/contracts/robot_model.hpp"
#include "framework/live/base_link.hpp"
#include "framework/live/descriptor.hpp"
#include "framework/live/guard_process.hpp"
#include "plugins/p2os_robot/config.hpp"
#include "plugins/p2os_robot/counted_odometry.hpp"
#include "plugins/p2os_robot/packet.hpp"
#include "plugins/p2os_robot/units.hpp"

namespace cairn::p2os_robot {

// What a robot says of itself when it is connected to.
struct Identity {
  std::string name;
  std::string robot_class;
  std::string subclass;
};

class Microcontroller final : public live::BaseLink {
 public:
  // Throws std::invalid_argument with a setting that cannot be.
  Microcontroller(const Config& config, const RobotModel& robot);
  ~Microcontroller() override;

  [[nodiscard]] std::string name() const override { return "the robot at " + config_.device.string(); }
  [[nodiscard]] bool connect(const Budget& budget, std::string& why) override;
  void disconnect() override;
  [[nodiscard]] bool receive(std::vector<Observation>& seen) override;
  [[nodiscard]] std::vector<ConnectionPart> parts() override;
  void send(const Twist& twist) noexcept override;
  void send_pulse() noexcept override;
  void beat() noexcept override;
  bool send_stop() noexcept override;

 private:
  // False: the other end is gone.
  [[nodiscard]] bool read_line();
  void write(const CommandPacket& packet) noexcept;
  // The data of the next packet for which there is time; none: the time is up.
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> wait_for_packet(double until_s, const Budget& budget);
  [[nodiscard]] std::optional<Identity> synchronised(const Budget& budget, std::string& why);
  void begin_session(const Identity& identity);
  [[nodiscard]] Observation observation_of(const Information& seen);
  // Who holds the wheels, by the flags; empty: nobody.
  [[nodiscard]] std::string holder_of(const Information& seen);

  Config config_;
  RobotModel robot_;
  // One descriptor for life, so that send_stop() never writes to another file: while not connected it is `nowhere_`.
  Descriptor nowhere_;
  Descriptor line_;
  std::unique_ptr<live::GuardProcess> guard_;
  std::mutex guarding_;
  PacketReader reader_;
  Units units_;
  CountedOdometry odometry_;
  // What has been heard in this session:
  std::optional<Identity> identity_;
  int packets_ = 0;
  double first_packet_s_ = 0.0;
  double last_packet_s_ = 0.0;
  double battery_v_ = 0.0;
  double begun_s_ = 0.0;
  bool has_enabled_motors_ = false;
  bool were_motors_on_ = false;       // in this session
  std::string holder_;                // kept from one session to the next
  std::atomic<bool> is_held_{false};  // the same, for the thread that sends
};

}  // namespace cairn::p2os_robot

// A base that is a process of its own, or somebody else's program, over a socket (docs/live.md). Plugin `remote_base`,
// kind sensor.
//
// The base sets the pace: next() waits for it. What has come since the last tick is one observation. When the base is
// silent or gone, next() connects again for a while; then it is a fault. The wheels stop by the base's own time.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>

#include "framework/config/fields.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/sensor.hpp"
#include "framework/live/continuity.hpp"
#include "framework/live/line_socket.hpp"

namespace cairn::remote_base {

struct Config {
  std::filesystem::path socket;
  std::string host = "localhost";
  int port = 0;
  double silent_s = 1.0;
  double reconnect_s = 10.0;

  static void describe(Fields<Config>& fields);
};

class RemoteBase final : public Sensor, public Drive {
 public:
  // Connects when it is used first. Throws std::invalid_argument when neither a socket nor a port is given.
  RemoteBase(const Config& config, const RobotModel& robot);

  // A call that its budget ends is a fault that says so, and the next one goes on.
  SensorStep next(const Budget& budget) override;
  Drive* drive() override { return this; }

  // Throws std::invalid_argument when not finite. What the base does not take within 20 ms ends the connection.
  void command(const Twist& twist, double valid_for_s) override;
  void stop() noexcept override;

 private:
  void connect();
  void disconnect(const std::string& why);
  // The observations that have come, as one; connects and waits up to some ms for them.
  [[nodiscard]] std::optional<Observation> wait_for_observation();
  [[nodiscard]] std::optional<Observation> received();

  Config config_;
  RobotModel robot_;
  live::Address address_;
  // One descriptor for life, so that stop() never writes to another file: while not connected it is `nowhere_`.
  Descriptor nowhere_;
  Descriptor link_;
  bool is_connected_ = false;
  std::string disconnect_reason_;  // why it is not connected
  std::string fault_;              // that has ended it
  live::LineReader reader_;
  live::Continuity continuity_;
  double received_s_ = 0.0;
  bool is_asked_ = false;
  std::atomic<bool> is_stop_sent_{false};
};

}  // namespace cairn::remote_base

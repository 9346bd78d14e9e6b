// Says what a sensor waits for while it is asked where the robot begins: at once, and again and again. Nothing watches
// over the mission before it has begun.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "framework/contracts/sensor.hpp"

namespace cairn {

class StartWait {
 public:
  // As long as it lives; the sensor must, too. on_wait: by a thread of its own; may be empty.
  StartWait(const Sensor& sensor, std::function<void(const std::string& sentence)> on_wait,
            std::chrono::milliseconds every = std::chrono::seconds(10));

 private:
  void watch(const std::stop_token& ended);

  const Sensor& sensor_;
  std::function<void(const std::string&)> on_wait_;
  std::chrono::milliseconds every_;
  std::mutex mutex_;
  std::condition_variable_any never_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace cairn

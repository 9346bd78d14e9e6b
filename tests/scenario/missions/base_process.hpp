// A simulated base in a process of its own, and the program that drives it: what the wheels did, by the base's log.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace cairn::testing_program {

// `cairn` with these arguments in the background; killed with its owner.
class Background {
 public:
  Background(const std::vector<std::string>& arguments, const std::filesystem::path& output);
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  ~Background();

  void send(int signal) const;
  // Once it has ended; killed when that takes longer than 60 s.
  [[nodiscard]] int exit_status();
  // Standard output and standard error.
  [[nodiscard]] std::string output() const;

 private:
  int child_ = -1;
  std::filesystem::path output_;
};

// One line of the base's log.
struct WheelTick {
  double monotonic_s = 0.0;  // as CLOCK_MONOTONIC, for all processes
  double stamp_s = 0.0;      // the base's own clock
  double ordered_v_mps = 0.0;
  double driven_v_mps = 0.0;
};
[[nodiscard]] std::vector<WheelTick> wheel_ticks(const std::filesystem::path& log);
[[nodiscard]] double monotonic_s();

// As long as it takes, at most 60 s; whether it has come about.
[[nodiscard]] bool wait_for(const std::function<bool()>& condition);
// The wheels turn at nearly 0.3 m/s, some time after `after_s`.
[[nodiscard]] bool wait_until_driving(const std::filesystem::path& log, double after_s = 0.0);
// They stand.
[[nodiscard]] bool wait_until_standing(const std::filesystem::path& log, double after_s);

}  // namespace cairn::testing_program

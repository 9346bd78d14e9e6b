// A robot of Enki in a process of its own, for the tests that drive it.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace cairn::testing_program {

// A line of the log (tests/enki/enki_world.hpp).
struct EnkiTick {
  double monotonic_s = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double angle_deg = 0.0;
  double v_mps = 0.0;
  double touches = 0.0;
};

class EnkiRobot : public testing::Test {
 protected:
  // In the world of config/missions/enki_pioneer.yaml, at the link line_. Skips the test where Enki is not installed.
  void begin_at_the_line();
  // In the world of config/missions/enki_ros2.yaml, in domain_. Skips the test where one of them is not installed.
  void begin_in_the_domain();
  void TearDown() override;
  [[nodiscard]] std::vector<EnkiTick> ticks() const;

  const std::filesystem::path folder_;
  const std::filesystem::path log_;
  const std::filesystem::path line_;
  const std::string domain_;

  EnkiRobot();

 private:
  // The program is there once that file is.
  void begin(const std::vector<std::string>& words, const std::filesystem::path& appears);

  pid_t process_ = -1;
};

}  // namespace cairn::testing_program

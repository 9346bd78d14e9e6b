// What a base and its client say to each other: one JSON object a line (docs/live.md).
//
//   base:   {"stamp_s":1.24,"odometry":{"x_m":0.31,"y_m":0,"theta_rad":0},"ranges":[{"sensor":3,"range_m":2.5}]}
//   client: {"v_mps":0.2,"w_radps":0,"valid_for_s":0.5}   {"stop":true}   {"next":true}
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn::live {

inline constexpr std::size_t kMaxLineBytes = std::size_t{1} << 20U;

inline constexpr std::string_view kStopLine = "{\"stop\":true}\n";
inline constexpr std::string_view kNextLine = "{\"next\":true}\n";

// Without its line end; to the last bit. What the robot's file says of a transducer is left out.
[[nodiscard]] std::string line_of(const Observation& observation, const RobotModel& robot);
[[nodiscard]] std::string fault_line(const std::string& reason);

// What a base says. Neither: something that this version does not know.
struct BaseLine {
  std::optional<Observation> observation;
  std::string fault;  // the base's own words
};
// Throws std::runtime_error with what is wrong. A range beyond max_m is no echo, one below min_m is too near.
[[nodiscard]] BaseLine base_line(std::string_view line, const RobotModel& robot);

// Hot: no allocation. With its line end.
class CommandLine {
 public:
  CommandLine(const Twist& twist, double valid_for_s);
  [[nodiscard]] std::string_view text() const { return {text_.data(), size_}; }

 private:
  std::array<char, 160> text_{};
  std::size_t size_ = 0;
};

// What a client says.
struct ClientLine {
  enum class Kind { command, stop, next, unknown } kind = Kind::unknown;
  Twist twist{};
  double valid_for_s = 0.0;
};
// Throws std::runtime_error with what is wrong.
[[nodiscard]] ClientLine client_line(std::string_view line);

}  // namespace cairn::live

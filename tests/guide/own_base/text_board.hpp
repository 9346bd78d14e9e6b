// A base of one's own: a board at a serial line that talks in lines of text (docs/your-robot.md).
//
//   board says   "at X_mm Y_mm HEADING_mrad", twenty times a second; "sonar NUMBER RANGE_mm", 0: no echo
//   board takes  "go V_mmps W_mradps"; without one for half a second it stands
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "framework/live/base_link.hpp"
#include "framework/live/continuity.hpp"
#include "framework/live/descriptor.hpp"
#include "framework/live/live_robot.hpp"
#include "framework/live/steady_time.hpp"

namespace text_board {

struct Config {
  std::filesystem::path device = "/dev/ttyACM0";
  cairn::live::LiveRules stop_when;

  static void describe(cairn::Fields<Config>& fields) {
    fields.file("device", &Config::device, "the serial line to the board");
    fields.group("stop_when", &Config::stop_when, "when the wheels stand by themselves");
  }
};

class TextBoard final : public cairn::live::BaseLink {
 public:
  TextBoard(const Config& config, const cairn::RobotModel& robot)
      : config_(config),
        robot_(robot),
        nowhere_(::open("/dev/null", O_WRONLY | O_CLOEXEC)),
        line_(::fcntl(nowhere_.get(), F_DUPFD_CLOEXEC, 0)),
        continuity_(robot) {}
  ~TextBoard() override { disconnect(); }

  [[nodiscard]] std::string name() const override { return "the board at " + config_.device.string(); }

  // The wheels are ordered to stand first, whatever they did before.
  [[nodiscard]] bool connect(const cairn::Budget& /*budget*/, std::string& why) override {
    const cairn::Descriptor port(::open(config_.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    termios line{};
    if (port.get() < 0 || ::tcgetattr(port.get(), &line) != 0) {
      why = config_.device.string() + ": " + std::strerror(errno);
      return false;
    }
    ::cfmakeraw(&line);
    ::cfsetspeed(&line, B115200);
    ::tcsetattr(port.get(), TCSAFLUSH, &line);  // what was said before is old
    ::dup3(port.get(), line_.get(), O_CLOEXEC);
    heard_.clear();
    ranges_.clear();
    continuity_.interrupt();
    (void)send_stop();
    return true;
  }
  void disconnect() override {
    (void)send_stop();
    ::dup3(nowhere_.get(), line_.get(), O_CLOEXEC);
  }

  // Waits 20 ms at most. An odometry makes an observation, with the sonars since the last one.
  [[nodiscard]] bool receive(std::vector<cairn::Observation>& seen) override {
    pollfd ready{line_.get(), POLLIN, 0};
    if (::poll(&ready, 1, 20) <= 0) return true;
    char bytes[512];
    const ssize_t count = ::read(line_.get(), bytes, sizeof bytes);
    if (count <= 0) return count < 0 && (errno == EAGAIN || errno == EINTR);
    heard_.append(bytes, static_cast<std::size_t>(count));
    for (std::size_t end = heard_.find('\n'); end != std::string::npos; end = heard_.find('\n')) {
      take(heard_.substr(0, end), seen);
      heard_.erase(0, end + 1);
    }
    if (heard_.size() > 1000) heard_.clear();  // no line is so long
    return true;
  }

  // By another thread than receive().
  void send(const cairn::Twist& twist) noexcept override {
    say(std::lround(1000.0 * twist.v_mps), std::lround(1000.0 * twist.w_radps));
  }
  void send_pulse() noexcept override {}
  // From a signal handler, too: no lock, no allocation.
  bool send_stop() noexcept override {
    const int error = errno;
    constexpr char kStand[] = "go 0 0\n";
    const bool is_sent = ::write(line_.get(), kStand, sizeof kStand - 1) == static_cast<ssize_t>(sizeof kStand - 1);
    errno = error;
    return is_sent;
  }

 private:
  void take(const std::string& line, std::vector<cairn::Observation>& seen) {
    int x_mm = 0, y_mm = 0, heading_mrad = 0, number = 0, range_mm = 0;
    if (std::sscanf(line.c_str(), "at %d %d %d", &x_mm, &y_mm, &heading_mrad) == 3) {
      cairn::Observation now;
      now.stamp_s = cairn::live::now_s();
      now.T_odom_robot = {x_mm / 1000.0, y_mm / 1000.0, heading_mrad / 1000.0};
      now.ranges = std::move(ranges_);
      ranges_.clear();
      seen.push_back(continuity_.continued(std::move(now), cairn::live::now_s()));
    } else if (std::sscanf(line.c_str(), "sonar %d %d", &number, &range_mm) == 2 && number >= 0 &&
               number < static_cast<int>(robot_.sonars.size())) {
      ranges_.push_back(reading_of(number, range_mm / 1000.0));
    }
  }

  // With the place and the beam of its transducer, from the robot's file.
  [[nodiscard]] cairn::RangeReading reading_of(int number, double range_m) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const cairn::SonarModel& sonar = robot_.sonars[static_cast<std::size_t>(number)];
    if (range_m == 0.0 || range_m > sonar.max_m)
      range_m = kInfinity;  // no echo
    else if (range_m < sonar.min_m)
      range_m = -kInfinity;  // nearer than it can measure
    return {sonar.T_robot_sonar, sonar.half_beam_rad, sonar.min_m, sonar.max_m, range_m, number};
  }

  void say(long v_mmps, long w_mradps) const noexcept {
    char text[48];
    const int length = std::snprintf(text, sizeof text, "go %ld %ld\n", v_mmps, w_mradps);
    (void)!::write(line_.get(), text, static_cast<std::size_t>(length));
  }

  Config config_;
  cairn::RobotModel robot_;
  // One descriptor for life, so that send_stop() never writes to another file: while not connected it is /dev/null.
  cairn::Descriptor nowhere_;
  cairn::Descriptor line_;
  cairn::live::Continuity continuity_;  // stamps and odometry go on when the board starts again
  std::string heard_;
  std::vector<cairn::RangeReading> ranges_;  // since the last odometry
};

}  // namespace text_board

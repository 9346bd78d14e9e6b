#include "tests/plugins/p2os_robot/pioneer_on_a_terminal.hpp"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "framework/live/steady_time.hpp"
#include "plugins/p2os_robot/packet.hpp"

namespace cairn::p2os_robot {
namespace {

constexpr double kStep_s = 0.01;
constexpr double kFireEvery_s = 0.04;
constexpr int kMaxRange_counts = 5000;
constexpr int kMotorsOn = 0x01;
constexpr int kEmergency = 0x20;

}  // namespace

PioneerOnATerminal::PioneerOnATerminal(std::string subclass, std::unique_ptr<PioneerBody> body)
    : subclass_(std::move(subclass)), body_(std::move(body)) {
  open_terminal();
  thread_ = std::jthread([this](const std::stop_token& ended) { run(ended); });
}

void PioneerOnATerminal::open_terminal() {
  terminal_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  ::grantpt(terminal_);
  ::unlockpt(terminal_);
  device_ = ::ptsname(terminal_);
  held_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios line{};
  ::tcgetattr(held_, &line);
  ::cfmakeraw(&line);
  ::tcsetattr(held_, TCSANOW, &line);
}

void PioneerOnATerminal::close_terminal() {
  ::close(std::exchange(held_, -1));
  ::close(std::exchange(terminal_, -1));
}

void PioneerOnATerminal::plug(bool is_in) {
  wants_plugged_in_ = is_in;
  while (is_plugged_in_ != is_in) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

PioneerOnATerminal::~PioneerOnATerminal() {
  thread_.request_stop();
  thread_.join();
  if (is_plugged_in_) close_terminal();
}

std::optional<double> PioneerOnATerminal::wait_for_wheels(bool turning, double within_s) const {
  const double begin_s = live::now_s();
  while (live::now_s() - begin_s < within_s) {
    if ((v_mm_ != 0 || w_deg_ != 0) == turning) return live::now_s() - begin_s;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return std::nullopt;
}

void PioneerOnATerminal::run(const std::stop_token& ended) {
  PacketReader reader;
  double said_s = 0.0;
  double moved_s = live::now_s();
  while (!ended.stop_requested()) {
    std::this_thread::sleep_for(std::chrono::duration<double>(kStep_s));
    if (is_plugged_in_ != wants_plugged_in_) {
      wants_plugged_in_ ? open_terminal() : close_terminal();
      is_plugged_in_ = wants_plugged_in_.load();
    }
    std::uint8_t bytes[512];
    const ssize_t count = ::read(terminal_, bytes, sizeof bytes);
    if (count > 0) reader.take({bytes, static_cast<std::size_t>(count)});
    while (const auto data = reader.next()) obey(*data);
    const double now_s = live::now_s();
    turn_wheels(now_s);
    body_->drive({v_mm_ / 1000.0, radians(w_deg_)}, now_s - moved_s);
    driven_m_ = driven_m_ + v_mm_ / 1000.0 * (now_s - moved_s);
    moved_s = now_s;
    if (now_s - fired_s_ >= kFireEvery_s) {
      heard_.emplace_back(first_sonar + next_sonar_, body_->range_m(next_sonar_));
      next_sonar_ = (next_sonar_ + 1) % body_->sonars();
      fired_s_ = now_s;
    }
    if (is_in_session_ && now_s - said_s >= say_every_s) {
      said_s = now_s;
      say_information();
    }
  }
}

void PioneerOnATerminal::turn_wheels(double now_s) {
  const bool may_turn = now_s - heard_s_ <= watchdog_s && (flags & kMotorsOn) != 0;
  v_mm_ = may_turn ? ordered_v_mm_ : 0;
  w_deg_ = may_turn ? ordered_w_deg_ : 0;
}

void PioneerOnATerminal::obey(const std::vector<std::uint8_t>& data) {
  heard_s_ = live::now_s();
  ++commands_;
  const int number = data[0];
  const int value = data.size() < 4 ? 0 : (data[2] | data[3] << 8) * (data[1] == 0x1B ? -1 : 1);
  if (!is_in_session_) {
    if (number == 0) synchronised_ = 0;
    if (synchronised_ == 3 && number == 1) {
      is_in_session_ = true;
      synchronised_ = 0;
    } else if (number == synchronised_) {
      say(answer_to(synchronised_++));
    }
    return;
  }
  if (number == 2) {
    is_in_session_ = false;
    ordered_v_mm_ = ordered_w_deg_ = 0;
  }
  if (number == 4 && value == 1) {
    ++enables_;
    if ((flags & kEmergency) == 0) flags |= kMotorsOn;
  }
  if (number == 11) ordered_v_mm_ = value;
  if (number == 21) ordered_w_deg_ = value;
}

std::vector<std::uint8_t> PioneerOnATerminal::answer_to(int synchronisation) const {
  std::vector<std::uint8_t> answer{static_cast<std::uint8_t>(synchronisation)};
  if (synchronisation < 2) return answer;
  for (const std::string& text : {std::string("Robbi"), std::string("Pioneer"), subclass_}) {
    answer.insert(answer.end(), text.begin(), text.end());
    answer.push_back(0);
  }
  return answer;
}

void PioneerOnATerminal::say(const std::vector<std::uint8_t>& data) {
  if (is_silent) return;
  std::vector<std::uint8_t> packet{0xFA, 0xFB, static_cast<std::uint8_t>(data.size() + 2)};
  packet.insert(packet.end(), data.begin(), data.end());
  unsigned sum = checksum_of(data);
  if (is_damaging && packets_ % 3 == 0) sum ^= 0x55U;
  packet.push_back(static_cast<std::uint8_t>(sum >> 8U));
  packet.push_back(static_cast<std::uint8_t>(sum & 0xFFU));
  ++packets_;
  for (int i = 0; i < (is_doubling ? 2 : 1); ++i) (void)!::write(terminal_, packet.data(), packet.size());
}

void PioneerOnATerminal::say_information() {
  std::vector<std::uint8_t> data(20, 0);
  const auto set = [&](std::size_t at, int value) {
    data[at] = static_cast<std::uint8_t>(value & 0xFF);
    data[at + 1] = static_cast<std::uint8_t>(value >> 8 & 0xFF);
  };
  const Pose2 pose = body_->odometry();
  data[0] = v_mm_ == 0 && w_deg_ == 0 ? 0x32 : 0x33;
  set(1, static_cast<int>(std::lround(pose.x_m * 1000.0)) & 0x7FFF);
  set(3, static_cast<int>(std::lround(pose.y_m * 1000.0)) & 0x7FFF);
  set(5, static_cast<int>(std::lround(pose.theta_rad / (2.0 * std::numbers::pi) * 4096.0)));
  data[11] = 125;
  set(12, stall_and_bumpers | (body_->is_bumped() ? 0x0202 : 0));
  data[16] = static_cast<std::uint8_t>(flags);
  data[19] = static_cast<std::uint8_t>(heard_.size());
  for (const auto& [sonar, range_m] : heard_) {
    const int counts = static_cast<int>(std::min(1000.0 * range_m, double{kMaxRange_counts}));
    for (const int byte : {sonar, counts & 0xFF, counts >> 8}) data.push_back(static_cast<std::uint8_t>(byte));
  }
  heard_.clear();
  data.insert(data.end(), 6, 0);
  say(data);
}

}  // namespace cairn::p2os_robot

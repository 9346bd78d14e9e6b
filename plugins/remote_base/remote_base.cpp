#include "plugins/remote_base/remote_base.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "framework/live/steady_time.hpp"
#include "framework/live/wire.hpp"
#include "maps/base/spelling.hpp"

namespace cairn::remote_base {
namespace {

constexpr int kWait_ms = 20;
constexpr std::chrono::milliseconds kTryAgainAfter(50);
constexpr std::size_t kQuotedBytes = 60;

live::Address address_of(const Config& config) {
  if (!config.socket.empty()) return {config.socket.string(), {}, 0};
  if (config.port > 0) return {{}, config.host, config.port};
  throw std::invalid_argument("remote_base: where is the base? `socket: PATH` or `port: NUMBER`");
}

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", value);
  return text;
}

SensorStep fault_of(std::string reason) {
  SensorStep step;
  step.state = SensorState::fault;
  step.reason = std::move(reason);
  return step;
}

}  // namespace

void Config::describe(Fields<Config>& fields) {
  fields.file("socket", &Config::socket, "Unix-domain socket on which the base listens");
  fields.text("host", &Config::host, "without a socket: the base's computer, localhost or an IPv4 address");
  fields.integer("port", &Config::port, {0, 65535}, "without a socket: the TCP port on which the base listens");
  fields.number("silent_s", &Config::silent_s, {0.1, 60.0}, "s",
                "a base that sends nothing for so long is connected to again");
  fields.number("reconnect_s", &Config::reconnect_s, {0.0, 3600.0}, "s",
                "without an observation for so long the mission ends; less than the mission's watchdog_s");
}

RemoteBase::RemoteBase(const Config& config, const RobotModel& robot)
    : config_(config),
      robot_(robot),
      address_(address_of(config)),
      nowhere_(::open("/dev/null", O_WRONLY | O_CLOEXEC)),
      link_(::fcntl(nowhere_.get(), F_DUPFD_CLOEXEC, 0)),
      continuity_(robot_) {
  if (link_.get() < 0) throw std::runtime_error("remote_base: no descriptor is left");
}

SensorStep RemoteBase::next(const Budget& budget) {
  if (!fault_.empty()) return fault_of(fault_);
  const double begin_s = live::now_s();
  received_s_ = begin_s;
  while (!budget.exhausted()) {
    std::optional<Observation> seen;
    try {
      seen = wait_for_observation();
    } catch (const std::exception& error) {
      fault_ = "the base at " + live::text_of(address_) + " " + error.what();
      disconnect("");
      return fault_of(fault_);
    }
    if (seen) return {SensorState::observation, std::move(*seen), {}};
    if (const double waited_s = live::now_s() - begin_s; waited_s > config_.reconnect_s) {
      fault_ = "no observation from the base at " + live::text_of(address_) + " for " + seconds(waited_s) +
               (disconnect_reason_.empty() ? "" : ": " + disconnect_reason_);
      disconnect(disconnect_reason_);
      return fault_of(fault_);
    }
  }
  return fault_of("cancelled while waiting for the base at " + live::text_of(address_));
}

std::optional<Observation> RemoteBase::wait_for_observation() {
  if (!is_connected_) connect();
  if (!is_connected_) {
    std::this_thread::sleep_for(kTryAgainAfter);
    return std::nullopt;
  }
  if (!is_asked_) is_asked_ = live::send_now(link_.get(), live::kNextLine);
  pollfd ready{link_.get(), POLLIN, 0};
  (void)::poll(&ready, 1, kWait_ms);
  const bool is_there = reader_.read(link_.get());
  std::optional<Observation> seen = received();
  if (!is_there)
    disconnect(disconnect_reason_.empty() ? "it has closed the connection" : disconnect_reason_);
  else if (live::now_s() - received_s_ > config_.silent_s)
    disconnect("it sends nothing");
  return seen;
}

std::optional<Observation> RemoteBase::received() {
  std::vector<Observation> seen;
  const double arrived_s = live::now_s();
  while (const auto line = reader_.next()) {
    live::BaseLine message;
    try {
      message = live::base_line(*line, robot_);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(std::string("sent what is no observation: ") + error.what() + " in " +
                               in_quotes(line->substr(0, kQuotedBytes)));
    }
    if (!message.fault.empty()) disconnect_reason_ = message.fault;
    if (message.observation) seen.push_back(continuity_.continued(std::move(*message.observation), arrived_s));
  }
  if (seen.empty()) return std::nullopt;
  received_s_ = arrived_s;
  disconnect_reason_.clear();
  is_asked_ = false;
  return live::assembled(std::move(seen));
}

// Whatever was ordered before a gap does not count any more.
void RemoteBase::connect() {
  std::string error;
  const Descriptor made = live::connect_to(address_, error);
  if (made.get() < 0) {
    disconnect_reason_ = error;
    return;
  }
  ::dup3(made.get(), link_.get(), O_CLOEXEC);
  is_connected_ = true;
  is_asked_ = false;
  is_stop_sent_ = live::send_now(link_.get(), live::kStopLine);
  received_s_ = live::now_s();
  reader_.clear();
}

void RemoteBase::disconnect(const std::string& why) {
  stop();
  ::dup3(nowhere_.get(), link_.get(), O_CLOEXEC);
  is_connected_ = false;
  continuity_.interrupt();
  disconnect_reason_ = why;
}

void RemoteBase::command(const Twist& twist, double valid_for_s) {
  if (!is_finite(twist) || !std::isfinite(valid_for_s))
    throw std::invalid_argument("remote_base: the command is not finite");
  if (!is_connected_ && fault_.empty()) connect();
  if (!is_connected_) return;
  const live::CommandLine line(twist, valid_for_s);
  // Before and after, so that no stop() in between is left out for an earlier one.
  is_stop_sent_ = false;
  bool is_sent = live::send_now(link_.get(), line.text());
  if (!is_sent && errno == EAGAIN) {
    pollfd ready{link_.get(), POLLOUT, 0};
    is_sent = ::poll(&ready, 1, kWait_ms) == 1 && live::send_now(link_.get(), line.text());
  }
  is_stop_sent_ = false;
  if (!is_sent) ::shutdown(link_.get(), SHUT_RDWR);  // next() finds it closed
}

void RemoteBase::stop() noexcept {
  if (is_stop_sent_.load(std::memory_order_relaxed)) return;
  const int error = errno;
  if (live::send_now(link_.get(), live::kStopLine)) is_stop_sent_ = true;
  errno = error;
}

}  // namespace cairn::remote_base

#include "framework/live/live_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "framework/live/continuity.hpp"
#include "framework/live/steady_time.hpp"

namespace cairn::live {
namespace {

constexpr std::chrono::milliseconds kSendEvery(50);
constexpr std::chrono::milliseconds kTryAgainAfter(50);
constexpr double kSayZeroFor_s = 0.5;
constexpr double kConnectAgainAfter_s = 0.5;
constexpr double kPulseEvery_s = 0.5;
constexpr double kMissionLivesFor_s = 1.0;
constexpr double kPeopleWonderAfter_s = 0.7;

SensorStep fault_of(std::string reason) {
  SensorStep step;
  step.state = SensorState::fault;
  step.reason = std::move(reason);
  return step;
}

bool stands(const Twist& twist) {
  return twist.v_mps == 0.0 && twist.w_radps == 0.0;
}

}  // namespace

void LiveRules::describe(Fields<LiveRules>& fields) {
  fields.number("order_older_s", &LiveRules::order_older_s, {0.1, 1.0}, "s",
                "the wheels stand when no new velocity has been ordered for so long");
  fields.number("silent_s", &LiveRules::silent_s, {0.1, 60.0}, "s",
                "the wheels stand when the base has said nothing for so long; after half a second more it is connected "
                "again");
  fields.number("reconnect_s", &LiveRules::reconnect_s, {0.0, 3600.0}, "s",
                "without an observation for so long the mission ends; less than the mission's watchdog_s");
}

LiveRobot::LiveRobot(std::unique_ptr<BaseLink> link, const LiveRules& rules, const RobotModel& robot)
    : link_(std::move(link)),
      rules_(rules),
      robot_(robot),
      sender_([this](const std::stop_token& ended) { send_orders(ended); }) {}

LiveRobot::~LiveRobot() {
  stop();
  sender_.request_stop();
  sender_.join();
  disconnect("");
}

SensorStep LiveRobot::next(const Budget& budget) {
  if (!fault_.empty()) return fault_of(fault_);
  const double begin_s = now_s();
  heard_s_ = begin_s;  // nobody has listened meanwhile
  while (!budget.exhausted()) {
    asked_s_ = now_s();
    note_wait(begin_s);
    std::optional<Observation> seen;
    try {
      seen = wait_for_observation(budget);
    } catch (const std::exception& error) {
      fault_ = link_->name() + ": " + error.what();
      disconnect("");
      return fault_of(fault_);
    }
    if (seen) {
      note_wait(std::nullopt);
      return {SensorState::observation, std::move(*seen), {}};
    }
    if (const double waited_s = now_s() - begin_s; waited_s > rules_.reconnect_s) {
      fault_ = fmt::format("no observation from {} for {:.1f} s{}{}", link_->name(), waited_s,
                           disconnect_reason_.empty() ? "" : ": ", disconnect_reason_);
      disconnect(disconnect_reason_);
      return fault_of(fault_);
    }
  }
  return fault_of("cancelled while waiting for " + link_->name());
}

void LiveRobot::note_wait(std::optional<double> since_s) {
  const std::scoped_lock lock(waiting_);
  waits_since_s_ = since_s;
  wait_reason_ = disconnect_reason_;
}

std::optional<Pose2> LiveRobot::start() const {
  struct Wait {
    explicit Wait(std::atomic<bool>& waits) : waits_(waits) { waits_ = true; }
    ~Wait() { waits_ = false; }
    Wait(const Wait&) = delete;
    Wait& operator=(const Wait&) = delete;
    std::atomic<bool>& waits_;
  };
  const Wait wait(waits_for_start_);
  return link_->start();
}

std::string LiveRobot::waits_for() const {
  if (waits_for_start_) {
    const std::string awaited = link_->awaited_start();
    return awaited.empty() ? awaited : "waiting for " + awaited;
  }
  const std::scoped_lock lock(waiting_);
  if (!waits_since_s_ || now_s() - *waits_since_s_ < kPeopleWonderAfter_s) return {};
  return fmt::format("waiting for {}, {:g} s at most{}{}", link_->awaited(), rules_.reconnect_s,
                     wait_reason_.empty() ? "" : "; ", wait_reason_);
}

std::optional<Observation> LiveRobot::wait_for_observation(const Budget& budget) {
  if (!is_connected_) {
    const bool is_made = link_->connect(budget, disconnect_reason_);
    if (!is_made) {
      std::this_thread::sleep_for(kTryAgainAfter);
      return std::nullopt;
    }
    orders_.stop();  // what was ordered before a gap does not count any more
    heard_s_ = now_s();
    const std::scoped_lock lock(sending_);
    is_connected_ = true;
    sent_ = {};
  }
  std::vector<Observation> seen;
  const bool is_there = link_->receive(seen);
  if (!seen.empty()) heard_s_ = now_s();
  if (!is_there)
    disconnect("it is gone");
  else if (now_s() - heard_s_ > rules_.silent_s + kConnectAgainAfter_s)
    disconnect("it says nothing");
  if (seen.empty()) return std::nullopt;
  if (is_there) disconnect_reason_.clear();
  return assembled(std::move(seen));
}

void LiveRobot::disconnect(const std::string& why) {
  stop();
  {
    const std::scoped_lock lock(sending_);
    if (is_connected_) link_->send({});
    is_connected_ = false;
  }
  link_->disconnect();
  disconnect_reason_ = why;
}

void LiveRobot::command(const Twist& twist, double valid_for_s) {
  if (!is_finite(twist) || !std::isfinite(valid_for_s))
    throw std::invalid_argument("the command to " + link_->name() + " is not finite");
  const double time_s = now_s();
  asked_s_ = time_s;
  orders_.order(twist, std::min(valid_for_s, rules_.order_older_s), time_s);
  {
    const std::scoped_lock lock(sending_);
    is_ordered_ = true;
  }
  ordered_.notify_one();
}

void LiveRobot::be_silent(double for_s) {
  silent_until_s_ = now_s() + for_s;
}

void LiveRobot::stop() noexcept {
  silent_until_s_ = 0.0;
  orders_.stop();
  const bool is_sent = link_->send_stop();
  if (!is_sent) ++stops_;
}

void LiveRobot::send_orders(const std::stop_token& ended) {
  auto wake = std::chrono::steady_clock::now();
  while (!ended.stop_requested()) {
    std::unique_lock lock(sending_);
    ordered_.wait_until(lock, ended, wake, [this] { return is_ordered_; });
    is_ordered_ = false;
    const auto now = std::chrono::steady_clock::now();
    if (now >= wake) wake = now + kSendEvery;
    link_->beat();
    if (is_connected_) send_what_counts(now_s());
  }
}

void LiveRobot::send_what_counts(double time_s) {
  if (time_s < silent_until_s_) {
    moved_s_ = time_s;  // zero is said afterwards
    return;
  }
  const std::uint64_t stops = stops_;
  Twist wanted = orders_.ordered(time_s);
  if (time_s - heard_s_ > rules_.silent_s) wanted = {};
  const double dt_s = std::clamp(time_s - sent_s_, 0.0, 2.0 * std::chrono::duration<double>(kSendEvery).count());
  sent_ = approached(sent_, wanted, dt_s, robot_);
  sent_s_ = time_s;
  if (!stands(sent_)) moved_s_ = time_s;
  if (time_s - moved_s_ < kSayZeroFor_s) {
    link_->send(sent_);
  } else if (time_s - asked_s_ < kMissionLivesFor_s && time_s - pulsed_s_ > kPulseEvery_s) {
    link_->send_pulse();
    pulsed_s_ = time_s;
  }
  if (stands(sent_)) stops_sent_ = stops;
}

}  // namespace cairn::live

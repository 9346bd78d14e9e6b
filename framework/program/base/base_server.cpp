#include "framework/program/base/base_server.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "framework/live/wire.hpp"

namespace cairn {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kMaxWait(50);       // then it looks whether it is to end
constexpr milliseconds kMaxBehind(200);    // what is missed beyond that is not made up for
constexpr double kNotSteppedYet_s = 0.04;  // until the second tick shows the period

}  // namespace

BaseServer::BaseServer(live::ServedRobot& robot, const live::Address& address, const BaseOptions& options)
    : robot_(robot), address_(address), pace_(options.pace), listening_(live::listen_at(address)) {
  if (options.log.empty()) return;
  try {
    log_ = std::make_unique<GrowingFile>(options.log);
    log_->append("monotonic_s,stamp_s,ordered_v_mps,ordered_w_radps,driven_v_mps,driven_w_radps\n");
    log_->flush();
  } catch (const OutputError& error) {
    throw std::runtime_error(options.log.string() + ": " + error.what());
  }
}

BaseServer::~BaseServer() {
  std::error_code none;
  if (!address_.socket.empty()) std::filesystem::remove(address_.socket, none);
}

void BaseServer::run(const std::atomic<bool>& end) {
  due_ = Clock::now();
  while (!end) {
    wait_until(due_, end);
    if (end) return;
    if (pace_ > 0.0 || robot_.take_request()) tick();
  }
}

// Hears the client meanwhile. Without a pace of its own: until the client asks.
void BaseServer::wait_until(Clock::time_point due, const std::atomic<bool>& end) {
  do {
    const auto left = std::chrono::ceil<milliseconds>(due - Clock::now());
    const auto wait = pace_ > 0.0 ? std::clamp(left, milliseconds(0), kMaxWait) : kMaxWait;
    pollfd ready[] = {{listening_.get(), POLLIN, 0}, {client_.get(), POLLIN, 0}};
    if (::poll(ready, 2, static_cast<int>(wait.count())) <= 0) continue;
    read_client();
    accept_client();
    if (pace_ <= 0.0) return;
  } while (!end && Clock::now() < due);
}

void BaseServer::read_client() {
  if (client_.get() < 0) return;
  bool is_there = reader_.read(client_.get());
  while (const auto line = reader_.next())
    if (const std::string answer = robot_.take(*line); !answer.empty())
      is_there = writer_.write(client_.get(), answer) && is_there;
  if (!is_there) lose_client();
}

// Without a client nobody sees where the robot goes.
void BaseServer::lose_client() {
  client_ = Descriptor();
  robot_.stop();
}

void BaseServer::accept_client() {
  while (true) {
    Descriptor caller(::accept4(listening_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (caller.get() < 0) return;
    if (client_.get() >= 0) {
      (void)live::send_now(caller.get(), live::fault_line("another client drives this base") + "\n");
      continue;
    }
    const int on = 1;
    ::setsockopt(caller.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    client_ = std::move(caller);
    reader_.clear();
    writer_.clear();
    read_client();
  }
}

void BaseServer::tick() {
  const live::ServedRobot::Tick tick = robot_.tick();
  if (client_.get() >= 0 && !writer_.write(client_.get(), tick.line)) lose_client();
  if (!tick.fault.empty()) throw std::runtime_error(tick.fault);
  if (log_ != nullptr) write_log(tick);
  schedule(tick.stamp_s);
}

void BaseServer::schedule(double stamp_s) {
  if (pace_ <= 0.0) return;
  const double period_s = stamp_s_ ? stamp_s - *stamp_s_ : kNotSteppedYet_s;
  stamp_s_ = stamp_s;
  due_ += std::chrono::ceil<Clock::duration>(std::chrono::duration<double>(period_s / pace_));
  if (const auto now = Clock::now(); now - due_ > kMaxBehind) due_ = now;
}

// A log that cannot be written is left; the robot is not.
void BaseServer::write_log(const live::ServedRobot::Tick& tick) {
  const double now_s = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
  std::string line =
      fmt::format("{:.4f},{:.4f},{:.4f},{:.4f}", now_s, tick.stamp_s, tick.ordered.v_mps, tick.ordered.w_radps);
  line += tick.driven ? fmt::format(",{:.4f},{:.4f}\n", tick.driven->v_mps, tick.driven->w_radps) : ",,\n";
  try {
    log_->append(line);
    log_->flush();
  } catch (const OutputError& error) {
    std::cerr << "the log of the base ends here: " << error.what() << "\n";
    log_.reset();
  }
}

}  // namespace cairn

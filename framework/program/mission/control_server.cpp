#include "framework/program/mission/control_server.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "framework/mission/orders/order_text.hpp"
#include "framework/program/mission/status_json.hpp"
#include "maps/base/spelling.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

constexpr std::string_view kOrderPrefix = "order ";
constexpr seconds kAskWithin(2);
constexpr seconds kTickWithin(10);  // a planner may be at work
constexpr seconds kEndWithin(60);   // the map is saved
constexpr seconds kLineWithin(2);
constexpr std::size_t kMaxAnswers = 16;   // at once, to `status` and to all else
constexpr std::size_t kMaxCallers = 128;  // that have sent no command; beyond that, the oldest is disconnected
constexpr int kAcceptAtOnce = 64;
constexpr std::chrono::milliseconds kNoneLeftFor(100);

double rounded(double value) {
  return std::round(value * 1e3) / 1e3;
}

bool is_the_users(int connection) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (::getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return false;
  return peer.uid == ::geteuid() || peer.uid == 0;
}

std::string one_line(const ordered_json& answer) {
  return answer.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string refusal(const std::string& error) {
  return one_line({{"ok", false}, {"error", error}});
}

std::string command_rule() {
  return refusal("a command is one line of at most " + std::to_string(kMaxCommandBytes) + " bytes, sent within 2 s");
}

std::string answer_to_order(const std::string& text, RunControl& control, seconds at_most) {
  try {
    const Order order = parse_order(text);
    const OrderAnswer answer = control.orders().give(order, at_most);
    ordered_json json{{"ok", true},
                      {"command", "order"},
                      {"order", ordered_json::parse(order.text)},
                      {"taken", answer.is_taken},
                      {"reason", answer.reason}};
    if (answer.is_taken) json.update({{"tick", answer.tick}, {"time_s", rounded(answer.time_s)}});
    return one_line(json);
  } catch (const ConfigError& error) {
    return refusal(error.what());
  }
}

}  // namespace

std::string answer_to(const std::string& command, RunControl& control, Waiting waiting) {
  const auto within = [waiting](seconds limit) { return waiting == Waiting::until_done ? limit : seconds(0); };
  const std::vector<std::string> known{"pause", "resume", "cancel", "status", "watch", "order"};
  if (command.starts_with(kOrderPrefix))
    return answer_to_order(command.substr(kOrderPrefix.size()), control, within(kTickWithin));
  RunStatus status;
  if (command == "pause" || command == "resume") {
    const bool pause = command == "pause";
    control.flags().pause = pause;
    status = control.status_in(pause ? RunState::paused : RunState::running, within(kTickWithin));
  } else if (command == "cancel") {
    control.flags().cancel = true;
    status = control.status_in(RunState::ended, within(kEndWithin));
  } else if (command == "status") {
    status = control.status(within(kAskWithin));
  } else {
    return refusal("unknown command " + in_quotes(command) + did_you_mean(command, known) +
                   "; known are: pause, resume, cancel, status, watch, and order with JSON behind it");
  }
  ordered_json answer{{"ok", true}, {"command", command}};
  answer.update(json_of(status));
  return one_line(answer);
}

ControlServer::ControlServer(std::filesystem::path folder, RunControl& control, Watching watching)
    : folder_(std::move(folder)),
      control_(control),
      listening_(listen_in(folder_)),
      ending_(::eventfd(0, EFD_CLOEXEC)),
      watching_(std::move(watching)) {
  if (ending_.get() < 0) throw std::system_error(errno, std::generic_category(), "no descriptor is left");
  thread_ = std::thread([this] { serve(); });
}

ControlServer::~ControlServer() {
  const std::uint64_t one = 1;
  (void)!::write(ending_.get(), &one, sizeof one);
  thread_.join();
  answers_.clear();  // waits for them
  wait_for_last_lines(streams_);
  streams_.clear();
  remove_socket(folder_);
}

void ControlServer::serve() {
  while (wait_for_callers()) {
    read_callers();
    accept_clients();
  }
}

bool ControlServer::wait_for_callers() {
  std::vector<pollfd> ready{{listening_.get(), POLLIN, 0}, {ending_.get(), POLLIN, 0}};
  for (const Caller& caller : callers_) ready.push_back({caller.connection.get(), POLLIN, 0});
  int timeout_ms = -1;
  if (!callers_.empty()) {
    const auto left = callers_.front().until - Clock::now();
    timeout_ms = static_cast<int>(std::max<std::int64_t>(0, std::chrono::ceil<milliseconds>(left).count()));
  }
  if (::poll(ready.data(), ready.size(), timeout_ms) < 0 && errno != EINTR) return false;
  return ready[1].revents == 0;
}

void ControlServer::accept_clients() {
  for (int i = 0; i < kAcceptAtOnce; ++i) {
    Descriptor connection(::accept4(listening_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    if (connection.get() < 0) {
      if (errno == EAGAIN || errno == EINTR || errno == ECONNABORTED) return;
      if (callers_.empty()) return std::this_thread::sleep_for(kNoneLeftFor);  // no descriptors
      callers_.pop_front();
      continue;
    }
    const timeval at_most{kLineWithin.count(), 0};
    ::setsockopt(connection.get(), SOL_SOCKET, SO_SNDTIMEO, &at_most, sizeof at_most);
    if (!is_the_users(connection.get())) {
      write_line(connection.get(), refusal("only the user who runs the mission may control it"));
      continue;
    }
    callers_.push_back({std::move(connection), Clock::now() + kLineWithin});
    if (!read_caller(callers_.back())) callers_.pop_back();  // most have sent their line already
    if (callers_.size() > kMaxCallers) callers_.pop_front();
  }
}

void ControlServer::read_callers() {
  const Clock::time_point now = Clock::now();
  std::erase_if(callers_, [&](Caller& caller) {
    if (!read_caller(caller)) return true;
    if (caller.until > now) return false;
    write_line(caller.connection.get(), command_rule());
    return true;
  });
}

bool ControlServer::read_caller(Caller& caller) {
  std::array<char, kMaxCommandBytes + 2> buffer{};
  const ssize_t got = ::recv(caller.connection.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (got < 0) return errno == EAGAIN || errno == EINTR;
  if (got == 0 && caller.text.empty()) return false;
  caller.text.append(buffer.data(), static_cast<std::size_t>(got));
  const std::size_t end = std::min(caller.text.find('\n'), caller.text.size());
  const bool is_whole = got == 0 || end < caller.text.size();
  if (end > kMaxCommandBytes)
    write_line(caller.connection.get(), command_rule());
  else if (is_whole)
    begin_answer(std::move(caller.connection), caller.text.substr(0, end));
  else
    return true;
  return false;
}

void ControlServer::begin_watch(Descriptor connection, const std::string& command) {
  streams_.remove_if([](const WatchStream& stream) { return stream.has_ended(); });
  try {
    const WatchRequest request = watch_request_of(command);
    auto watch = watching_.source == nullptr ? nullptr : watching_.source->attach(kMaxWatches);
    if (!watch) {
      write_line(connection.get(), refusal("already watched by " + std::to_string(kMaxWatches)));
      return;
    }
    streams_.emplace_back(std::move(connection), std::move(watch), request, watching_.first_line, control_);
  } catch (const std::invalid_argument& error) {
    write_line(connection.get(), refusal(error.what()));
  } catch (const std::system_error&) {  // no thread is left: the connection closes unanswered
  }
}

void ControlServer::begin_answer(Descriptor connection, const std::string& command) {
  if (is_watch_request(command)) return begin_watch(std::move(connection), command);
  std::erase_if(answers_, [](const Answer& given) { return given.is_given.load(); });
  const bool is_status = command == "status";
  const auto under_way = std::ranges::count(answers_, is_status, &Answer::is_status);
  if (static_cast<std::size_t>(under_way) >= kMaxAnswers) {
    // The command takes effect all the same.
    write_line(connection.get(), answer_to(command, control_, Waiting::not_at_all));
    return;
  }
  Answer& here = answers_.emplace_back();
  here.is_status = is_status;
  try {
    here.thread = std::jthread([this, &here, command, connection = std::move(connection)] {
      write_line(connection.get(), answer_to(command, control_));
      here.is_given = true;
    });
  } catch (const std::system_error&) {
    answers_.pop_back();  // no thread is left: the connection closes unanswered, and the mission goes on
  }
}

}  // namespace cairn

#include "framework/program/mission/control_server.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "maps/base/spelling.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;
using std::chrono::seconds;

constexpr seconds kAskWithin(2);
constexpr seconds kTickWithin(10);  // a planner may be at work
constexpr seconds kEndWithin(60);   // the map is saved
constexpr seconds kLineWithin(2);
constexpr std::size_t kMaxAnswers = 16;  // at once
constexpr std::chrono::milliseconds kNoneLeftFor(100);

double rounded(double value) {
  return std::round(value * 1e3) / 1e3;
}

ordered_json number_or_null(double value) {
  return std::isfinite(value) ? ordered_json(rounded(value)) : ordered_json(nullptr);
}

ordered_json json_of(const RunStatus& status) {
  const TimeLeft none{0.0, std::numeric_limits<double>::infinity(), {""}};
  const TimeLeft& left = status.left ? *status.left : none;
  const bool is_known = left.without.empty() || left.about_s > 0.0;
  return {{"mission", status.mission},
          {"state", std::string(name_of(status.state))},
          {"step", status.step},
          {"steps", status.steps},
          {"step_name", status.step_name},
          {"node", status.node},
          {"doing", status.doing},
          {"time_s", rounded(status.time_s)},
          {"paused_s", rounded(status.paused_s)},
          {"explored_ratio", rounded(status.explored_ratio)},
          {"pose",
           {{"x_m", rounded(status.T_map_robot.x_m)},
            {"y_m", rounded(status.T_map_robot.y_m)},
            {"angle_deg", rounded(degrees(status.T_map_robot.theta_rad))}}},
          {"distance_m", rounded(status.distance_m)},
          {"landmarks", status.landmarks},
          {"eta_s", is_known && status.left ? ordered_json(rounded(left.about_s)) : ordered_json(nullptr)},
          {"eta_without", status.left ? left.without : std::vector<std::string>{}},
          {"eta_at_most_s", number_or_null(left.max_s)},
          {"outcome", status.outcome},
          {"reason", status.reason},
          {"map", status.map_file}};
}

bool is_the_users(int connection) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (::getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return false;
  return peer.uid == ::geteuid() || peer.uid == 0;
}

std::string refusal(const std::string& error) {
  return ordered_json{{"ok", false}, {"error", error}}.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

std::string answer_to(const std::string& command, RunControl& control) {
  const std::vector<std::string> known{"pause", "resume", "cancel", "status"};
  RunStatus status;
  if (command == "pause" || command == "resume") {
    const bool pause = command == "pause";
    control.flags().pause = pause;
    status = control.status_in(pause ? RunState::paused : RunState::running, kTickWithin);
  } else if (command == "cancel") {
    control.flags().cancel = true;
    status = control.status_in(RunState::ended, kEndWithin);
  } else if (command == "status") {
    status = control.status(kAskWithin);
  } else {
    return refusal("unknown command " + in_quotes(command) + did_you_mean(command, known) +
                   "; known are: pause, resume, cancel, status");
  }
  ordered_json answer{{"ok", true}, {"command", command}};
  answer.update(json_of(status));
  return answer.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

ControlServer::ControlServer(std::filesystem::path folder, RunControl& control)
    : folder_(std::move(folder)),
      control_(control),
      listening_(listen_in(folder_)),
      ending_(::eventfd(0, EFD_CLOEXEC)) {
  if (ending_.get() < 0) throw std::system_error(errno, std::generic_category(), "no descriptor is left");
  thread_ = std::thread([this] { serve(); });
}

ControlServer::~ControlServer() {
  const std::uint64_t one = 1;
  (void)!::write(ending_.get(), &one, sizeof one);
  thread_.join();
  answers_.clear();  // waits for them
  remove_socket(folder_);
}

void ControlServer::serve() {
  while (true) {
    pollfd ready[] = {{listening_.get(), POLLIN, 0}, {ending_.get(), POLLIN, 0}};
    if (::poll(ready, 2, -1) < 0) {
      if (errno == EINTR) continue;
      return;
    }
    if (ready[1].revents != 0) return;
    Descriptor connection(::accept4(listening_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    if (connection.get() >= 0)
      take(std::move(connection));
    else
      std::this_thread::sleep_for(kNoneLeftFor);  // no descriptors, or whoever called has gone
  }
}

void ControlServer::take(Descriptor connection) {
  std::erase_if(answers_, [](const Answer& given) { return given.is_given.load(); });
  if (answers_.size() >= kMaxAnswers) {
    write_line(connection.get(), refusal("too many commands at once; ask again"));
    return;
  }
  Answer& here = answers_.emplace_back();
  try {
    here.thread = std::jthread([this, &here, connection = std::move(connection)] {
      answer(connection.get());
      here.is_given = true;
    });
  } catch (const std::system_error&) {
    answers_.pop_back();  // no thread is left: the connection closes unanswered, and the mission goes on
  }
}

void ControlServer::answer(int connection) {
  const timeval at_most{kLineWithin.count(), 0};
  ::setsockopt(connection, SOL_SOCKET, SO_SNDTIMEO, &at_most, sizeof at_most);
  if (!is_the_users(connection)) {
    write_line(connection, refusal("only the user who runs the mission may control it"));
    return;
  }
  const std::optional<std::string> command = read_line(connection, kMaxCommandBytes, kLineWithin);
  write_line(connection, command ? answer_to(*command, control_)
                                 : refusal("a command is one line of at most " + std::to_string(kMaxCommandBytes) +
                                           " bytes, sent within 2 s"));
}

}  // namespace cairn

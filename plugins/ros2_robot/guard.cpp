#include "plugins/ros2_robot/guard.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "framework/live/steady_time.hpp"
#include "maps/base/text.hpp"
#include "plugins/ros2_robot/dds/velocity_topic.hpp"

namespace cairn::ros2_robot {
namespace {

constexpr int kLastStops = 5;
constexpr std::chrono::milliseconds kStopEvery(50);
constexpr std::size_t kWithoutPeers = 9;

std::vector<std::string> arguments_of(const GuardOrder& order, const std::string& program) {
  std::vector<std::string> all{program,
                               std::to_string(order.network.domain),
                               order.network.is_local ? "1" : "0",
                               order.network.interface,
                               order.velocity.topic,
                               std::to_string(static_cast<int>(order.velocity.kind)),
                               order.velocity.frame,
                               std::to_string(order.silence.count()),
                               order.network.is_without_multicast ? "1" : "0"};
  all.insert(all.end(), order.network.peers.begin(), order.network.peers.end());
  return all;
}

int number_in(const char* text) {
  const auto number = number_from<int>(text);
  if (!number) throw std::runtime_error(std::string(text) + " is no number");
  return *number;
}

GuardOrder order_in(std::span<const char* const> arguments) {
  if (arguments.size() < kWithoutPeers) throw std::runtime_error("is started by ros2_robot");
  GuardOrder order;
  order.network = {
      number_in(arguments[1]), number_in(arguments[2]) != 0, arguments[3], {}, number_in(arguments[8]) != 0};
  for (const char* peer : arguments.subspan(kWithoutPeers)) order.network.peers.emplace_back(peer);
  order.velocity.topic = arguments[4];
  order.velocity.kind = static_cast<CommandKind>(number_in(arguments[5]));
  order.velocity.frame = arguments[6];
  order.silence = std::chrono::milliseconds(number_in(arguments[7]));
  return order;
}

// In the new process. Whoever reads what this program prints must not wait for the guard.
void become(const char* program, char* const* arguments, int beats) {
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(beats, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  ::execv(program, arguments);
}

}  // namespace

std::unique_ptr<live::GuardProcess> guard_of(const GuardOrder& order, const std::filesystem::path& program) {
  if (::access(program.c_str(), X_OK) != 0)
    throw std::runtime_error(fmt::format("{}, which guards the wheels, is no program", program.string()));
  std::vector<std::string> arguments = arguments_of(order, program.string());
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  return std::make_unique<live::GuardProcess>([&](int beats) { become(program.c_str(), pointers.data(), beats); });
}

int run_guard(std::span<const char* const> arguments) {
  try {
    const GuardOrder order = order_in(arguments);
    const Participant participant(order.network);
    VelocityTopic velocity(participant, order.velocity);
    double ahead_s = 0.0;
    const auto stop = [&](double base_ahead_s) {
      ahead_s = base_ahead_s;
      velocity.look_who_listens(live::now_s());
      velocity.send({}, ahead_s);
    };
    live::watch_beats(STDIN_FILENO, order.silence, stop);
    for (int i = 0; i < kLastStops; ++i, std::this_thread::sleep_for(kStopEvery)) stop(ahead_s);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "ros2_guard: {}\n", error.what());
    return 2;
  }
}

}  // namespace cairn::ros2_robot

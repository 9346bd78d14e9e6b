#include "tests/scenario/missions/base_process.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <thread>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

constexpr double kPatience_s = 60.0;
constexpr double kStands_mps = 0.005;

}  // namespace

Background::Background(const std::vector<std::string>& arguments, const std::filesystem::path& output)
    : output_(output) {
  const std::string program = std::string(CAIRN_BINARY_DIR) + "/bin/cairn";
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  child_ = fork();
  if (child_ != 0) return;
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  execv(program.c_str(), argv.data());
  _exit(127);
}

Background::~Background() {
  if (child_ <= 0) return;
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
}

void Background::send(int signal) const {
  kill(child_, signal);
}

int Background::exit_status() {
  int status = 0;
  const bool has_ended = wait_for([&] { return waitpid(child_, &status, WNOHANG) == child_; });
  if (!has_ended) return -1;
  child_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::string Background::output() const {
  return text_of_file(output_);
}

std::vector<WheelTick> wheel_ticks(const std::filesystem::path& log) {
  std::vector<WheelTick> ticks;
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    WheelTick tick;
    double ordered_w = 0.0;
    const int found = std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &tick.monotonic_s, &tick.stamp_s,
                                  &tick.ordered_v_mps, &ordered_w, &tick.driven_v_mps);
    if (found == 5) ticks.push_back(tick);
  }
  return ticks;
}

double monotonic_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool wait_for(const std::function<bool()>& condition) {
  const double begin_s = monotonic_s();
  while (!condition()) {
    if (monotonic_s() - begin_s > kPatience_s) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

bool wait_until_driving(const std::filesystem::path& log, double after_s) {
  return wait_for([&] {
    const std::vector<WheelTick> ticks = wheel_ticks(log);
    return std::ranges::any_of(
        ticks, [&](const WheelTick& tick) { return tick.monotonic_s > after_s && tick.driven_v_mps > 0.29; });
  });
}

bool wait_until_standing(const std::filesystem::path& log, double after_s) {
  return wait_for([&] {
    const std::vector<WheelTick> ticks = wheel_ticks(log);
    return !ticks.empty() && ticks.back().monotonic_s > after_s && std::abs(ticks.back().driven_v_mps) < kStands_mps;
  });
}

}  // namespace cairn::testing_program

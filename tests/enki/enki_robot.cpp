#include "tests/enki/enki_robot.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "tests/scenario/missions/base_process.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {

EnkiRobot::EnkiRobot()
    : folder_(fresh_folder("enki")),
      log_(folder_ / "wheels.csv"),
      line_(folder_ / "pioneer"),
      domain_(std::to_string(200 + ::getpid() % 30)) {}

void EnkiRobot::begin_at_the_line() {
  begin({"enki_pioneer", source_folder() + "/config/missions/enki_pioneer.yaml", line_.string(), log_.string()}, line_);
}

void EnkiRobot::begin_in_the_domain() {
  if (!std::filesystem::exists(std::string(CAIRN_BINARY_DIR) + "/lib/cairn/ros2_robot.so"))
    GTEST_SKIP() << "cyclonedds-dev is not installed";
  begin({"enki_ros2", source_folder() + "/config/missions/enki_ros2.yaml", domain_, log_.string(),
         (folder_ / "latencies.csv").string()},
        log_);
}

void EnkiRobot::begin(const std::vector<std::string>& words, const std::filesystem::path& appears) {
  const std::string program = std::string(CAIRN_BINARY_DIR) + "/bin/" + words.front();
  if (!std::filesystem::exists(program))
    GTEST_SKIP() << words.front()
                 << " is not built: libenki-dev, or libfastrtps-dev and libfastcdr-dev, is not installed";
  std::vector<const char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(word.c_str());
  arguments.push_back(nullptr);
  // Linux shares the processors out by sessions: neither a robot nor what drives it waits for the neighbours of its
  // test.
  (void)::setsid();
  process_ = ::fork();
  if (process_ == 0) {
    (void)::setsid();
    ::execv(program.c_str(), const_cast<char* const*>(arguments.data()));
    ::_exit(127);
  }
  ASSERT_TRUE(wait_for([&] { return std::filesystem::exists(appears); }));
}

void EnkiRobot::TearDown() {
  if (process_ > 0) ::kill(process_, SIGKILL);
  if (process_ > 0) ::waitpid(process_, nullptr, 0);
  std::filesystem::remove_all(folder_);
}

std::vector<EnkiTick> EnkiRobot::ticks() const {
  std::vector<EnkiTick> all;
  std::ifstream file(log_);
  std::string text;
  std::getline(file, text);
  while (std::getline(file, text)) {
    std::istringstream line(text);
    EnkiTick tick;
    char comma = 0;
    if (line >> tick.monotonic_s >> comma >> tick.x_m >> comma >> tick.y_m >> comma >> tick.angle_deg >> comma >>
        tick.v_mps >> comma >> tick.touches)
      all.push_back(tick);
  }
  return all;
}

}  // namespace cairn::testing_program

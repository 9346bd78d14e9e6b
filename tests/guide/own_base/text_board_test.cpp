// The base of docs/your-robot.md, with a board on a pseudo-terminal that has no time-out of its own.
#include "tests/guide/own_base/text_board.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <thread>

namespace text_board {
namespace {

class BoardOnATerminal {
 public:
  BoardOnATerminal() : board_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    ::grantpt(board_);
    ::unlockpt(board_);
    device_ = ::ptsname(board_);
    held_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios line{};
    ::tcgetattr(held_, &line);
    ::cfmakeraw(&line);
    ::tcsetattr(held_, TCSANOW, &line);
    thread_ = std::jthread([this](const std::stop_token& ended) { run(ended); });
  }
  BoardOnATerminal(const BoardOnATerminal&) = delete;
  BoardOnATerminal& operator=(const BoardOnATerminal&) = delete;
  ~BoardOnATerminal() {
    thread_.request_stop();
    thread_.join();
    ::close(held_);
    ::close(board_);
  }

  std::atomic<bool> is_silent{false};
  std::atomic<int> v_mmps{0};

  [[nodiscard]] const std::string& device() const { return device_; }
  [[nodiscard]] bool stands_within(double within_s) const {
    for (const double until_s = cairn::live::now_s() + within_s; cairn::live::now_s() < until_s;
         std::this_thread::sleep_for(std::chrono::milliseconds(2)))
      if (v_mmps == 0) return true;
    return false;
  }

 private:
  void run(const std::stop_token& ended) {
    double x_mm = 0.0;
    while (!ended.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      char bytes[512];
      const ssize_t count = ::read(board_, bytes, sizeof bytes);
      if (count > 0) heard_.append(bytes, static_cast<std::size_t>(count));
      for (std::size_t end = heard_.find('\n'); end != std::string::npos; end = heard_.find('\n')) {
        int v = 0, w = 0;
        if (std::sscanf(heard_.c_str(), "go %d %d", &v, &w) == 2) v_mmps = v;
        heard_.erase(0, end + 1);
      }
      x_mm += 0.02 * v_mmps;
      char said[64];
      const int length = std::snprintf(said, sizeof said, "sonar 1 1500\nsonar 0 0\nnoise\nat %d 0 0\n",
                                       1000 + static_cast<int>(x_mm));
      if (!is_silent) (void)!::write(board_, said, static_cast<std::size_t>(length));
    }
  }

  int board_;
  int held_ = -1;  // the other end, so that the terminal is there without a client
  std::string device_;
  std::string heard_;
  std::jthread thread_;
};

class TextBoardTest : public testing::Test {
 protected:
  TextBoardTest() {
    robot.sonars.resize(2);
    Config config;
    config.device = board.device();
    driven.emplace(std::make_unique<TextBoard>(config, robot), config.stop_when, robot);
  }
  cairn::Observation drive(double for_s) {
    cairn::SensorStep step;
    for (const double until_s = cairn::live::now_s() + for_s; cairn::live::now_s() < until_s;) {
      step = driven->next({});
      EXPECT_EQ(step.state, cairn::SensorState::observation) << step.reason;
      driven->drive()->command({0.2, 0.0}, 0.3);
    }
    return step.observation;
  }

  BoardOnATerminal board;
  cairn::RobotModel robot;
  std::optional<cairn::live::LiveRobot> driven;
};

TEST_F(TextBoardTest, DrivesAndSees) {
  const cairn::Observation last = drive(1.0);
  EXPECT_EQ(board.v_mmps, 200);
  EXPECT_NEAR(last.T_odom_robot.x_m, 0.15, 0.08) << "from where it began";
  ASSERT_GE(last.ranges.size(), 2U);
  EXPECT_EQ(last.ranges[0].sensor, 1);
  EXPECT_EQ(last.ranges[0].range_m, 1.5);
  EXPECT_EQ(last.ranges[1].range_m, std::numeric_limits<double>::infinity()) << "no echo";
}

TEST_F(TextBoardTest, StandsWhenNobodyOrdersWhenTheBoardIsSilentAndWhenItIsDestroyed) {
  (void)drive(0.5);
  ASSERT_EQ(board.v_mmps, 200);
  EXPECT_TRUE(board.stands_within(0.5)) << "no order any more";
  (void)drive(0.5);
  board.is_silent = true;
  std::thread again([this] {
    EXPECT_TRUE(board.stands_within(0.5)) << "silence";
    board.is_silent = false;
  });
  EXPECT_EQ(driven->next({}).state, cairn::SensorState::observation);
  again.join();
  (void)drive(0.5);
  ASSERT_EQ(board.v_mmps, 200);
  driven.reset();
  EXPECT_TRUE(board.stands_within(0.5)) << "unloaded";
}

TEST(TextBoards, OneThatIsNotThereIsNamed) {
  Config config;
  config.device = "/dev/no_board";
  config.stop_when.reconnect_s = 0.1;
  cairn::live::LiveRobot driven(std::make_unique<TextBoard>(config, cairn::RobotModel{}), config.stop_when, {});
  EXPECT_THAT(driven.next({}).reason, testing::HasSubstr("no observation from the board at /dev/no_board for 0."));
  EXPECT_THAT(driven.next({}).reason, testing::HasSubstr("/dev/no_board: No such file or directory"));
}

}  // namespace
}  // namespace text_board

// The drive of docs/write-a-sensor.md does what that page says, with a pipe in place of the motor board's line.

#include "tests/guide/wheels/wheels.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <optional>

namespace wheels {
namespace {

class WheelsTest : public testing::Test {
 protected:
  WheelsTest() { EXPECT_EQ(::pipe2(ends_.data(), O_NONBLOCK | O_CLOEXEC), 0); }
  ~WheelsTest() override {
    for (const int end : ends_) ::close(end);
  }
  // What the board receives next; none: nothing was sent.
  [[nodiscard]] std::optional<Packet> received() const {
    Packet packet;
    if (::read(ends_[0], &packet, sizeof packet) != static_cast<ssize_t>(sizeof packet)) return std::nullopt;
    return packet;
  }

  std::array<int, 2> ends_{-1, -1};
  cairn::RobotModel robot_;
};

TEST_F(WheelsTest, ACommandReachesTheBoardWithItsTimeAndWithinTheLimits) {
  Wheels wheels(ends_[1], robot_);
  wheels.command({10.0, -0.5}, 0.5);
  const auto packet = received();
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->v_mps, robot_.max_v_mps);
  EXPECT_EQ(packet->w_radps, -0.5);
  EXPECT_EQ(packet->valid_for_s, 0.5);
}

TEST_F(WheelsTest, AVelocityThatIsNotFiniteIsRefusedAndNotSent) {
  Wheels wheels(ends_[1], robot_);
  EXPECT_THROW(wheels.command({std::numeric_limits<double>::quiet_NaN(), 0.0}, 0.5), std::invalid_argument);
  EXPECT_FALSE(received());
}

TEST_F(WheelsTest, AStopIsSentAtOnceAndTheNextCommandDrivesAgain) {
  Wheels wheels(ends_[1], robot_);
  wheels.stop();
  const auto stop = received();
  ASSERT_TRUE(stop);
  EXPECT_EQ(stop->v_mps, 0.0);
  EXPECT_EQ(stop->valid_for_s, 0.0);
  wheels.command({0.1, 0.0}, 0.5);
  EXPECT_EQ(received().value_or(Packet{}).v_mps, 0.1);
}

TEST_F(WheelsTest, ABoardThatTakesNoCommandIsReportedAndAStopReturnsAllTheSame) {
  Wheels wheels(ends_[1], robot_);
  EXPECT_THROW(for (int i = 0; i < 100'000; ++i) wheels.command({0.1, 0.0}, 0.5), std::runtime_error);
  wheels.stop();
}

}  // namespace
}  // namespace wheels

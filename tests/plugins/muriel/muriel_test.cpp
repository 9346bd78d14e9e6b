#include "plugins/muriel/muriel.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/muriel/test_readings.hpp"

namespace cairn::muriel {
namespace {

const Pose2 kMiddleOfCell0{0.025, 0.025, 0.0};

TEST(Muriel, SaysFreeBeforeAnEchoOccupiedAtItAndNothingBehind) {
  Muriel map{Config{}};
  (void)map.integrate(observed({sonar(1.0)}), at(kMiddleOfCell0));
  EXPECT_LT(map.grid().log_odds({10, 0}), -80);
  EXPECT_GT(map.grid().log_odds({20, 0}), 300);
  EXPECT_EQ(map.grid().log_odds({25, 0}), 0);
  EXPECT_EQ(map.grid().log_odds({-2, 0}), 0);
}

}  // namespace
}  // namespace cairn::muriel

#include "plugins/common/sonar_model/beam_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "maps/geometry/pose.hpp"

namespace cairn::sonar_model {
namespace {

const double kHalfBeam = radians(15.0);

BeamModel with_false_echoes(double per_m) {
  BeamModel model;
  model.false_echo_per_m = per_m;
  return model;
}

TEST(BeamModel, GivesTheMethodsCheckValuesOnTheAxis) {
  const BeamModel model = with_false_echoes(1.0);
  const auto at_echo = [&](double range_m) {
    return model.lambda_of_echo(model.alpha(range_m, 0.0, kHalfBeam), range_m, range_m);
  };
  EXPECT_NEAR(at_echo(1.0), 8.0, 0.05);
  EXPECT_NEAR(std::log(at_echo(1.0)), 2.1, 0.05);
  EXPECT_NEAR(at_echo(2.0), 3.8, 0.05);
  EXPECT_NEAR(std::log(at_echo(2.0)), 1.35, 0.05);
}

TEST(BeamModel, LetsTheChanceOfAnEchoFallWithRangeAndBearing) {
  const BeamModel model;
  EXPECT_DOUBLE_EQ(model.alpha(0.0, 0.0, kHalfBeam), 0.6);
  EXPECT_DOUBLE_EQ(model.alpha(2.0, 0.0, kHalfBeam), 0.3);
  EXPECT_DOUBLE_EQ(model.alpha(2.0, kHalfBeam / 2.0, kHalfBeam), 0.225);
  EXPECT_DOUBLE_EQ(model.alpha(2.0, -kHalfBeam / 2.0, kHalfBeam), 0.225);
  EXPECT_DOUBLE_EQ(model.alpha(2.0, kHalfBeam, kHalfBeam), 0.0);
  EXPECT_DOUBLE_EQ(model.alpha(4.0, 0.0, kHalfBeam), 0.0);
  EXPECT_DOUBLE_EQ(model.alpha(7.0, 0.0, kHalfBeam), 0.0);
  EXPECT_DOUBLE_EQ(model.alpha(2.0, 0.0, 0.0), 0.3);  // a ray is all axis
}

TEST(BeamModel, SaysFreeFarBeforeTheEchoAndNothingFarBehindIt) {
  const BeamModel model;
  EXPECT_DOUBLE_EQ(model.lambda_of_echo(0.45, 1.0, 3.0), 1.0 - 0.45);
  EXPECT_NEAR(model.lambda_of_echo(0.45, 1.0, 0.8), 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(model.lambda_of_silence(0.45, 1.0, 5.0), 1.0 - 0.45);
  EXPECT_DOUBLE_EQ(model.lambda_of_silence(0.45, 1.0, 1.0), 1.0 - 0.45 / 2.0);  // as likely beyond as not
}

TEST(BeamModel, HasNoStepWhereTheTailsAreCutOff) {
  const BeamModel model;
  const double delta_m = model.delta(1.0);
  for (const double z : {8.49, 8.51}) {
    const double phi = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    const double Phi = 0.5 * std::erfc(-z / std::numbers::sqrt2);
    const double full = 1.0 - 0.45 * Phi + 0.45 * phi / (model.false_echo_per_m * delta_m);
    EXPECT_NEAR(model.lambda_of_echo(0.45, 1.0, 1.0 + z * delta_m), full, 1e-12) << z;
  }
}

TEST(BeamModel, ReachesThreeRangeErrorsBehindTheEcho) {
  const BeamModel model;
  const double reach_m = model.reach_of_echo_m(2.0);
  EXPECT_NEAR(reach_m - 3.0 * model.delta(reach_m), 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(model.reach_of_echo_m(4.9), 4.0);
  EXPECT_DOUBLE_EQ(model.reach_of_silence_m(5.0), 4.0);
  EXPECT_DOUBLE_EQ(model.reach_of_silence_m(2.5), 2.5);
}

}  // namespace
}  // namespace cairn::sonar_model

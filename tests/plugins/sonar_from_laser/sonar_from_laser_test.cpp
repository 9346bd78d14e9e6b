#include "plugins/sonar_from_laser/sonar_from_laser.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "plugins/common/logs/derived_sonar.hpp"

namespace cairn::sonar_from_laser {
namespace {

using log_common::derived_range;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SonarModel sonar_at(double x_m, double y_m, double angle_deg) {
  return {{x_m, y_m, radians(angle_deg)}, radians(15.0), 0.2, 5.0};
}

// 181 beams from the robot's centre; range_of gives the range at an angle.
template <class RangeOf>
std::vector<RangeReading> fan(RangeOf range_of) {
  std::vector<RangeReading> beams;
  for (int i = 0; i <= 180; ++i) {
    const double angle_rad = radians(i - 90);
    beams.push_back({{0.0, 0.0, angle_rad}, 0.0, 0.05, 20.0, range_of(angle_rad), i});
  }
  return beams;
}

TEST(DerivedRange, IsTheNearestEchoInTheConeMeasuredFromTheSonar) {
  // A wall across the way at x = 2, seen slantwise: the nearest point is straight ahead.
  const auto wall = fan([](double angle) { return angle > -1.4 && angle < 1.4 ? 2.0 / std::cos(angle) : kInfinity; });
  EXPECT_NEAR(derived_range(sonar_at(0.15, 0.0, 0.0), wall).value(), 1.85, 1e-9);
  // Turned by 30 deg, the nearest in the cone is on its right edge.
  EXPECT_NEAR(derived_range(sonar_at(0.0, 0.0, 30.0), wall).value(), 2.0 / std::cos(radians(15.0)), 1e-9);
}

TEST(DerivedRange, AThinThingInTheConeIsTheEcho) {
  const auto thin = fan([](double angle) { return std::abs(angle - radians(10)) < 0.001 ? 1.0 : 3.0; });
  EXPECT_NEAR(derived_range(sonar_at(0.0, 0.0, 0.0), thin).value(), 1.0, 1e-9);
  EXPECT_NEAR(derived_range(sonar_at(0.0, 0.0, -10.0), thin).value(), 3.0, 1e-9) << "outside the cone";
}

TEST(DerivedRange, HasARuleForNoEchoTooNearAndNoBeam) {
  const auto far = fan([](double) { return 8.0; });
  EXPECT_EQ(derived_range(sonar_at(0.0, 0.0, 0.0), far), kInfinity) << "beyond the sonar's max_m";
  const auto silent = fan([](double) { return kInfinity; });
  EXPECT_EQ(derived_range(sonar_at(0.0, 0.0, 0.0), silent), kInfinity);
  const auto near = fan([](double) { return 0.15; });
  EXPECT_EQ(derived_range(sonar_at(0.0, 0.0, 0.0), near), -kInfinity) << "nearer than the sonar's min_m";
  EXPECT_EQ(derived_range(sonar_at(0.0, 0.0, 180.0), silent), std::nullopt) << "the laser does not look back";
  const auto bad = fan([](double) { return std::nan(""); });
  EXPECT_EQ(derived_range(sonar_at(0.0, 0.0, 0.0), bad), std::nullopt);
  EXPECT_EQ(derived_range(sonar_at(0.0, 0.0, 0.0), {}), std::nullopt);
}

TEST(DerivedRange, AgreesWithASearchOverPointsInTheMapFrame) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int round = 0; round < 200; ++round) {
    const auto beams = fan([&](double) { return 0.3 + 6.0 * uniform(random); });
    const SonarModel sonar =
        sonar_at(0.2 * uniform(random), 0.3 * uniform(random) - 0.15, 140.0 * uniform(random) - 70.0);
    double nearest_m = kInfinity;
    for (const RangeReading& beam : beams) {
      const Point p = beam.T_robot_sensor * Point(beam.range_m, 0.0) - sonar.T_robot_sonar.position();
      const double off_axis = std::acos(p.normalized().dot(sonar.T_robot_sonar.direction()));
      if (off_axis <= sonar.half_beam_rad) nearest_m = std::min(nearest_m, p.norm());
    }
    const double expected = nearest_m < sonar.min_m ? -kInfinity : nearest_m > sonar.max_m ? kInfinity : nearest_m;
    const double range_m = derived_range(sonar, beams).value();
    if (std::isfinite(expected)) {
      EXPECT_NEAR(range_m, expected, 1e-9);
    } else {
      EXPECT_EQ(range_m, expected);
    }
  }
}

// Two scans, then the end.
class TwoScans : public Sensor {
 public:
  SensorStep next(const Budget&) override {
    SensorStep step;
    step.reason = "end of scans";
    if (given_ == 2) return step;
    step.state = SensorState::observation;
    step.observation.stamp_s = given_++;
    step.observation.compass_rad = 0.5;
    step.observation.ranges = fan([](double) { return 2.0; });
    return step;
  }
  [[nodiscard]] std::optional<Pose2> start() const override { return Pose2{1.0, 2.0, 3.0}; }

 private:
  int given_ = 0;
};

TEST(SonarFromLaser, GivesOneObservationAScanAndSaysThatItIsDerived) {
  SonarFromLaser sensor(std::make_shared<TwoScans>(), {sonar_at(0.1, 0, 0), sonar_at(0, 0, 180), sonar_at(0, 0.1, 60)});
  EXPECT_EQ(sensor.start(), (Pose2{1.0, 2.0, 3.0}));
  (void)sensor.next({});
  const SensorStep step = sensor.next({});
  EXPECT_EQ(step.observation.stamp_s, 1.0);
  EXPECT_EQ(step.observation.compass_rad, 0.5);
  ASSERT_EQ(step.observation.ranges.size(), 2U) << "the one that looks back is left out";
  EXPECT_EQ(step.observation.ranges[1].sensor, 2);
  EXPECT_EQ(step.observation.ranges[1].half_beam_rad, radians(15.0));
  EXPECT_EQ(sensor.next({}).reason, "sonar readings derived from laser scans: end of scans");
}

TEST(SonarFromLaser, NeedsSonarsInTheRobotFile) {
  EXPECT_THROW(SonarFromLaser(std::make_shared<TwoScans>(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace cairn::sonar_from_laser

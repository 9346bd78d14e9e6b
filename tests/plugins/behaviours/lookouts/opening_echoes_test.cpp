#include "plugins/behaviours/lookouts/opening_echoes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace cairn::behaviours {
namespace {

// A wall along y at x = 0, 0.1 m thick, with a doorway, and a wall 2.5 m behind it.
struct Doorway {
  double from_m;
  double to_m;
};

// By rays: the nearest thing in the beam.
double range_of(const Doorway& door, const Pose2& T_map_sensor, double half_beam_rad) {
  constexpr int kRays = 61;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRays; ++i) {
    const double angle_rad = T_map_sensor.theta_rad + half_beam_rad * (2.0 * i / (kRays - 1) - 1.0);
    const Point ray = unit_vector(angle_rad);
    if (ray.x() <= 0.0) continue;
    double hit_m = (2.5 - T_map_sensor.x_m) / ray.x();
    for (const double face_m : {-0.05, 0.05}) {
      const double at_m = (face_m - T_map_sensor.x_m) / ray.x();
      const double y_m = T_map_sensor.y_m + at_m * ray.y();
      if (y_m < door.from_m || y_m > door.to_m) hit_m = std::min(hit_m, at_m);
    }
    nearest_m = std::min(nearest_m, hit_m);
  }
  return nearest_m;
}

Observation echoes_at(const Doorway& door, const Pose2& T_map_robot) {
  Observation seen;
  for (const double angle_deg : {-30.0, -10.0, 10.0, 30.0}) {
    RangeReading reading;
    reading.T_robot_sensor = {0.17, 0.0, radians(angle_deg)};
    reading.half_beam_rad = radians(15.0);
    reading.min_m = 0.1;
    reading.max_m = 5.0;
    reading.range_m = range_of(door, T_map_robot * reading.T_robot_sensor, reading.half_beam_rad);
    seen.ranges.push_back(reading);
  }
  return seen;
}

// A look from 0.7 m before it, sweeping by 20 degrees.
HeardOpening heard_in(const Doorway& door, const Point& at_m = {0.0, 0.0},
                      std::span<const RangeReading> false_echoes = {}) {
  OpeningEchoes echoes;
  const Point from_m = at_m - Point{0.7, 0.0};
  echoes.begin(at_m, from_m);
  for (double off_deg = -20.0; off_deg <= 20.0; off_deg += 2.0) {
    const Pose2 T_map_robot{from_m.x(), from_m.y(), radians(off_deg)};
    echoes.see(echoes_at(door, T_map_robot), T_map_robot);
  }
  Observation seen;
  seen.ranges.assign(false_echoes.begin(), false_echoes.end());
  echoes.see(seen, {from_m.x(), from_m.y(), 0.0});
  return echoes.heard();
}

TEST(OpeningEchoes, MeasureADoorByWhatIsHeardThroughIt) {
  for (const double width_m : {0.5, 0.6, 0.77, 0.9}) {
    const HeardOpening heard = heard_in({-0.5 * width_m, 0.5 * width_m});
    EXPECT_LE(heard.width_m, width_m + 0.03) << width_m;
    EXPECT_GE(heard.width_m, width_m - 0.15) << width_m;
    EXPECT_NEAR(heard.middle_m.y(), 0.0, 0.05) << width_m;
  }
}

TEST(OpeningEchoes, FindTheMiddleOfADoorThatTheMapHasBesideIt) {
  const HeardOpening heard = heard_in({-0.3, 0.5}, {0.0, -0.05});
  EXPECT_NEAR(heard.middle_m.y(), 0.1, 0.08);
  EXPECT_NEAR(heard.middle_m.x(), 0.0, 1e-9);
}

TEST(OpeningEchoes, AFalseEchoBesideADoorDoesNotMoveItsMiddle) {
  RangeReading crosstalk = echoes_at({5.0, 6.0}, {-0.7, 0.0, 0.0}).ranges.front();
  crosstalk.T_robot_sensor = {0.17, 0.0, radians(-40.0)};
  crosstalk.range_m = 3.0;
  const HeardOpening heard = heard_in({-0.38, 0.38}, {0.0, 0.0}, std::array{crosstalk});
  EXPECT_GT(heard.width_m, 0.8) << "it may be that wide";
  EXPECT_NEAR(heard.middle_m.y(), 0.0, 0.05);
}

TEST(OpeningEchoes, HearNothingThroughAWall) {
  EXPECT_EQ(heard_in({5.0, 6.0}).width_m, 0.0);
}

TEST(OpeningEchoes, ASlitIsNoWiderThanItIs) {
  EXPECT_LE(heard_in({-0.1, 0.1}).width_m, 0.2);
}

// The last reading of each transducer is an echo: it is not deaf.
HeardOpening heard_of_silence(double off_deg, int silent, bool has_echoed = true) {
  OpeningEchoes echoes;
  echoes.begin({0.0, 0.0}, {-0.7, 0.0});
  const Pose2 T_map_robot{-0.7, 0.0, radians(off_deg)};
  Observation seen = echoes_at({5.0, 6.0}, T_map_robot);  // a wall
  for (std::size_t i = 0; i < seen.ranges.size(); ++i) seen.ranges[i].sensor = static_cast<int>(i);
  if (has_echoed) echoes.see(seen, T_map_robot);
  for (RangeReading& reading : seen.ranges) reading.range_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i < silent; ++i) echoes.see(seen, T_map_robot);
  return echoes.heard();
}

TEST(OpeningEchoes, SilenceStraightAheadIsARoomThatIsDeeperThanTheRange) {
  EXPECT_GT(heard_of_silence(0.0, 3).width_m, 0.3);
}

TEST(OpeningEchoes, SilenceAtASlantSaysNothing) {
  EXPECT_EQ(heard_of_silence(60.0, 10).width_m, 0.0);
}

TEST(OpeningEchoes, SilenceOfOneReadingOrOfADeafTransducerSaysNothing) {
  EXPECT_EQ(heard_of_silence(0.0, 1).width_m, 0.0);
  EXPECT_EQ(heard_of_silence(0.0, 10, false).width_m, 0.0);
}

TEST(OpeningEchoes, ANewLookForgetsTheLastOne) {
  OpeningEchoes echoes;
  echoes.begin({0.0, 0.0}, {-0.7, 0.0});
  echoes.see(echoes_at({-0.4, 0.4}, {-0.7, 0.0, 0.0}), {-0.7, 0.0, 0.0});
  EXPECT_GT(echoes.heard().width_m, 0.0);
  echoes.begin({0.0, 0.0}, {-0.7, 0.0});
  EXPECT_EQ(echoes.heard().width_m, 0.0);
}

}  // namespace
}  // namespace cairn::behaviours

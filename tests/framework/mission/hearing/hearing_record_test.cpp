#include "framework/mission/hearing/hearing_record.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cairn {
namespace {

Observation answer(double stamp_s, double range_m, double x_m = 0.0) {
  Observation seen;
  seen.stamp_s = stamp_s;
  seen.T_odom_robot = {x_m, 0.0, 0.0};
  seen.ranges = {{{}, radians(15.0), 0.1, 5.0, range_m, 0}, {{0.0, 0.0, 2.0}, radians(15.0), 0.1, 5.0, 1.0, 1}};
  return seen;
}

constexpr double kNoEcho = std::numeric_limits<double>::infinity();

TEST(Hearing, NamesTransducersAsPeopleDo) {
  EXPECT_EQ(transducers_text({3}), "transducer 3");
  EXPECT_EQ(transducers_text({3, 4}), "transducers 3 and 4");
  EXPECT_EQ(transducers_text({0, 1, 2, 3}), "transducers 0 to 3");
  EXPECT_EQ(transducers_text({0, 2, 5}), "transducers 0, 2 and 5");
}

TEST(Hearing, SaysWhoWentDeafAndWhy) {
  EXPECT_EQ(text_of(WentDeaf{{3}, DeafCause::missed_echo}),
            "transducer 3 hears nothing where the map predicts an echo: the robot creeps to where only it looks");
  EXPECT_EQ(text_of(WentDeaf{{0, 1}, DeafCause::bump}),
            "transducers 0 and 1 hear nothing where the robot has bumped into something: the robot creeps to where "
            "only they look");
  EXPECT_EQ(text_of(HearsAgain{{3}}), "transducer 3 hears again");
}

TEST(Hearing, ARecordMakesOneEventOfAChangeAndASummaryOfAll) {
  DeafTransducers hearing({}, 1.0);
  HearingRecord record;
  EXPECT_TRUE(record.summary().empty());
  std::vector<Event> events;
  double time_s = 1.0;
  for (; time_s < 3.0; time_s += 0.28) {
    hearing.see(answer(time_s, kNoEcho), std::vector<ExpectedEcho>{{0, 1.0}});
    for (Event& event : record.update(hearing, time_s)) events.push_back(std::move(event));
  }
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(std::get<WentDeaf>(events[0]).sensors, std::vector{0});
  EXPECT_TRUE(record.is_deaf());
  EXPECT_EQ(record.summary().substr(0, 9), "deaf from");
  hearing.see(answer(time_s, 1.0), {});
  events = record.update(hearing, time_s);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(std::get<HearsAgain>(events[0]).sensors, std::vector{0});
  EXPECT_FALSE(record.is_deaf());
  EXPECT_NE(record.summary().find("deaf for a time between"), std::string::npos) << record.summary();
}

}  // namespace
}  // namespace cairn

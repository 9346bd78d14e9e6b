#include "framework/behaviour_tree/time_left.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

using testing::ElementsAre;

TEST(TimeLeft, OneAfterTheOtherTakesTheSumOfBoth) {
  const TimeLeft both = one_after_other({10.0, 30.0, {"goto"}}, {5.0, 20.0, {"save"}});
  EXPECT_EQ(both.about_s, 15.0);
  EXPECT_EQ(both.max_s, 50.0);
  EXPECT_THAT(both.without, ElementsAre("goto", "save"));
}

TEST(TimeLeft, HasNoEndWhenOnePartHasNone) {
  EXPECT_TRUE(std::isinf(one_after_other({10.0, 30.0, {}}, {5.0}).max_s));
}

TEST(TimeLeft, AnUnknownKindIsNamedOnce) {
  TimeLeft left;
  for (const char* kind : {"goto", "save", "goto"}) add_unknown(left, kind);
  EXPECT_THAT(left.without, ElementsAre("goto", "save"));
  EXPECT_THAT(one_after_other(left, left).without, ElementsAre("goto", "save"));
}

TEST(TimeLeft, ALimitCutsBothTimes) {
  const TimeLeft cut_short = cut({50.0, 90.0, {}}, 20.0);
  EXPECT_EQ(cut_short.about_s, 20.0);
  EXPECT_EQ(cut_short.max_s, 20.0);
  const TimeLeft within = cut({10.0, 15.0, {}}, 20.0);
  EXPECT_EQ(within.about_s, 10.0);
  EXPECT_EQ(within.max_s, 15.0);
}

TEST(TimeLeft, IsSaidWithWhatIsNotKnown) {
  EXPECT_EQ(text_of({80.0}), "about 80 s left");
  EXPECT_EQ(text_of({80.0, INFINITY, {"goto", "save"}}), "about 80 s left; goto, save not counted");
  EXPECT_EQ(text_of({0.0, 900.0, {"goto"}}), "time left unknown, at most 900 s");
}

}  // namespace
}  // namespace cairn

#include "maps/relocalisation/pose_check.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

PoseHypothesis guess(double score, double contradicted_ratio) {
  PoseHypothesis hypothesis;
  hypothesis.score = score;
  hypothesis.contradicted_ratio = contradicted_ratio;
  return hypothesis;
}

// One look a metre, all alike; where the check is decided.
PoseVerdict after(PoseCheck& check, const PoseLook& look, int from_m, int to_m) {
  for (int m = from_m; m <= to_m; ++m) {
    PoseLook here = look;
    here.driven_m = m;
    check.update(here);
  }
  return check.verdict();
}

TEST(PoseCheck, WhatFitsWhereItIsBelievedHasStayedAfterSixMetres) {
  PoseCheck check;
  const PoseLook fits{0.0, guess(0.88, 0.01), std::nullopt};
  EXPECT_EQ(after(check, fits, 1, 5), PoseVerdict::open);
  EXPECT_TRUE(check.is_open());
  EXPECT_EQ(after(check, fits, 6, 6), PoseVerdict::stayed);
  EXPECT_EQ(check.looks().size(), 6U);
}

TEST(PoseCheck, WhereLittleIsKnownItCanBeKeptOpenForLonger) {
  PoseCheck check({.min_score = 0.6});
  const PoseLook unknown{0.0, guess(0.5, 0.02), std::nullopt};
  EXPECT_EQ(after(check, unknown, 1, 10), PoseVerdict::open);
  EXPECT_EQ(after(check, {0.0, guess(0.7, 0.02), std::nullopt}, 11, 11), PoseVerdict::stayed);
  PoseCheck other({.min_score = 0.6});
  EXPECT_EQ(after(other, unknown, 1, 14), PoseVerdict::open);
  EXPECT_EQ(after(other, unknown, 15, 15), PoseVerdict::stayed);
}

TEST(PoseCheck, TwoLooksThatTheMapContradictsSayThatItWasCarried) {
  PoseCheck check;
  const PoseLook against{0.0, guess(0.45, 0.2), std::nullopt};
  EXPECT_EQ(after(check, against, 1, 1), PoseVerdict::doubtful);
  EXPECT_TRUE(check.is_open());
  EXPECT_EQ(after(check, against, 2, 2), PoseVerdict::carried);
  EXPECT_EQ(after(check, {0.0, guess(0.9, 0.0), std::nullopt}, 3, 9), PoseVerdict::carried) << "it is lost already";
  EXPECT_EQ(check.looks().size(), 2U);
}

TEST(PoseCheck, OneLookAloneIsForgotten) {
  PoseCheck check;
  for (int m = 1; m <= 5; ++m) after(check, {0.0, guess(m % 2 == 0 ? 0.9 : 0.5, m % 2 == 0 ? 0.0 : 0.2), {}}, m, m);
  EXPECT_EQ(check.verdict(), PoseVerdict::doubtful);
  EXPECT_EQ(after(check, {0.0, guess(0.9, 0.0), std::nullopt}, 6, 6), PoseVerdict::stayed);
}

TEST(PoseCheck, ABetterPlaceCountsOnlyAgainstAPoseThatIsContradicted) {
  PoseCheck unfinished;  // what is seen right lies where the map is not drawn yet
  EXPECT_EQ(after(unfinished, {0.0, guess(0.4, 0.02), guess(0.8, 0.02)}, 1, 6), PoseVerdict::stayed);
  PoseCheck carried;
  EXPECT_EQ(after(carried, {0.0, guess(0.62, 0.06), guess(0.88, 0.01)}, 1, 2), PoseVerdict::carried);
  PoseCheck as_bad;
  EXPECT_EQ(after(as_bad, {0.0, guess(0.62, 0.06), guess(0.88, 0.05)}, 1, 6), PoseVerdict::stayed);
}

TEST(PoseCheck, ItsOutcomesHaveNames) {
  EXPECT_EQ(name_of(PoseVerdict::open), "open");
  EXPECT_EQ(name_of(PoseVerdict::doubtful), "doubtful");
  EXPECT_EQ(name_of(PoseVerdict::stayed), "stayed");
  EXPECT_EQ(name_of(PoseVerdict::carried), "carried");
}

}  // namespace
}  // namespace cairn

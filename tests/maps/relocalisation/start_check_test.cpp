#include "maps/relocalisation/start_check.hpp"

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
StartTrust after(StartCheck& check, const StartLook& look, int from_m, int to_m) {
  for (int m = from_m; m <= to_m; ++m) {
    StartLook here = look;
    here.driven_m = m;
    check.update(here);
  }
  return check.trust();
}

TEST(StartCheck, WhatFitsWhereItIsBelievedHasStayedAfterSixMetres) {
  StartCheck check;
  const StartLook fits{0.0, guess(0.88, 0.01), std::nullopt};
  EXPECT_EQ(after(check, fits, 1, 5), StartTrust::open);
  EXPECT_TRUE(check.is_open());
  EXPECT_EQ(after(check, fits, 6, 6), StartTrust::stayed);
  EXPECT_EQ(check.looks().size(), 6U);
}

TEST(StartCheck, TwoLooksThatTheMapContradictsSayThatItWasCarried) {
  StartCheck check;
  const StartLook against{0.0, guess(0.45, 0.2), std::nullopt};
  EXPECT_EQ(after(check, against, 1, 1), StartTrust::doubtful);
  EXPECT_TRUE(check.is_open());
  EXPECT_EQ(after(check, against, 2, 2), StartTrust::carried);
  EXPECT_EQ(after(check, {0.0, guess(0.9, 0.0), std::nullopt}, 3, 9), StartTrust::carried) << "it is lost already";
  EXPECT_EQ(check.looks().size(), 2U);
}

TEST(StartCheck, OneLookAloneIsForgotten) {
  StartCheck check;
  for (int m = 1; m <= 5; ++m) after(check, {0.0, guess(m % 2 == 0 ? 0.9 : 0.5, m % 2 == 0 ? 0.0 : 0.2), {}}, m, m);
  EXPECT_EQ(check.trust(), StartTrust::doubtful);
  EXPECT_EQ(after(check, {0.0, guess(0.9, 0.0), std::nullopt}, 6, 6), StartTrust::stayed);
}

TEST(StartCheck, ABetterPlaceCountsOnlyAgainstAPoseThatIsContradicted) {
  StartCheck unfinished;  // what is seen right lies where the map is not drawn yet
  EXPECT_EQ(after(unfinished, {0.0, guess(0.4, 0.02), guess(0.8, 0.02)}, 1, 6), StartTrust::stayed);
  StartCheck carried;
  EXPECT_EQ(after(carried, {0.0, guess(0.62, 0.06), guess(0.88, 0.01)}, 1, 2), StartTrust::carried);
  StartCheck as_bad;
  EXPECT_EQ(after(as_bad, {0.0, guess(0.62, 0.06), guess(0.88, 0.05)}, 1, 6), StartTrust::stayed);
}

TEST(StartCheck, ItsOutcomesHaveNames) {
  EXPECT_EQ(name_of(StartTrust::open), "open");
  EXPECT_EQ(name_of(StartTrust::doubtful), "doubtful");
  EXPECT_EQ(name_of(StartTrust::stayed), "stayed");
  EXPECT_EQ(name_of(StartTrust::carried), "carried");
}

}  // namespace
}  // namespace cairn

// The suites can fail: each faulty module of this folder fails the test that is for its fault.
#include <gmock/gmock.h>

#include <array>
#include <cstdio>
#include <string>

namespace {

std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> part;
  while (pipe != nullptr && std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
  if (pipe != nullptr) pclose(pipe);
  return text;
}

// The faulty modules of one kind, run through their suite.
class FaultySuite {
 public:
  explicit FaultySuite(const std::string& suite)
      : suite_(suite),
        output_(output_of(std::string("'") + CAIRN_BINARY_DIR + "/tests/conformance_faulty_modules' --gtest_color=no " +
                          "--gtest_filter='Faulty/" + suite + ".*'")) {}

  void expect_failure(const std::string& test, const std::string& module) const {
    const std::string begin = "[  FAILED  ] Faulty/" + suite_ + "." + test + "/";
    const std::string end = ", where GetParam() = " + module + "\n";
    for (std::size_t at = output_.find(begin); at != std::string::npos; at = output_.find(begin, at + 1)) {
      const std::size_t line = output_.find('\n', at) + 1;
      if (output_.substr(at, line - at).ends_with(end)) return;
    }
    const std::size_t summary = output_.rfind("[==========]");
    ADD_FAILURE() << "the module \"" << module << "\" passed " << test << "\n"
                  << (summary == std::string::npos ? output_ : output_.substr(summary));
  }

 private:
  std::string suite_;
  std::string output_;
};

TEST(FaultyModules, MapsFail) {
  const FaultySuite faulty("MapperConformance");
  faulty.expect_failure("EveryCellThatChangesIsReported", "forgets a span");
  faulty.expect_failure("SpansAreSortedAndDoNotOverlap", "unsorted spans");
  faulty.expect_failure("AllocatesNothingOnGroundThatItCovers", "copies its input");
  faulty.expect_failure("OddReadingsDoNotThrowAndAreReported", "trusts every range");
  faulty.expect_failure("NoEchoMeansFreeGroundAndNothingOccupied", "trusts every range");
}

TEST(FaultyModules, LocalizersFail) {
  const FaultySuite faulty("LocalizerConformance");
  faulty.expect_failure("UncertaintyGrowsWithDriving", "never in doubt");
  faulty.expect_failure("OddObservationsLeaveAFiniteEstimate", "never in doubt");
  faulty.expect_failure("CovarianceIsSymmetricPositiveAndFinite", "lopsided covariance");
  faulty.expect_failure("TwoObjectsShareNothing", "keeps its state in a static");
  faulty.expect_failure("FollowsAnErrorlessDrive", "keeps its state in a static");
}

TEST(FaultyModules, LoopClosersFail) {
  const FaultySuite faulty("LoopCloserConformance");
  faulty.expect_failure("FindsAScanWhereItIsWhereverItIsBelievedToBe", "believes the guess");
  faulty.expect_failure("AUsedUpBudgetBeginsNoSubmap", "ignores its budget");
  faulty.expect_failure("FindsAScanWhereItIsWhereverItIsBelievedToBe", "information without a heading");
  faulty.expect_failure("ProposesSubmapsThatItWasGivenEachOnce", "proposes one twice");
  faulty.expect_failure("TheSameCallsGiveTheSameProposals", "keeps its state in a static");
}

TEST(FaultyModules, SensorsFail) {
  const FaultySuite faulty("SensorConformance");
  faulty.expect_failure("StampsNeverGoBack", "time goes back");
  faulty.expect_failure("AnEndIsFinalAndSaysWhy", "ends and goes on");
  faulty.expect_failure("ObservationsKeepTheirContract", "no echo as 10 km");
  faulty.expect_failure("ADriveStopsWhenAsked", "does not stop");
}

TEST(FaultyModules, DetectorsFail) {
  const FaultySuite faulty("DetectorConformance");
  faulty.expect_failure("ReportsKeepTheirContract", "degrees in percent");
  faulty.expect_failure("UnchangedGroundIsNotReportedAgain", "repeats itself");
  faulty.expect_failure("AllocatesNothingWithoutAMatching", "repeats itself");
  faulty.expect_failure("AUsedUpBudgetEndsACallPromptlyWithoutAMatching", "ignores its budget");
}

TEST(FaultyModules, PlannersFail) {
  const FaultySuite faulty("PlannerConformance");
  faulty.expect_failure("AUsedUpBudgetEndsACallPromptlyWithItsOutcome", "ignores cancel");
  faulty.expect_failure("TheDiscTouchesNothingOnASolvedPath", "forgets the radius");
  faulty.expect_failure("ADoorTooNarrowForTheRobotIsNotSolved", "forgets the radius");
  faulty.expect_failure("AGoalInsideAWallIsNeverSolved", "sees no walls");
  faulty.expect_failure("AGoalThatNothingLeadsToIsNeverSolved", "sees no walls");
  faulty.expect_failure("AChangedMapIsPlannedAfresh", "keeps old answers");
}

TEST(FaultyModules, PathPlannersFail) {
  const FaultySuite faulty("PathPlannerConformance");
  faulty.expect_failure("ADiscKeepsTheMarginOfItsTraits", "promises what it does not keep");
  faulty.expect_failure("UnknownCellsAreCrossedOnlyWhereItsTraitsAllowIt", "promises what it does not keep");
  faulty.expect_failure("ItsTraitsStayWhatTheyAre", "changes its traits");
}

TEST(FaultyModules, RoutePlannersFail) {
  const FaultySuite faulty("RoutePlannerConformance");
  faulty.expect_failure("AClosedRouteIsNotTaken", "forgets what is closed");
  faulty.expect_failure("AnAvoidedLandmarkIsNotPassedButMayBeAnEnd", "forgets what is closed");
  faulty.expect_failure("WhatItsEndsCostIsCounted", "forgets what is closed");
  faulty.expect_failure("ASolvedRouteLeadsFromLandmarkToLandmark", "leaves a route out");
}

TEST(FaultyModules, ControllersFail) {
  const FaultySuite faulty("ControllerConformance");
  faulty.expect_failure("NeverDrivesIntoWhatIsRightAhead", "sees no obstacles");
  faulty.expect_failure("ForgetsTheOldPathWhenANewOneBegins", "keeps the first path");
  faulty.expect_failure("VelocitiesAreFiniteAndWithinTheLimits", "too fast");
}

TEST(FaultyModules, BehavioursFail) {
  const FaultySuite faulty("BehaviourConformance");
  faulty.expect_failure("AHaltAsksForNothing", "drives in halt");
  faulty.expect_failure("BeginsAfreshAfterAHalt", "halts not");
  faulty.expect_failure("RunsOrEndsWithASentenceAndFiniteOrders", "orders NaN");
}

}  // namespace

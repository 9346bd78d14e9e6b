#include "maps/relocalisation/pose_belief.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr Pose2 kT_map_local{4.0, 2.0, 0.5};

// Drives straight on; after each metre the guesses are those of the function, made with where the robot really is.
template <class Guesses>
std::optional<double> believed_after_m(Guesses guesses_at, double at_most_m = 12.0) {
  PoseBelief belief;
  for (double x_m = 0.0; x_m <= at_most_m; x_m += 0.05) {
    const Pose2 T_local_robot{x_m, 0.0, 0.0};
    if (!belief.drive(T_local_robot)) continue;
    belief.update(guesses_at(kT_map_local * T_local_robot, x_m), T_local_robot);
    if (!belief.T_map_local()) continue;
    EXPECT_LT((belief.T_map_local()->position() - kT_map_local.position()).norm(), 1e-9);
    return belief.driven_m();
  }
  return std::nullopt;
}

TEST(PoseBelief, BelievesAGuessThatStaysClearlyAheadForThreeMetres) {
  const auto after_m = believed_after_m([](const Pose2& truth, double) {
    return std::vector<PoseHypothesis>{{truth, 0.9, true}, {{9.0, 9.0, 0.0}, 0.8, true}};
  });
  ASSERT_TRUE(after_m);
  EXPECT_NEAR(*after_m, 4.0, 0.2);
}

TEST(PoseBelief, DoesNotBelieveWhileAnotherGuessIsAsGood) {
  EXPECT_FALSE(believed_after_m([](const Pose2& truth, double) {
    return std::vector<PoseHypothesis>{{truth, 0.9, true}, {{9.0, 9.0, 0.0}, 0.88, true}};
  }));
}

TEST(PoseBelief, BelievesWhenTheOtherGuessHasDroppedOut) {
  const auto after_m = believed_after_m([](const Pose2& truth, double x_m) {
    return std::vector<PoseHypothesis>{{truth, 0.9, true}, {{9.0, 9.0, 0.0}, x_m < 5.5 ? 0.88 : 0.7, true}};
  });
  ASSERT_TRUE(after_m);
  EXPECT_NEAR(*after_m, 9.0, 0.4);
}

TEST(PoseBelief, DoesNotBelieveAGuessThatNoCornerHolds) {
  EXPECT_FALSE(believed_after_m([](const Pose2& truth, double) {
    return std::vector<PoseHypothesis>{{truth, 0.95, false}};
  }));
}

TEST(PoseBelief, DoesNotBelieveWhatFitsBadly) {
  EXPECT_FALSE(believed_after_m([](const Pose2& truth, double) {
    return std::vector<PoseHypothesis>{{truth, 0.55, true}};
  }));
}

TEST(PoseBelief, DoesNotBelieveWhatTheMapContradicts) {
  EXPECT_FALSE(believed_after_m([](const Pose2& truth, double) {
    return std::vector<PoseHypothesis>{{truth, 0.9, true, 0.06}};
  }));
}

TEST(PoseBelief, DoesNotBelieveAGuessThatDoesNotMoveWithTheRobot) {
  EXPECT_FALSE(believed_after_m([](const Pose2&, double) {
    return std::vector<PoseHypothesis>{{{3.0, 3.0, 0.0}, 0.95, true}};
  }));
}

TEST(PoseBelief, NothingFoundIsNothingBelieved) {
  EXPECT_FALSE(believed_after_m([](const Pose2&, double) { return std::vector<PoseHypothesis>{}; }));
}

}  // namespace
}  // namespace cairn

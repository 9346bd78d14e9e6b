// Conformance of modules of kind `loop_closer`. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(MyCloser, LoopCloserConformance,
//                            testing::Values(module<cairn::LoopCloser>(FOLDER, "my_closer", "{min_score: 0.6}")));
//   }
//
// A robot with a laser has driven through the room of fixtures.hpp and comes by again, believed to be up to 0.6 m and 6
// degrees away from where it is; settings must be such that it is looked for there.
#pragma once

#include <Eigen/Cholesky>

#include "framework/contracts/loop_closer.hpp"
#include "tests/conformance/fixtures.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/conformance/texts.hpp"

namespace cairn::conformance {

class LoopCloserConformance : public Conformance<LoopCloser> {
 protected:
  // A node of the second pass.
  struct Node {
    Pose2 T_map_node;  // where it is
    std::vector<Point> points_m;
  };

  LoopCloserConformance() {
    for (std::size_t i = 0; i < 5; ++i)
      submap_->add(i, inverse(kAnchor) * place_of(i), scan_from(place_of(i), laser_robot()));
  }

  [[nodiscard]] static RobotModel laser_robot() {
    RobotModel robot;
    constexpr int kRays = 180;
    for (int i = 0; i < kRays; ++i) {
      SonarModel ray;
      ray.T_robot_sonar.theta_rad = wrap_angle(radians(360.0 * i / kRays));
      ray.half_beam_rad = 0.0;
      ray.min_m = 0.05;
      ray.max_m = 10.0;
      robot.sonars.push_back(ray);
    }
    return robot;
  }
  [[nodiscard]] static std::vector<Point> scan_from(const Pose2& T_map_robot, const RobotModel& robot) {
    std::vector<Point> points_m;
    for (const RangeReading& reading : seen_in_room(T_map_robot, 0.0, robot).ranges)
      if (std::isfinite(reading.range_m)) points_m.push_back(reading.T_robot_sensor * Point(reading.range_m, 0.0));
    return points_m;
  }
  [[nodiscard]] static Node laser_node() { return {kNode, scan_from(kNode, laser_robot())}; }
  // What eight sonars have heard on the last two metres of the way to the node.
  [[nodiscard]] static Node sonar_node() {
    Node node{kNode, {}};
    for (int i = 0; i < 40; ++i) {
      const Pose2 T_node_robot{-0.05 * i, 0.0, 0.0};
      for (const Point& point_m : scan_from(kNode * T_node_robot, eight_sonar_robot()))
        node.points_m.push_back(T_node_robot * point_m);
    }
    return node;
  }
  // off: where the node is believed to be, as seen from where it is. The node's points must outlive the query.
  [[nodiscard]] LoopQuery query_of(const Node& node, const Pose2& off) const {
    LoopQuery query;
    query.node = 100;
    query.points_m = node.points_m;
    query.T_map_node = node.T_map_node * off;
    query.submaps = submaps_;
    return query;
  }
  [[nodiscard]] static std::vector<LoopProposal> ask(LoopCloser& closer, const LoopQuery& query) {
    return closer.propose(query, Budget{});
  }
  // What is wrong with the proposals, or empty.
  [[nodiscard]] static std::string fault_of(const std::vector<LoopProposal>& proposals, const LoopQuery& query) {
    std::vector<bool> seen(query.submaps.size(), false);
    for (const LoopProposal& proposal : proposals) {
      if (proposal.submap >= seen.size()) return "proposed a submap that it was not given";
      if (seen[proposal.submap]) return "proposed a submap twice";
      seen[proposal.submap] = true;
      if (!is_finite(proposal.T_submap_node)) return "the pose is not finite: " + text_of(proposal.T_submap_node);
      const Eigen::Matrix3d& information = proposal.information;
      if (!information.allFinite() || !information.isApprox(information.transpose(), 1e-6) ||
          information.llt().info() != Eigen::Success)
        return "the information is not symmetric and positive definite";
      if (!(proposal.score >= 0.0 && proposal.score <= 1.0)) return "the score is not from 0 to 1";
    }
    return {};
  }
  [[nodiscard]] static std::string text_of_all(const std::vector<LoopProposal>& proposals) {
    std::string text;
    for (const LoopProposal& proposal : proposals)
      text += text_of(proposal.T_submap_node) + " " + text_of(proposal.information.sum()) + " " +
              text_of(proposal.score) + "\n";
    return text;
  }
  static void expect_found(LoopCloser& closer, const LoopQuery& query) {
    const std::vector<LoopProposal> found = ask(closer, query);
    ASSERT_EQ(found.size(), 1U) << "the submap holds the walls around the node";
    EXPECT_EQ(fault_of(found, query), "");
    const Pose2 off = inverse(inverse(kAnchor) * kNode) * found[0].T_submap_node;
    EXPECT_LT(off.position().norm(), 0.1) << "found at " << text_of(found[0].T_submap_node);
    EXPECT_LT(std::abs(off.theta_rad), radians(3.0)) << "found at " << text_of(found[0].T_submap_node);
  }

  static constexpr Pose2 kAnchor{1.0, 1.0, 0.0};
  static constexpr Pose2 kNode{2.8, 1.2, 0.1};
  [[nodiscard]] static Pose2 place_of(std::size_t node) { return {1.0 + 0.5 * static_cast<double>(node), 1.0, 0.0}; }

  const std::shared_ptr<Submap> submap_ = std::make_shared<Submap>(0, 0.1);
  std::vector<PassedSubmap> submaps_ = {{submap_, kAnchor, 0.3}};
};

inline constexpr Pose2 kBelievedPlaces[] = {{0.0, 0.0, 0.0}, {0.4, -0.3, radians(5.0)}, {-0.5, 0.2, radians(-6.0)}};

TEST_P(LoopCloserConformance, IsMadeTwiceAndDestroyedUnused) {
  EXPECT_NE(make(), make()) << "a factory makes a new object each time";
}

TEST_P(LoopCloserConformance, OutlivesTheLibraryThatMadeIt) {
  const auto closer = GetParam().make_outliving_library();
  const Node node = laser_node();
  expect_found(*closer, query_of(node, {}));
}

TEST_P(LoopCloserConformance, FindsAScanWhereItIsWhereverItIsBelievedToBe) {
  const auto closer = make();
  const Node node = laser_node();
  for (const Pose2& off : kBelievedPlaces) expect_found(*closer, query_of(node, off));
}

TEST_P(LoopCloserConformance, FindsGatheredEchoesOfSonarsToo) {
  const auto closer = make();
  const Node node = sonar_node();
  for (const Pose2& off : kBelievedPlaces) {
    LoopQuery query = query_of(node, off);
    query.gathered_m = 2.0;
    query.echo_sigma_m = 0.1;
    expect_found(*closer, query);
  }
}

TEST_P(LoopCloserConformance, FindsItAfterwardsToo) {
  const auto closer = make();
  const Node node = laser_node();
  LoopQuery query = query_of(node, {0.2, 0.1, radians(2.0)});
  query.max_turn_rad = radians(5.0);
  query.is_afterwards = true;
  expect_found(*closer, query);
}

TEST_P(LoopCloserConformance, ProposesNothingWithoutSubmapsOrEchoes) {
  const auto closer = make();
  const Node node = laser_node();
  LoopQuery query = query_of(node, {});
  query.submaps = {};
  EXPECT_TRUE(ask(*closer, query).empty()) << "without submaps";
  query = query_of(node, {});
  query.points_m = {};
  EXPECT_TRUE(ask(*closer, query).empty()) << "without echoes";
  expect_found(*closer, query_of(node, {}));
}

TEST_P(LoopCloserConformance, ProposesSubmapsThatItWasGivenEachOnce) {
  submaps_.push_back({std::make_shared<Submap>(200, 0.1), {40.0, 40.0, 0.0}, 50.0});
  for (int i = 0; i < 6; ++i) submaps_.push_back({submap_, kAnchor, 0.3 + 0.1 * i});
  const auto closer = make();
  const Node node = laser_node();
  const LoopQuery query = query_of(node, {0.2, 0.1, 0.0});
  const std::vector<LoopProposal> found = ask(*closer, query);
  EXPECT_FALSE(found.empty());
  EXPECT_EQ(fault_of(found, query), "");
  for (const LoopProposal& proposal : found) EXPECT_NE(proposal.submap, 1U) << "an empty one, 50 m away";
}

TEST_P(LoopCloserConformance, AUsedUpBudgetBeginsNoSubmap) {
  const auto closer = make();
  const Node node = laser_node();
  const UsedUpBudget used_up;
  EXPECT_TRUE(closer->propose(query_of(node, {}), used_up.cancelled()).empty());
  EXPECT_TRUE(closer->propose(query_of(node, {}), UsedUpBudget::past_deadline()).empty());
  expect_found(*closer, query_of(node, {}));
}

TEST_P(LoopCloserConformance, TheSameCallsGiveTheSameProposals) {
  const auto first = make(7);
  const auto second = make(7);
  for (const Node& node : {laser_node(), sonar_node()})
    for (const Pose2& off : kBelievedPlaces)
      EXPECT_EQ(text_of_all(ask(*first, query_of(node, off))), text_of_all(ask(*second, query_of(node, off))))
          << "the answer must depend on config, seed and input only";
}

TEST_P(LoopCloserConformance, TwoObjectsShareNothing) {
  const auto alone = make(7);
  const Node node = laser_node();
  const std::string expected = text_of_all(ask(*alone, query_of(node, kBelievedPlaces[1])));
  const auto closer = make(7);
  const auto other = make(7);
  const Node sonar = sonar_node();
  (void)ask(*other, query_of(sonar, {}));
  EXPECT_EQ(text_of_all(ask(*closer, query_of(node, kBelievedPlaces[1]))), expected);
}

}  // namespace cairn::conformance

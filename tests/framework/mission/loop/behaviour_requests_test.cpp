#include "framework/mission/loop/behaviour_requests.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <limits>

#include "tests/framework/mission/loop/host_fixture.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class BehaviourRequestsTest : public HostFixture {
 protected:
  BehaviourRequests& requests() {
    if (!requests_) requests_ = std::make_unique<BehaviourRequests>(host(), TextFiles(folder_, false));
    return *requests_;
  }
  std::unique_ptr<BehaviourRequests> requests_;
};

TEST_F(BehaviourRequestsTest, AVelocityIsTakenOnce) {
  attach_drive();
  requests().drive({0.1, 0.2});
  EXPECT_EQ(requests().take().wanted, (Twist{0.1, 0.2}));
  EXPECT_FALSE(requests().take().wanted.has_value());
  EXPECT_TRUE(drive_->commands.empty()) << "the collision monitor orders, at the end of the tick";
}

TEST_F(BehaviourRequestsTest, AVelocityThatIsNotFiniteOrThatNothingDrivesIsRefused) {
  EXPECT_THROW(requests().drive({0.1, 0.0}), std::runtime_error);
  attach_drive();
  EXPECT_THROW(requests().drive({std::numeric_limits<double>::quiet_NaN(), 0.0}), std::runtime_error);
  EXPECT_FALSE(requests().take().wanted.has_value());
}

TEST_F(BehaviourRequestsTest, APathThatIsFollowedIsPublishedOnce) {
  built_.controller = std::make_shared<StillController>();
  const std::vector<Point> path{{0.5, 0.5}, {2.0, 0.5}};
  ControlRequest request;
  request.path = path;
  for (int i = 0; i < 3; ++i) {
    (void)requests().control(request);
    request.is_new_path = false;
  }
  EXPECT_THAT(events_.names, ElementsAre("path of 2"));
  request.path = {};
  request.is_new_path = true;
  (void)requests().control(request);
  EXPECT_THAT(events_.names, ElementsAre("path of 2")) << "it has arrived";
}

TEST_F(BehaviourRequestsTest, TheRobotStandsWhileThePlannerWorks) {
  attach_drive();
  EXPECT_EQ(requests().plan({}).outcome, PlanOutcome::solved);
  EXPECT_THAT(drive_->commands, ElementsAre(Twist{}));
  EXPECT_EQ(planner_->asked, 1);
  EXPECT_TRUE(planner_->knew_hierarchies);
  EXPECT_THAT(events_.names, ElementsAre("plan"));
}

TEST_F(BehaviourRequestsTest, WithoutAPlannerThereIsNoRoute) {
  built_.planner = nullptr;
  const PlanResult none = requests().plan({});
  EXPECT_EQ(none.outcome, PlanOutcome::no_route);
  EXPECT_EQ(none.reason, "the mission names no planner");
}

TEST_F(BehaviourRequestsTest, ALandmarkGetsANameUnlessItWouldFindSomethingElse) {
  LandmarkGraph graph;
  graph.add({});
  graph.add({});
  tracker_.restore(graph, {}, {});
  EXPECT_EQ(requests().name_landmark(2, "sofa"), (Status{StepState::success, "L2 is now sofa"}));
  EXPECT_EQ(tracker_.graph().find_by_name("sofa")->id, 2);
  EXPECT_EQ(requests().name_landmark(2, "sofa").state, StepState::success) << "its own";
  EXPECT_EQ(requests().name_landmark(1, "sofa"),
            (Status{StepState::failure, "the name \"sofa\" cannot be given: landmark L2 has it"}));
  EXPECT_EQ(requests().name_landmark(2, "couch"), (Status{StepState::success, "sofa is now couch"}));
  EXPECT_EQ(requests().name_landmark(7, "desk"), (Status{StepState::failure, "there is no landmark L7"}));
}

TEST_F(BehaviourRequestsTest, AClusterGetsANameThatStaysWithIt) {
  LandmarkGraph graph;
  for (int i = 0; i < 3; ++i) graph.add({});
  graph.find(3)->name = "desk";
  tracker_.restore(graph, {}, {});
  const ClusterTree clusters{{{1, {1, 1, 0, 1, ""}}, {2, {2, 1, 0, 3, ""}}}, {{1, 1}, {2, 1}, {3, 2}}, 3};
  planning_ = std::make_unique<Planning>(mission_, modules(), tracker_.graph(), clusters, monitor_, Budget{});
  EXPECT_EQ(requests().name_cluster("C1:L1", "lounge"), (Status{StepState::success, "C1:L1 is now lounge"}));
  EXPECT_EQ(planning().last_clusters().clusters.at(1).name, "lounge");
  EXPECT_EQ(requests().name_cluster("lounge", "lounge").state, StepState::success) << "its own";
  EXPECT_EQ(requests().name_cluster("lounge", "parlour"), (Status{StepState::success, "lounge is now parlour"}));
  EXPECT_EQ(requests().name_cluster("C1:L3", "desk"),
            (Status{StepState::failure, "the name \"desk\" cannot be given: landmark L3 has it"}));
  EXPECT_EQ(requests().name_cluster("C1:L9", "den"), (Status{StepState::failure, "there is no cluster \"C1:L9\""}));
}

TEST_F(BehaviourRequestsTest, ASaveThatFailsIsRememberedForItsLeaf) {
  EXPECT_EQ(requests().save("a.cairn").state, StepState::success);
  EXPECT_FALSE(requests().take().has_failed_to_save);
  EXPECT_EQ(requests().save("no_such_folder/a.cairn").state, StepState::failure);
  EXPECT_TRUE(requests().take().has_failed_to_save);
  EXPECT_FALSE(requests().take().has_failed_to_save);
}

TEST_F(BehaviourRequestsTest, TheNameOfTheAutosavesIsRefused) {
  EXPECT_EQ(requests().save("still.autosave.cairn").reason,
            "still.autosave.cairn is the name of the mission's autosaves");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "still.autosave.cairn"));
}

TEST_F(BehaviourRequestsTest, AnAnswerIsALineWithoutTheTimesThatItTook) {
  PlanQuestion question;
  question.from = "0.5,0.5";
  question.to = "2.5,0.5";
  const Status status = requests().answer(question, "answers.json");
  EXPECT_EQ(status.state, StepState::success) << status.reason;
  EXPECT_EQ(status.reason, "2.00 m");
  std::ifstream in(folder_ / "answers.json");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(text, HasSubstr("\"outcome\":\"solved\""));
  EXPECT_THAT(text, testing::Not(HasSubstr("time_ms")));
  EXPECT_EQ(text.back(), '\n');
}

TEST_F(BehaviourRequestsTest, AQuestionThatMakesNoSenseIsAFailureAndWritesNothing) {
  PlanQuestion question;
  question.from = "0.5,0.5";
  question.to = "L99";
  EXPECT_EQ(requests().answer(question, "answers.json").state, StepState::failure);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "answers.json"));
}

TEST_F(BehaviourRequestsTest, WhatItSaysIsPublished) {
  requests().report("looks for a door");
  EXPECT_THAT(events_.names, ElementsAre("looks for a door"));
}

}  // namespace
}  // namespace cairn

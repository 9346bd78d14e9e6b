#include "framework/mission/loop/publisher.hpp"

#include <gmock/gmock.h>

namespace cairn {
namespace {

using testing::ElementsAre;

class Collecting : public Listener {
 public:
  void on(const Event& event, const MissionView& view) override {
    texts.push_back(std::get<Message>(event).sentence);
    time_s = view.world.time_s;
    truth = view.truth;
    if (texts.back() == throws_at) throw std::runtime_error("no paper");
  }
  std::vector<std::string> texts;
  std::string throws_at;
  double time_s = 0.0;
  std::optional<GroundTruth> truth;
};

class PublisherTest : public testing::Test {
 protected:
  const OccupancyGrid grid_{0.1};
  const LandmarkGraph graph_{};
  const RobotModel robot_{};
  WorldState world_{robot_, graph_, Pose2{}, &grid_};
  Publisher publisher_{world_};
  Collecting first_, second_;
};

TEST_F(PublisherTest, EveryListenerGetsEveryEventWithTheWorldAsItIs) {
  publisher_.subscribe(first_);
  publisher_.subscribe(second_);
  world_.time_s = 7.0;
  world_.observe({}, GroundTruth{{1.0, 2.0, 0.0}});
  publisher_.publish(Message{"a"});
  publisher_.publish(Message{"b"});
  EXPECT_THAT(first_.texts, ElementsAre("a", "b"));
  EXPECT_EQ(second_.texts, first_.texts);
  EXPECT_EQ(second_.time_s, 7.0);
  EXPECT_EQ(second_.truth->T_map_robot, (Pose2{1.0, 2.0, 0.0}));
}

TEST_F(PublisherTest, AListenerThatThrowsGetsNothingMoreAndTheOthersDo) {
  first_.throws_at = "a";
  publisher_.subscribe(first_);
  publisher_.subscribe(second_);
  publisher_.publish(Message{"a"});
  publisher_.publish(Message{"b"});
  EXPECT_THAT(first_.texts, ElementsAre("a"));
  EXPECT_THAT(second_.texts, ElementsAre("a", "b"));
  EXPECT_THAT(publisher_.listener_faults(), ElementsAre("no paper"));
}

TEST_F(PublisherTest, NothingIsPublishedBeforeThereIsAGridToShow) {
  world_.grid = nullptr;
  publisher_.subscribe(first_);
  publisher_.publish(Message{"too early"});
  EXPECT_TRUE(first_.texts.empty());
}

}  // namespace
}  // namespace cairn

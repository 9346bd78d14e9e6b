#include "framework/mission/loop/display_feed.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include "framework/mission/loop/world_state.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class RecordingDisplay : public MissionDisplay {
 public:
  void show(const MissionSnapshot& snapshot) override {
    if (is_broken) throw std::runtime_error("the network is gone");
    paths.push_back(snapshot.path.size());
    doing = snapshot.doing;
  }
  std::optional<DisplayOrder> next_order() override {
    if (given.empty()) return std::nullopt;
    const DisplayOrder next = given.front();
    given.erase(given.begin());
    return next;
  }
  bool is_broken = false;
  std::vector<std::size_t> paths;
  std::string doing;
  std::vector<DisplayOrder> given;
};

class DisplayFeedTest : public testing::Test {
 protected:
  DisplayFeedTest() { world_.grid = &grid_; }
  ~DisplayFeedTest() override { std::filesystem::remove_all(folder_); }
  std::vector<std::string> show_at(double time_s, const std::string& doing) {
    world_.time_s = time_s;
    return feed_.show(world_.view(), {}, [&] { return doing; });
  }
  void publish(const Event& event) {
    const WorldView view = world_.view();
    feed_.on(event, MissionView{view});
  }

  RobotModel robot_;
  LandmarkGraph graph_;
  OccupancyGrid grid_{0.1};
  WorldState world_{robot_, graph_, Pose2{}};
  StageClock clock_{std::make_shared<SteadyClock>()};
  std::shared_ptr<RecordingDisplay> display_ = std::make_shared<RecordingDisplay>();
  DisplayFeed feed_{Staged<MissionDisplay>(display_, clock_, clock_.add("display", "robot"))};
  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("display_feed_" + std::to_string(::getpid()));
};

TEST_F(DisplayFeedTest, ShowsThePathUntilItsStepEnds) {
  PlanResult planned;
  planned.path = {Pose2{}, Pose2{1.0, 0.0, 0.0}};
  EXPECT_THAT(show_at(0.0, "a"), IsEmpty());
  publish(PlanDone{planned});
  EXPECT_THAT(show_at(0.1, "a"), IsEmpty());
  publish(PlanDone{});  // none was found: what is driven stays
  EXPECT_THAT(show_at(0.2, "a"), IsEmpty());
  publish(StepEnded{});
  EXPECT_THAT(show_at(0.3, "a"), IsEmpty());
  EXPECT_THAT(display_->paths, ElementsAre(0U, 2U, 2U, 0U));
}

TEST_F(DisplayFeedTest, AsksNowAndThenWhatIsDone) {
  (void)show_at(0.0, "begins");
  (void)show_at(0.1, "drives");
  EXPECT_EQ(display_->doing, "begins");
  (void)show_at(0.6, "drives");
  EXPECT_EQ(display_->doing, "drives");
}

TEST_F(DisplayFeedTest, ADisplayThatThrowsGetsNoMoreAndTheMissionGoesOn) {
  display_->is_broken = true;
  EXPECT_THAT(show_at(0.0, "a"), ElementsAre("module robot failed in stage display: the network is gone; nothing is "
                                             "shown there any more"));
  display_->is_broken = false;
  EXPECT_THAT(show_at(1.0, "a"), IsEmpty());
  EXPECT_THAT(display_->paths, IsEmpty());
}

TEST_F(DisplayFeedTest, HandsOrdersOnAndSaysWhatWasNone) {
  std::filesystem::create_directories(folder_);
  Orders orders(nullptr, {}, folder_);
  display_->given = {{R"({"goto":{"at_m":[1,2]}})", ""}, {R"({"gotto":"L1"})", ""}, {"", "the goal is no pose"}};
  EXPECT_THAT(feed_.hand_orders_to(orders), ElementsAre(HasSubstr("did you mean \"goto\""), "the goal is no pose"));
  orders.begin_tick(0.1);
  const std::optional<Order> taken = orders.next();
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->kind, "goto");
  EXPECT_FALSE(orders.next());
}

TEST_F(DisplayFeedTest, WithoutADisplayItDoesNothing) {
  DisplayFeed none{Staged<MissionDisplay>()};
  Orders orders(nullptr, {}, folder_);
  EXPECT_FALSE(none);
  EXPECT_THAT(none.show(world_.view(), {}, []() -> std::string { throw std::logic_error("nobody looks"); }), IsEmpty());
  EXPECT_THAT(none.hand_orders_to(orders), IsEmpty());
}

}  // namespace
}  // namespace cairn

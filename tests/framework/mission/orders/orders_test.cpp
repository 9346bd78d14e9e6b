#include "framework/mission/orders/orders.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <future>
#include <iterator>
#include <thread>

namespace cairn {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class OrdersTest : public testing::Test {
 protected:
  OrdersTest() { std::filesystem::create_directories(folder_); }
  ~OrdersTest() override {
    inbox_.close();
    std::filesystem::remove_all(folder_);
  }
  // From another thread, and there once this returns.
  std::future<OrderAnswer> give(const std::string& text) {
    auto answer = std::async(std::launch::async, [this, text] { return inbox_.give(parse_order(text), seconds(60)); });
    return answer;
  }
  // Ticks until an order has come.
  Order wait_for_order(Orders& orders) {
    while (true) {
      orders.begin_tick(time_s_ += 0.1);
      if (const auto order = orders.next()) return *order;
      EXPECT_THAT(orders.end_tick(), IsEmpty());
    }
  }
  [[nodiscard]] std::string record() const {
    std::ifstream in(folder_ / kOrdersFile);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("orders_" + std::to_string(::getpid()));
  OrderInbox inbox_;
  double time_s_ = 0.0;
};

TEST_F(OrdersTest, WhatIsTakenIsRecordedAndAnswered) {
  Orders orders(&inbox_, {}, folder_);
  auto answer = give(R"({"goto":"L1"})");
  EXPECT_EQ(wait_for_order(orders).kind, "goto");
  orders.answer({StepState::success, "under way"});
  EXPECT_THAT(orders.end_tick(), IsEmpty());
  const OrderAnswer got = answer.get();
  EXPECT_TRUE(got.is_taken);
  EXPECT_EQ(got.reason, "under way");
  EXPECT_GT(got.tick, 0);
  EXPECT_EQ(record(), recorded_line(parse_order(R"({"goto":"L1"})"), got.tick, got.time_s));
}

TEST_F(OrdersTest, WhatIsRefusedIsReportedAndNotRecorded) {
  Orders orders(&inbox_, {}, folder_);
  auto answer = give(R"({"goto":"L9"})");
  (void)wait_for_order(orders);
  orders.answer({StepState::failure, "no landmark \"L9\""});
  EXPECT_THAT(orders.end_tick(), ElementsAre("order {\"goto\":\"L9\"} refused: no landmark \"L9\""));
  EXPECT_FALSE(answer.get().is_taken);
  EXPECT_EQ(record(), "");
}

TEST_F(OrdersTest, WhatNoStepAsksForIsRefusedWithTheTick) {
  Orders orders(&inbox_, {}, folder_);
  auto answer = give(R"({"stop":null})");
  while (answer.wait_for(milliseconds(0)) != std::future_status::ready) {
    orders.begin_tick(time_s_ += 0.1);
    (void)orders.end_tick();
  }
  EXPECT_EQ(answer.get().reason, "no step await_orders is under way");
}

TEST_F(OrdersTest, AStepThatDoesNotAnswerRefuses) {
  Orders orders(nullptr, {{1, parse_order(R"({"stop":null})")}, {1, parse_order(R"({"stop":null})")}}, folder_);
  orders.begin_tick(0.1);
  (void)orders.next();
  (void)orders.next();
  EXPECT_THAT(orders.end_tick(), ElementsAre(HasSubstr("has not answered"), HasSubstr("has not answered")));
}

TEST_F(OrdersTest, RecordedOrdersComeWithTheirTicksAndAreRecordedAgain) {
  const std::vector<RecordedOrder> played{{2, parse_order(R"({"goto":"L1"})")}, {2, parse_order(R"({"stop":null})")}};
  Orders orders(nullptr, played, folder_);
  orders.begin_tick(0.1);
  EXPECT_FALSE(orders.next().has_value());
  EXPECT_THAT(orders.end_tick(), IsEmpty());
  orders.begin_tick(0.2);
  EXPECT_EQ(orders.next()->kind, "goto");
  orders.answer({StepState::success, ""});
  EXPECT_EQ(orders.next()->kind, "stop");
  orders.answer({StepState::success, ""});
  EXPECT_FALSE(orders.next().has_value());
  EXPECT_EQ(record(), recorded_line(played[0].order, 2, 0.2) + recorded_line(played[1].order, 2, 0.2));
}

TEST_F(OrdersTest, TheFirstTickRemovesTheRecordOfAnEarlierRun) {
  std::ofstream(folder_ / kOrdersFile) << "old\n";
  Orders orders(nullptr, {}, folder_);
  EXPECT_EQ(record(), "old\n");
  orders.begin_tick(0.1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / kOrdersFile));
}

TEST_F(OrdersTest, AnOrderThatTheMissionDoesNotLookAtIsWithdrawn) {
  const OrderAnswer answer = inbox_.give(parse_order(R"({"stop":null})"), milliseconds(0));
  EXPECT_FALSE(answer.is_taken);
  EXPECT_THAT(answer.reason, HasSubstr("withdrawn"));
  EXPECT_THAT(inbox_.take(), IsEmpty());
}

TEST_F(OrdersTest, AMissionThatHasEndedTakesNothing) {
  Orders orders(&inbox_, {}, folder_);
  auto answer = give(R"({"stop":null})");
  (void)wait_for_order(orders);
  inbox_.close();
  EXPECT_EQ(answer.get().reason, "the mission has ended");
  EXPECT_EQ(inbox_.give(parse_order(R"({"stop":null})"), seconds(60)).reason, "the mission has ended");
}

}  // namespace
}  // namespace cairn

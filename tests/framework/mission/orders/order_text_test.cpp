#include "framework/mission/orders/order_text.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

namespace cairn {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& text) {
  try {
    (void)parse_order(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

class OrderFile : public testing::Test {
 protected:
  ~OrderFile() override { std::filesystem::remove(file_); }
  void write(const std::string& text) const { std::ofstream(file_) << text; }
  [[nodiscard]] std::string error() const {
    try {
      (void)read_orders(file_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }
  const std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) / ("orders_" + std::to_string(::getpid()) + ".jsonl");
};

TEST(OrderText, AnOrderIsAStepAsMissionsWriteIt) {
  const Order order = parse_order(R"( {"goto": {"landmark": "pillar", "angle_deg": 90}} )");
  EXPECT_EQ(order.kind, "goto");
  ASSERT_NE(order.settings.find("landmark"), nullptr);
  EXPECT_EQ(order.settings.find("landmark")->scalar, "pillar");
  EXPECT_EQ(order.text, R"({"goto":{"landmark":"pillar","angle_deg":90}})");
}

TEST(OrderText, ASettingLeftOutIsAnEmptyMap) {
  EXPECT_EQ(parse_order(R"({"return_home": null})").settings.kind, ConfigValue::Kind::map);
  EXPECT_EQ(parse_order(R"({"stop": {}})").kind, "stop");
}

TEST(OrderText, WhatIsNoOrderIsRefusedWithTheNearestName) {
  EXPECT_THAT(error_of(R"({"gotoo": "L1"})"), HasSubstr("order:1:2: unknown order \"gotoo\" (did you mean \"goto\"?)"));
  EXPECT_THAT(error_of(R"({"goto": "L1", "stop": null})"), HasSubstr("a map with one key"));
  EXPECT_THAT(error_of("[1, 2]"), HasSubstr("found a list"));
  EXPECT_THAT(error_of("{goto: L1}"), HasSubstr("an order is JSON in one line"));
  EXPECT_THAT(error_of(R"({"stop": 3})"), HasSubstr("stop takes no settings"));
  EXPECT_THAT(error_of(std::string(200, '[')), HasSubstr("order:1:"));
}

TEST_F(OrderFile, WhatIsRecordedIsReadAgain) {
  write(recorded_line(parse_order(R"({"goto":"L1"})"), 12, 0.6) + "\n" +
        recorded_line(parse_order(R"({"finish":null})"), 12, 0.6));
  const std::vector<RecordedOrder> orders = read_orders(file_);
  ASSERT_EQ(orders.size(), 2U);
  EXPECT_EQ(orders[0].tick, 12);
  EXPECT_EQ(orders[0].order.text, R"({"goto":"L1"})");
  EXPECT_EQ(orders[1].order.kind, "finish");
  EXPECT_EQ(orders[1].order.settings.place.line, 3) << "an empty line counts";
}

TEST_F(OrderFile, ErrorsNameFileLineAndColumn) {
  write(R"({"tick": 1, "order": {"stop": null}})"
        "\n"
        R"({"tick": 2, "order": {"gotoo": "L1"}})");
  EXPECT_THAT(error(), HasSubstr(file_.string() + ":2:23: unknown order \"gotoo\""));
  write(R"({"tick": 0, "order": {"stop": null}})");
  EXPECT_THAT(error(), HasSubstr(file_.string() + ":1:10: tick must be"));
  write(R"({"tick": 1})");
  EXPECT_THAT(error(), HasSubstr(file_.string() + ":1:"));
  write("{\"tick\": 5, \"order\": {\"stop\": null}}\n{\"tick\": 4, \"order\": {\"stop\": null}}");
  EXPECT_THAT(error(), HasSubstr(":2:10: tick must not be before that of the line above (5), found 4"));
  std::filesystem::remove(file_);
  EXPECT_THAT(error(), HasSubstr(file_.string() + ": cannot be read: No such file"));
}

}  // namespace
}  // namespace cairn

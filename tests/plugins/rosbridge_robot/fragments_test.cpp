#include "plugins/rosbridge_robot/fragments.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "plugins/rosbridge_robot/known_topics.hpp"
#include "plugins/rosbridge_robot/text_frame.hpp"

namespace cairn::rosbridge_robot {
namespace {

using nlohmann::json;

json piece(const std::string& id, std::size_t number, std::size_t total, const std::string& data) {
  return {{"op", "fragment"}, {"id", id}, {"num", number}, {"total", total}, {"data", data}};
}

TEST(Fragments, AreWholeWithTheLastPieceInWhateverOrder) {
  Fragments fragments(100);
  EXPECT_FALSE(fragments.add(piece("a", 2, 3, "c")));
  EXPECT_FALSE(fragments.add(piece("b", 0, 2, "x")));
  EXPECT_FALSE(fragments.add(piece("a", 0, 3, "a")));
  EXPECT_FALSE(fragments.add(piece("a", 0, 3, "again")));
  EXPECT_EQ(fragments.add(piece("a", 1, 3, "b")), "abc");
  EXPECT_EQ(fragments.add(piece("b", 1, 2, "y")), "xy");
  EXPECT_EQ(fragments.add(piece("c", 0, 1, "alone")), "alone");
}

TEST(Fragments, ThatAreTooLongOrCannotBeAreLeftOut) {
  Fragments fragments(5);
  EXPECT_FALSE(fragments.add(piece("a", 0, 2, "123")));
  EXPECT_FALSE(fragments.add(piece("a", 1, 2, "456")));
  EXPECT_FALSE(fragments.add(piece("b", 0, 0, "")));
  EXPECT_FALSE(fragments.add(piece("b", 2, 2, "")));
  EXPECT_FALSE(fragments.add(piece("b", 0, Fragments::kMaxPieces + 1, "")));
  EXPECT_FALSE(fragments.add(json{{"op", "fragment"}, {"num", -1}, {"total", 1}, {"data", "x"}, {"id", "b"}}));
  EXPECT_FALSE(fragments.add(json{{"op", "fragment"}}));
  EXPECT_EQ(fragments.add(piece("b", 0, 1, "fits")), "fits");
}

TEST(Fragments, OfManyMessagesAtOnceTheOldestIsForgotten) {
  Fragments fragments(100);
  for (std::size_t i = 0; i <= Fragments::kMaxMessages; ++i)
    EXPECT_FALSE(fragments.add(piece(std::to_string(i), 0, 2, "x")));
  EXPECT_FALSE(fragments.add(piece("0", 1, 2, "y"))) << "begins anew";
  EXPECT_EQ(fragments.add(piece(std::to_string(Fragments::kMaxMessages), 1, 2, "y")), "xy");
}

// RFC 6455, 5.7: a single-frame masked text message.
TEST(TextFrames, AreAsTheStandardHasThem) {
  EXPECT_EQ(text_frame("Hello", {0x37, 0xfa, 0x21, 0x3d}),
            (std::vector<std::uint8_t>{0x81, 0x85, 0x37, 0xfa, 0x21, 0x3d, 0x7f, 0x9f, 0x4d, 0x51, 0x58}));
  const std::vector<std::uint8_t> longer = text_frame(std::string(300, 'a'), {0, 0, 0, 0});
  ASSERT_EQ(longer.size(), 308U);
  EXPECT_EQ(longer[1], 0xFE);
  EXPECT_EQ(longer[2], 1);
  EXPECT_EQ(longer[3], 44);
  EXPECT_THROW((void)text_frame(std::string(70000, 'a'), {}), std::invalid_argument);
}

TEST(KnownTopicsOfRosapi, AreThoseOfItsAnswers) {
  KnownTopics known;
  known.take_answer({{"op", "service_response"}, {"id", KnownTopics::kTopicsCall}, {"values", "no such service"}});
  EXPECT_FALSE(known.types());
  known.take_answer({{"id", KnownTopics::kTopicsCall}, {"values", {{"topics", {"/a", "/b"}}, {"types", {"t/A"}}}}});
  ASSERT_TRUE(known.types());
  EXPECT_EQ(known.types()->at("/a"), "t/A");
  EXPECT_EQ(known.types()->size(), 1U);
  EXPECT_FALSE(known.listeners());
  known.take_answer({{"id", KnownTopics::kListenersCall}, {"values", {{"subscribers", json::array()}}}});
  EXPECT_EQ(known.listeners(), 0U);
}

}  // namespace
}  // namespace cairn::rosbridge_robot

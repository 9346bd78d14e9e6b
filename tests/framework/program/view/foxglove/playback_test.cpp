#include "framework/program/view/foxglove/playback.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace protocol = foxglove_protocol;
using Frames = FoxgloveConnection::Frames;

constexpr std::uint64_t kS = 1'000'000'000;
constexpr std::size_t kMuch = 1 << 20;

PlayedChannel channel(std::uint32_t id, const std::string& topic, const std::vector<std::uint64_t>& seconds) {
  PlayedChannel played;
  played.channel = {id, topic, "json", "S", "{}", "jsonschema"};
  for (const std::uint64_t second : seconds)
    played.messages.push_back({second * kS, topic + "@" + std::to_string(second)});
  return played;
}

// /a every second from 10 s to 14 s, /b at 11 s and 14 s, /marks (which add up) at 10 s and 11 s.
std::shared_ptr<const PlayedRecording> recording() {
  PlayedRecording all;
  all.name = "test";
  all.channels = {channel(1, "/a", {10, 11, 12, 13, 14}), channel(2, "/b", {11, 14}), channel(3, "/marks", {10, 11})};
  all.channels[2].is_incremental = true;
  all.times = {10 * kS, 14 * kS};
  return std::make_shared<const PlayedRecording>(std::move(all));
}

// "5:/a@10" for message data of subscription 5, "t11" for a time, "state 1" for a state of playback, texts as they are.
std::vector<std::string> shown(const Frames& frames) {
  std::vector<std::string> all;
  for (const protocol::Frame& frame : frames) {
    const std::string& bytes = frame.bytes;
    constexpr std::size_t kHead = 13;
    if (frame.is_text)
      all.push_back(bytes);
    else if (bytes[0] == 1)
      all.push_back(std::to_string(bytes[1]) + ":" + bytes.substr(kHead));
    else if (bytes[0] == 5)
      all.push_back("state " + std::to_string(bytes[1]));
  }
  return all;
}

class PlaybackConnectionTest : public testing::Test {
 protected:
  static std::string subscribe(int id, int channel) {
    return R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(id) + R"(,"channelId":)" +
           std::to_string(channel) + "}]}";
  }
  static std::string control(bool play, float speed, std::optional<std::uint64_t> seek_ns) {
    std::string bytes{'\3', play ? '\0' : '\1'};
    bytes.append(reinterpret_cast<const char*>(&speed), sizeof speed);
    bytes += seek_ns ? '\1' : '\0';
    const std::uint64_t seek = seek_ns.value_or(0);
    bytes.append(reinterpret_cast<const char*>(&seek), sizeof seek);
    return bytes + std::string("\1\0\0\0r", 5);
  }
  static std::string call(char service, const std::string& payload) {
    return std::string("\2") + service + std::string("\0\0\0\7\0\0\0\4\0\0\0json", 15) + payload;
  }

  const FoxgloveServices services_{[](const std::string& asked) {
                                     if (asked == "bad") throw std::runtime_error("no such place");
                                     return "answer to " + asked;
                                   },
                                   [](const std::string& command) {
                                     if (command == "cancel") throw std::runtime_error("this view only watches");
                                     return command + "d";
                                   }};
  PlaybackConnection connection_{recording(), true, "session", services_};
};

TEST_F(PlaybackConnectionTest, GreetsWithWhatItOffers) {
  const Frames frames = connection_.greeting();
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(json::parse(frames[0].bytes)["op"], "serverInfo");
  EXPECT_EQ(json::parse(frames[0].bytes)["dataEndTime"]["sec"], 14);
  EXPECT_EQ(json::parse(frames[1].bytes)["channels"].size(), 3U);
  EXPECT_EQ(json::parse(frames[2].bytes)["services"].size(), 4U);
  const PlaybackConnection old(recording(), false, "session", {});
  EXPECT_FALSE(json::parse(old.greeting()[0].bytes).contains("dataEndTime"));
}

TEST_F(PlaybackConnectionTest, PlaysInTheOrderOfTimeFromTheFirstSubscriptionOn) {
  EXPECT_THAT(shown(connection_.advance(1.0, kMuch)), IsEmpty());
  EXPECT_EQ(connection_.position_ns(), 10 * kS) << "nobody watches";
  EXPECT_THAT(shown(connection_.on_text(subscribe(5, 1))), IsEmpty());
  EXPECT_THAT(shown(connection_.on_text(subscribe(6, 2))), IsEmpty());
  EXPECT_THAT(shown(connection_.advance(1.0, kMuch)), ElementsAre("5:/a@10", "5:/a@11", "6:/b@11"));
  EXPECT_THAT(shown(connection_.advance(0.5, kMuch)), IsEmpty());
  EXPECT_THAT(shown(connection_.advance(0.5, kMuch)), ElementsAre("5:/a@12"));
  EXPECT_THAT(shown(connection_.on_text(R"({"op":"unsubscribe","subscriptionIds":[5]})")), IsEmpty());
  (void)connection_.advance(1.0, kMuch);
  EXPECT_THAT(shown(connection_.advance(1.0, kMuch)), ElementsAre("6:/b@14", "state 3"));
  EXPECT_THAT(shown(connection_.advance(1.0, kMuch)), IsEmpty());
}

TEST_F(PlaybackConnectionTest, ALateSubscriptionGetsHowThingsStand) {
  (void)connection_.on_text(subscribe(5, 1));
  for (int i = 0; i < 5; ++i) (void)connection_.advance(1.0, kMuch);
  (void)connection_.on_text(subscribe(6, 2));
  (void)connection_.on_text(subscribe(7, 3));
  EXPECT_THAT(shown(connection_.advance(0.0, kMuch)), ElementsAre("7:/marks@10", "7:/marks@11", "6:/b@14"));
}

TEST_F(PlaybackConnectionTest, PlaybackWaitsForAViewerThatIsSlow) {
  (void)connection_.on_text(subscribe(5, 1));
  (void)connection_.on_text(subscribe(6, 2));
  EXPECT_THAT(shown(connection_.advance(1.0, 1)), ElementsAre("5:/a@10"));
  EXPECT_EQ(connection_.position_ns(), 10 * kS);
  std::vector<std::string> rest;
  for (int i = 0; i < 20; ++i)
    for (const std::string& one : shown(connection_.advance(1.0, 1))) rest.push_back(one);
  EXPECT_THAT(rest, ElementsAre("5:/a@11", "6:/b@11", "5:/a@12", "5:/a@13", "5:/a@14", "6:/b@14", "state 3"));
}

TEST_F(PlaybackConnectionTest, PlaybackIsControlled) {
  (void)connection_.on_text(subscribe(5, 1));
  EXPECT_THAT(shown(connection_.on_binary(control(false, 1.0F, 12 * kS + 5))), ElementsAre("state 1"));
  EXPECT_THAT(shown(connection_.advance(1.0, kMuch)), ElementsAre("5:/a@12")) << "how things stood";
  EXPECT_THAT(shown(connection_.advance(1.0, kMuch)), IsEmpty()) << "paused";
  EXPECT_THAT(shown(connection_.on_binary(control(true, 0.5F, std::nullopt))), ElementsAre("state 0"));
  EXPECT_THAT(shown(connection_.advance(1.0, kMuch)), IsEmpty());
  EXPECT_THAT(shown(connection_.advance(1.0, kMuch)), ElementsAre("5:/a@13"));
  EXPECT_THAT(shown(connection_.on_binary(control(true, 2.0F, 99 * kS))), ElementsAre("state 3")) << "the end";
  EXPECT_THAT(shown(connection_.on_binary(control(true, 2.0F, 0))), ElementsAre("state 0"));
  EXPECT_THAT(shown(connection_.advance(0.0, kMuch)), ElementsAre("5:/a@10"));
  EXPECT_THAT(shown(connection_.on_binary(control(true, std::nanf(""), 0))).at(0), HasSubstr("must be above 0"));
  PlaybackConnection old(recording(), false, "session", {});
  EXPECT_THAT(shown(old.on_binary(control(true, 1.0F, 0))).at(0), HasSubstr("not offered here"));
}

TEST_F(PlaybackConnectionTest, PlansAndSteersAsTheServicesDo) {
  const Frames answer = connection_.on_binary(call(1, "{}"));
  ASSERT_EQ(answer.size(), 1U);
  EXPECT_TRUE(answer[0].bytes.ends_with("jsonanswer to {}")) << answer[0].bytes;
  const json refused = json::parse(connection_.on_binary(call(1, "bad"))[0].bytes);
  EXPECT_EQ(refused["op"], "serviceCallFailure");
  EXPECT_EQ(refused["callId"], 7);
  EXPECT_EQ(refused["message"], "no such place");
  EXPECT_TRUE(connection_.on_binary(call('\2', "{}"))[0].bytes.ends_with("paused"));
  EXPECT_TRUE(connection_.on_binary(call('\3', "{}"))[0].bytes.ends_with("resumed"));
  EXPECT_THAT(connection_.on_binary(call('\4', "{}"))[0].bytes, HasSubstr("this view only watches"));
  EXPECT_THAT(connection_.on_binary(call('\5', "{}"))[0].bytes, HasSubstr("there is no such service"));
}

TEST_F(PlaybackConnectionTest, WhatIsNotUnderstoodIsAnsweredByAStatus) {
  const auto level_of = [&](const std::string& text) {
    const Frames frames = connection_.on_text(text);
    return frames.size() == 1 ? json::parse(frames[0].bytes).value("level", -1) : -1;
  };
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[]"), std::string(R"({"op":1})"), subscribe(1, 99),
        std::string(R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})"),
        std::string(R"({"op":"subscribe","subscriptions":[7]})")})
    EXPECT_EQ(level_of(text), 2) << text;
  EXPECT_EQ(level_of(R"({"op":"getParameters"})"), 1);
  EXPECT_THAT(connection_.on_text(R"({"op":"subscribe"})"), IsEmpty());
  EXPECT_THAT(connection_.on_text(subscribe(1, 1)), IsEmpty());
  EXPECT_EQ(level_of(subscribe(1, 2)), 2) << "the id is taken";
  EXPECT_EQ(json::parse(connection_.on_binary("\1abcd")[0].bytes)["level"], 2);
  EXPECT_EQ(json::parse(connection_.on_binary("")[0].bytes)["level"], 2);
}

}  // namespace
}  // namespace cairn

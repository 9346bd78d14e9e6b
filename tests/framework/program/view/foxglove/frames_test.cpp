// The byte layout of Foxglove's protocol.
#include "framework/program/view/foxglove/frames.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace cairn::foxglove_protocol {
namespace {

std::string hex(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) {
    constexpr const char* kDigits = "0123456789abcdef";
    const auto value = static_cast<unsigned char>(c);
    text += std::string{kDigits[value >> 4U], kDigits[value & 15U]} + " ";
  }
  return text;
}

std::string from_hex(const std::string& text) {
  std::istringstream in(text);
  std::string bytes;
  for (unsigned value = 0; in >> std::hex >> value;) bytes += static_cast<char>(value);
  return bytes;
}

TEST(FoxgloveFrames, BinaryFramesHaveTheirLayout) {
  EXPECT_EQ(hex(message_data(0x01020304, 0x1112131415161718ULL, "ab").bytes),
            "01 04 03 02 01 18 17 16 15 14 13 12 11 61 62 ");
  EXPECT_EQ(hex(time(7).bytes), "02 07 00 00 00 00 00 00 00 ");
  EXPECT_EQ(hex(service_response(1, 2, "{}").bytes), "03 01 00 00 00 02 00 00 00 04 00 00 00 6a 73 6f 6e 7b 7d ");
  EXPECT_EQ(hex(playback_state(Playing::playing, 12345, 1.0F, true, "i").bytes),
            "05 00 39 30 00 00 00 00 00 00 00 00 80 3f 01 01 00 00 00 69 ");
  EXPECT_EQ(hex(playback_state(Playing::ended, 0, 0.5F, false, "").bytes),
            "05 03 00 00 00 00 00 00 00 00 00 00 00 3f 00 00 00 00 00 ");
  EXPECT_FALSE(time(7).is_text);
}

TEST(FoxgloveFrames, ServiceCallsAreRead) {
  const std::string bytes = from_hex("02 01 00 00 00 02 00 00 00 04 00 00 00 6a 73 6f 6e 7b 7d");
  const auto call = service_call_of(bytes);
  ASSERT_TRUE(call);
  EXPECT_EQ(call->service, 1U);
  EXPECT_EQ(call->call, 2U);
  EXPECT_EQ(call->encoding, "json");
  EXPECT_EQ(call->payload, "{}");
  for (std::size_t size = 0; size < bytes.size() - 2; ++size) EXPECT_FALSE(service_call_of(bytes.substr(0, size)));
  EXPECT_FALSE(service_call_of(from_hex("02 01 00 00 00 02 00 00 00 ff ff ff ff 6a")));
}

TEST(FoxgloveFrames, ControlOfPlaybackIsRead) {
  const std::string play = from_hex("03 00 00 00 00 40 00 09 00 00 00 00 00 00 00 02 00 00 00 69 64");
  const auto control = playback_control_of(play);
  ASSERT_TRUE(control);
  EXPECT_TRUE(control->is_playing);
  EXPECT_EQ(control->speed, 2.0F);
  EXPECT_FALSE(control->seek_ns) << "the time counts only where its flag is set";
  EXPECT_EQ(control->request, "id");
  const auto pause = playback_control_of(from_hex("03 01 00 00 80 3f 01 09 00 00 00 00 00 00 00 00 00 00 00"));
  ASSERT_TRUE(pause);
  EXPECT_FALSE(pause->is_playing);
  EXPECT_EQ(pause->seek_ns, 9U);
  EXPECT_FALSE(playback_control_of(from_hex("03 02 00 00 80 3f 01 09 00 00 00 00 00 00 00 00 00 00 00")));
  for (std::size_t size = 0; size < play.size(); ++size) EXPECT_FALSE(playback_control_of(play.substr(0, size)));
}

TEST(FoxgloveFrames, TextsAreWhatTheProtocolSays) {
  using nlohmann::json;
  const Range range{1'500'000'000, 2'000'000'007};
  const json info = json::parse(server_info("n", "s", range).bytes);
  EXPECT_EQ(info, json::parse(R"({"op":"serverInfo","name":"n","capabilities":["time","services","playbackControl"],
    "supportedEncodings":["json"],"metadata":{},"sessionId":"s","dataStartTime":{"sec":1,"nsec":500000000},
    "dataEndTime":{"sec":2,"nsec":7}})"));
  EXPECT_EQ(json::parse(server_info("n", "s", std::nullopt).bytes)["capabilities"], json({"time", "services"}));
  EXPECT_EQ(json::parse(advertise({{7, "/t", "json", "S", "{}", "jsonschema"}}).bytes),
            json::parse(R"({"op":"advertise","channels":[{"id":7,"topic":"/t","encoding":"json","schemaName":"S",
    "schema":"{}","schemaEncoding":"jsonschema"}]})"));
  EXPECT_EQ(json::parse(status(Level::warning, "m").bytes), json::parse(R"({"op":"status","level":1,"message":"m"})"));
  EXPECT_EQ(json::parse(service_failure(1, 2, "m").bytes),
            json::parse(R"({"op":"serviceCallFailure","serviceId":1,"callId":2,"message":"m"})"));
  const json services = json::parse(advertise_services({{1, "/s", "T", "{}", "[]"}}).bytes);
  EXPECT_EQ(services["op"], "advertiseServices");
  EXPECT_EQ(services["services"][0]["request"],
            json::parse(R"({"encoding":"json","schemaName":"TRequest","schemaEncoding":"jsonschema","schema":"{}"})"));
  EXPECT_TRUE(status(Level::info, "").is_text);
}

}  // namespace
}  // namespace cairn::foxglove_protocol

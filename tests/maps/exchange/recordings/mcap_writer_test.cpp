#include "maps/exchange/recordings/mcap_writer.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/maps/exchange/recordings/small_mcap.hpp"

namespace cairn::exchange {
namespace {

std::string small_file(const McapOptions& options) {
  std::string file;
  McapWriter writer([&](std::string_view bytes) { file += bytes; }, options);
  const auto schema = writer.add_schema("S", "jsonschema", "{}");
  const auto channel = writer.add_channel("/a", schema, "json");
  const auto unused = writer.add_channel("/unused", 0, "json");
  EXPECT_NE(unused, channel);
  writer.write(channel, 7, "[]");
  writer.attach("f", "text/plain", 7, "x");
  writer.close();
  return file;
}

TEST(McapWriterTest, WritesTheBytesThatTheSpecificationSays) {
  EXPECT_EQ(small_file({"", "t", McapCompression::none}), small_mcap::file());
}

TEST(McapWriterTest, TheSameCallsGiveTheSameBytes) {
  EXPECT_EQ(small_file({}), small_file({}));
  EXPECT_NE(small_file({}), small_file({"", "cairn", McapCompression::none}));
}

TEST(McapWriterTest, AChunkEndsBySizeAndByTime) {
  std::string file;
  McapWriter writer([&](std::string_view bytes) { file += bytes; }, {"", "t", McapCompression::none, 1000, 100});
  const auto channel = writer.add_channel("/a", 0, "json");
  const auto grows_by = [&](std::uint64_t time_ns, std::size_t bytes) {
    const std::size_t before = file.size();
    writer.write(channel, time_ns, std::string(bytes, 'x'));
    return file.size() - before;
  };
  EXPECT_EQ(grows_by(0, 10), 0U);
  EXPECT_EQ(grows_by(99, 10), 0U);
  EXPECT_GT(grows_by(100, 10), 30U);
  EXPECT_EQ(grows_by(101, 10), 0U);
  EXPECT_GT(grows_by(102, 1000), 1000U);
}

}  // namespace
}  // namespace cairn::exchange

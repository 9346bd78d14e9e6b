#include "maps/exchange/recordings/mcap_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lz4frame.h>

#include <algorithm>
#include <string>
#include <vector>

#include "maps/exchange/recordings/mcap_compression.hpp"
#include "maps/exchange/recordings/mcap_fields.hpp"
#include "maps/exchange/recordings/mcap_writer.hpp"
#include "tests/maps/exchange/recordings/small_mcap.hpp"

namespace cairn::exchange {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct WhatWasRead {
  std::vector<std::string> channels;  // "topic encoding schema"
  std::vector<std::string> messages;  // "topic time data"
  std::vector<std::string> attachments;
  std::vector<std::string> damages;  // "offset what"
  McapEnding ending = McapEnding::cut;
};

WhatWasRead read_all(std::string_view file) {
  WhatWasRead read;
  std::map<std::uint16_t, std::string> topics;
  McapHandlers handlers;
  handlers.channel = [&](const McapChannel& channel) {
    topics[channel.id] = channel.topic;
    read.channels.push_back(topics[channel.id] + " " + std::string(channel.encoding) + " " +
                            std::string(channel.schema) + " " + std::string(channel.schema_data));
  };
  handlers.message = [&](const McapMessage& message) {
    read.messages.push_back(topics.at(message.channel) + " " + std::to_string(message.log_time_ns) + " " +
                            std::string(message.data));
  };
  handlers.attachment = [&](const McapAttachment& attachment) {
    read.attachments.push_back(std::string(attachment.name) + " " + std::string(attachment.data));
  };
  handlers.damaged = [&](std::uint64_t offset, const std::string& what) {
    read.damages.push_back(std::to_string(offset) + " " + what);
  };
  read.ending = read_mcap(file, handlers);
  return read;
}

// Three chunks of two messages.
std::string written_file(McapCompression compression) {
  std::string file;
  McapOptions options;
  options.compression = compression;
  options.chunk_bytes = 300;
  McapWriter writer([&](std::string_view bytes) { file += bytes; }, options);
  const auto a = writer.add_channel("/a", writer.add_schema("A", "ros2msg", "int32 x"), "cdr");
  const auto b = writer.add_channel("/b", 0, "json");
  for (std::uint64_t i = 0; i < 3; ++i) {
    writer.write(a, i, std::string(100, static_cast<char>('a' + i)));
    writer.write(b, i, std::string(200, static_cast<char>('x' + i)));
  }
  writer.attach("f", "text/plain", 7, "attached");
  writer.close();
  return file;
}

TEST(McapReaderTest, ReadsTheBytesThatTheSpecificationSays) {
  const WhatWasRead read = read_all(small_mcap::file());
  EXPECT_THAT(read.channels, ElementsAre("/a json S {}"));
  EXPECT_THAT(read.messages, ElementsAre("/a 7 []"));
  EXPECT_THAT(read.attachments, ElementsAre("f x"));
  EXPECT_THAT(read.damages, ElementsAre());
  EXPECT_EQ(read.ending, McapEnding::whole);
}

TEST(McapReaderTest, ReadsWhatTheWriterWrites) {
  for (const McapCompression compression : {McapCompression::none, McapCompression::zstd}) {
    const WhatWasRead read = read_all(written_file(compression));
    EXPECT_THAT(read.channels, ElementsAre("/a cdr A int32 x", "/b json  "));
    ASSERT_EQ(read.messages.size(), 6U);
    EXPECT_EQ(read.messages.back(), "/b 2 " + std::string(200, 'z'));
    EXPECT_EQ(read.ending, McapEnding::whole);
    EXPECT_THAT(read.damages, ElementsAre());
  }
}

TEST(McapReaderTest, CutOffAnywhereItIsReadUpToItsLastWholeChunk) {
  for (const McapCompression compression : {McapCompression::none, McapCompression::zstd}) {
    const std::string file = written_file(compression);
    const WhatWasRead whole = read_all(file);
    std::size_t most = 0;
    for (std::size_t size = 8; size < file.size(); ++size) {
      const WhatWasRead cut = read_all(std::string_view(file).substr(0, size));
      ASSERT_EQ(cut.ending, McapEnding::cut) << size;
      ASSERT_THAT(cut.damages, ElementsAre()) << size;
      ASSERT_EQ(cut.messages.size() % 2, 0U) << size;
      ASSERT_GE(cut.messages.size(), most) << size;
      most = cut.messages.size();
      ASSERT_TRUE(std::equal(cut.messages.begin(), cut.messages.end(), whole.messages.begin()));
    }
    EXPECT_EQ(most, 6U);
  }
}

TEST(McapReaderTest, EveryChangedByteIsNoticed) {
  for (const McapCompression compression : {McapCompression::none, McapCompression::zstd}) {
    const std::string file = written_file(compression);
    for (std::size_t at = 0; at < file.size(); ++at)
      for (const int bit : {0, 3, 7}) {
        std::string changed = file;
        changed[at] = static_cast<char>(changed[at] ^ (1 << bit));
        try {
          const WhatWasRead read = read_all(changed);
          ASSERT_TRUE(read.ending == McapEnding::cut || !read.damages.empty()) << "byte " << at << ", bit " << bit;
        } catch (const McapError&) {
          ASSERT_LT(at, 8U);
        }
      }
  }
}

TEST(McapReaderTest, ADamagedChunkIsLeftOutAndTheOthersAreRead) {
  std::string file = written_file(McapCompression::none);
  file[file.find("bbbb")] = 'B';
  const WhatWasRead read = read_all(file);
  EXPECT_EQ(read.messages.size(), 4U);
  ASSERT_EQ(read.damages.size(), 2U);
  EXPECT_THAT(read.damages[0], HasSubstr("the checksum of a chunk is wrong"));
  EXPECT_THAT(read.damages[1], HasSubstr("the checksum of all data before this place is wrong"));
  EXPECT_EQ(read.ending, McapEnding::whole);
}

TEST(McapReaderTest, MessagesOfALostChannelAreReportedOnce) {
  std::string file = written_file(McapCompression::none);
  file[file.find("aaaa")] = 'A';
  const WhatWasRead read = read_all(file);
  EXPECT_TRUE(read.messages.empty());
  EXPECT_THAT(read.damages, testing::Contains(HasSubstr("messages of channel 2, which no record has introduced")));
  EXPECT_EQ(read.damages.size(), 4U);
}

TEST(McapReaderTest, OtherFilesAreRefused) {
  for (const std::string& bytes :
       {std::string(), std::string("\x89MCA"), std::string("SQLite format 3"), std::string("\x89MCAP1\r\n")})
    EXPECT_THROW((void)read_all(bytes), McapError) << bytes;
}

TEST(McapReaderTest, ALengthThatCannotBeTakesNoMemory) {
  const std::string huge = std::string("\x89MCAP0\r\n\x06", 9) + std::string(8, '\x7f');
  EXPECT_THAT(read_all(huge).damages, ElementsAre(HasSubstr("those up to 1 GiB can be read")));
  const std::string large = std::string("\x89MCAP0\r\n\x06", 9) + std::string("\0\0\0\x20\0\0\0\0", 8) + "abc";
  EXPECT_EQ(read_all(large).ending, McapEnding::cut);
}

std::string lz4_frame(const std::string& text) {
  std::string packed(LZ4F_compressFrameBound(text.size(), nullptr), '\0');
  packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), text.data(), text.size(), nullptr));
  return packed;
}

std::string refusal_of(std::string_view compression, std::string_view packed, std::uint64_t size) {
  try {
    (void)unpacked(compression, packed, size);
  } catch (const McapDamage& damage) {
    return damage.what();
  }
  return "none";
}

TEST(McapCompressionTest, UnpacksLz4) {
  for (const std::size_t size : {0U, 1U, 1000U, 3'000'000U}) {
    std::string text;
    for (std::size_t i = 0; i < size; ++i) text += static_cast<char>(i % 251 + i / 1000);
    const std::string packed = lz4_frame(text);
    EXPECT_TRUE(unpacked("lz4", packed, size) == text) << size;
    EXPECT_THAT(refusal_of("lz4", packed, size + 1), HasSubstr("but there are " + std::to_string(size)));
    if (size > 0) {
      EXPECT_THAT(refusal_of("lz4", packed, size - 1), HasSubstr("but there are more"));
      EXPECT_NE(refusal_of("lz4", packed.substr(0, packed.size() / 2), size), "none");
    }
  }
}

TEST(McapCompressionTest, LooksUpOnceForEachMiB) {
  const std::string text(10'000'000, 'a');
  int looks = 0;
  EXPECT_EQ(unpacked("lz4", lz4_frame(text), text.size(), [&] { ++looks; }), text);
  EXPECT_GE(looks, 10);
}

TEST(McapReaderTest, WhoLooksUpMayEndALargeChunk) {
  std::string file;
  McapOptions options;
  options.chunk_bytes = 100'000'000;
  McapWriter writer([&](std::string_view bytes) { file += bytes; }, options);
  const auto a = writer.add_channel("/a", writer.add_schema("A", "ros2msg", "int32 x"), "cdr");
  for (std::uint64_t i = 0; i < 20; ++i) writer.write(a, i, std::string(1'000'000, 'a'));
  writer.close();
  struct Ended {};
  for (const int read_before : {0, 1}) {  // 0: while it is unpacked
    int messages = 0;
    McapHandlers handlers;
    handlers.message = [&](const McapMessage&) { ++messages; };
    handlers.look = [&] {
      if (messages >= read_before) throw Ended{};
    };
    EXPECT_THROW((void)read_mcap(file, handlers), Ended);
    EXPECT_GE(messages, read_before);
    EXPECT_LE(messages, 3 * read_before);
  }
}

TEST(McapCompressionTest, SaysWhatIsWrong) {
  EXPECT_EQ(unpacked("", "abc", 3), "abc");
  EXPECT_THAT(refusal_of("", "abc", 4), HasSubstr("4 bytes, but there are 3"));
  EXPECT_THAT(refusal_of("bz2", "abc", 3), HasSubstr("compressed by \"bz2\"; none, lz4 and zstd can be read"));
  EXPECT_THAT(refusal_of("lz4", "no frame", 3), HasSubstr("lz4: "));
  EXPECT_THAT(refusal_of("zstd", "no frame", 3), HasSubstr("zstd: "));
}

}  // namespace
}  // namespace cairn::exchange

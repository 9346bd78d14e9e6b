#include "plugins/p2os_robot/packet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace cairn::p2os_robot {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of(const CommandPacket& packet) {
  return {packet.bytes().begin(), packet.bytes().end()};
}

// As printed in the manuals of the Pioneers.
TEST(CommandPacket, IsAsTheManualPrintsIt) {
  EXPECT_THAT(bytes_of(CommandPacket::synchronisation(0)), ElementsAre(250, 251, 3, 0, 0, 0));
  EXPECT_THAT(bytes_of(CommandPacket::synchronisation(1)), ElementsAre(250, 251, 3, 1, 0, 1));
  EXPECT_THAT(bytes_of(CommandPacket::synchronisation(2)), ElementsAre(250, 251, 3, 2, 0, 2));
  EXPECT_THAT(bytes_of(CommandPacket(Command::open)), ElementsAre(250, 251, 3, 1, 0, 1));
  EXPECT_THAT(bytes_of(CommandPacket(Command::close)), ElementsAre(250, 251, 3, 2, 0, 2));
  EXPECT_THAT(bytes_of(CommandPacket(Command::enable_motors, 1)), ElementsAre(250, 251, 6, 4, 59, 1, 0, 5, 59));
}

TEST(CommandPacket, HasNegativeValuesAsTheirSizeAndAKind) {
  EXPECT_THAT(bytes_of(CommandPacket(Command::velocity, -300)),
              ElementsAre(250, 251, 6, 11, 0x1B, 0x2C, 0x01, 0x37, 0x1C));
  EXPECT_THAT(bytes_of(CommandPacket(Command::velocity, 100000)),
              ElementsAre(250, 251, 6, 11, 0x3B, 0xFF, 0xFF, 0x0B, 0x3A));
}

TEST(Checksum, HasALastByteAloneXoredIn) {
  EXPECT_EQ(checksum_of({}), 0);
  EXPECT_EQ(checksum_of(Bytes{0x12, 0x34, 0xF0, 0x0F}), 0x0243);
  EXPECT_EQ(checksum_of(Bytes{0x12, 0x34, 0x0F}), 0x123B);
}

Bytes packet_of(const Bytes& data) {
  Bytes packet{0xFA, 0xFB, static_cast<std::uint8_t>(data.size() + 2)};
  packet.insert(packet.end(), data.begin(), data.end());
  const std::uint16_t sum = checksum_of(data);
  packet.push_back(static_cast<std::uint8_t>(sum >> 8U));
  packet.push_back(static_cast<std::uint8_t>(sum & 0xFFU));
  return packet;
}

TEST(PacketReader, FindsPacketsThatComeInPartsAmongWhatIsNone) {
  const Bytes first{0x32, 1, 2, 3};
  const Bytes second{0xFA, 0xFB, 5};  // data that looks like a head
  Bytes line{0x00, 0xFA, 0xFA};
  for (const Bytes& packet : {packet_of(first), Bytes{0xFB, 0xFA, 0xFB, 2}, packet_of(second)})
    line.insert(line.end(), packet.begin(), packet.end());
  PacketReader reader;
  std::vector<Bytes> found;
  for (const std::uint8_t byte : line) {
    reader.take({&byte, 1});
    while (const auto data = reader.next()) found.push_back(*data);
  }
  EXPECT_THAT(found, ElementsAre(first, second));
}

TEST(PacketReader, LosesOnlyTheDamagedPacket) {
  Bytes damaged = packet_of({0x32, 9, 9, 9});
  damaged[4] ^= 0x10;
  Bytes line = packet_of({0x32, 1});
  const Bytes last = packet_of({0x33, 2});
  line.insert(line.end(), damaged.begin(), damaged.end());
  line.insert(line.end(), last.begin(), last.end());
  PacketReader reader;
  reader.take(line);
  EXPECT_THAT(*reader.next(), ElementsAre(0x32, 1));
  EXPECT_THAT(*reader.next(), ElementsAre(0x33, 2));
  EXPECT_EQ(reader.next(), std::nullopt);
  EXPECT_EQ(reader.damaged(), 1);
}

TEST(PacketReader, NoiseIsNoPacketAndEveryWholeOneAfterItIsFound) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    PacketReader reader;
    Bytes noise(random() % 300);
    for (std::uint8_t& byte : noise)
      byte = static_cast<std::uint8_t>(random() % 4 == 0 ? 0xFA + random() % 2 : random());
    reader.take(noise);
    // What the noise promised to be longer must come to its end first.
    for (int i = 0; i < 40; ++i) reader.take(packet_of({0x32, 7, 7, 7, 7, 7, 7, 7}));
    Bytes last;
    while (const auto data = reader.next()) last = *data;
    EXPECT_THAT(last, ElementsAreArray(Bytes{0x32, 7, 7, 7, 7, 7, 7, 7})) << "round " << round;
  }
}

}  // namespace
}  // namespace cairn::p2os_robot

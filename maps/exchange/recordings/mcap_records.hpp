// The records that MCAP files are made of, as the specification numbers them.
#pragma once

#include <cstdint>
#include <string_view>

namespace cairn::exchange {

inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

enum class McapRecord : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F
};

// The checksum that they have (CRC-32); begin: that of the bytes before.
[[nodiscard]] std::uint32_t crc32_of(std::string_view bytes, std::uint32_t begin = 0);

}  // namespace cairn::exchange

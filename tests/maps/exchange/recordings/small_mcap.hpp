// A small MCAP file, byte by byte: schema, channel, message, attachment and the whole index.
#pragma once

#include <sstream>
#include <string>

namespace cairn::exchange::small_mcap {

inline std::string bytes_of(const std::string& hex) {
  std::istringstream in(hex);
  std::string bytes;
  for (unsigned value = 0; in >> std::hex >> value;) bytes += static_cast<char>(value);
  return bytes;
}

// Put together from the specification, field by field; the checksums by another program.
inline const char* const kSmallFile =
    // magic
    "89 4d 43 41 50 30 0d 0a "
    // header: profile "", library "t"
    "01 09 00 00 00 00 00 00 00 00 00 00 00 01 00 00 00 74 "
    // chunk from 7 ns to 7 ns, of 3 records
    "06 8c 00 00 00 00 00 00 00 07 00 00 00 00 00 00 00 07 00 00 00 00 00 00 00 64 00 00 00 00 00 00 "
    "00 c6 d7 15 d0 00 00 00 00 64 00 00 00 00 00 00 00 "
    //   schema 1 "S", jsonschema, "{}"
    "03 1b 00 00 00 00 00 00 00 01 00 01 00 00 00 53 0a 00 00 00 6a 73 6f 6e 73 63 68 65 6d 61 02 00 "
    "00 00 7b 7d "
    //   channel 1 of schema 1, "/a", json, no metadata
    "04 16 00 00 00 00 00 00 00 01 00 01 00 02 00 00 00 2f 61 04 00 00 00 6a 73 6f 6e 00 00 00 00 "
    //   message 0 of channel 1 at 7 ns: "[]"
    "05 18 00 00 00 00 00 00 00 01 00 00 00 00 00 07 00 00 00 00 00 00 00 07 00 00 00 00 00 00 00 5b "
    "5d "
    // message index of channel 1: 7 ns at 67
    "07 16 00 00 00 00 00 00 00 01 00 10 00 00 00 07 00 00 00 00 00 00 00 43 00 00 00 00 00 00 00 "
    // attachment "f" of "x"
    "09 30 00 00 00 00 00 00 00 07 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 01 00 00 00 66 0a 00 "
    "00 00 74 65 78 74 2f 70 6c 61 69 6e 01 00 00 00 00 00 00 00 78 d8 f3 bb 76 "
    // data end
    "0f 04 00 00 00 00 00 00 00 36 7f 77 63 "
    // summary: schema
    "03 1b 00 00 00 00 00 00 00 01 00 01 00 00 00 53 0a 00 00 00 6a 73 6f 6e 73 63 68 65 6d 61 02 00 "
    "00 00 7b 7d "
    // summary: channel
    "04 16 00 00 00 00 00 00 00 01 00 01 00 02 00 00 00 2f 61 04 00 00 00 6a 73 6f 6e 00 00 00 00 "
    // statistics: 1 message, 1 schema, 1 channel, 1 attachment, no metadata, 1 chunk
    "0b 38 00 00 00 00 00 00 00 01 00 00 00 00 00 00 00 01 00 01 00 00 00 01 00 00 00 00 00 00 00 01 "
    "00 00 00 07 00 00 00 00 00 00 00 07 00 00 00 00 00 00 00 0a 00 00 00 01 00 01 00 00 00 00 00 00 "
    "00 "
    // chunk index
    "08 4a 00 00 00 00 00 00 00 07 00 00 00 00 00 00 00 07 00 00 00 00 00 00 00 1a 00 00 00 00 00 00 "
    "00 95 00 00 00 00 00 00 00 0a 00 00 00 01 00 af 00 00 00 00 00 00 00 1f 00 00 00 00 00 00 00 00 "
    "00 00 00 64 00 00 00 00 00 00 00 64 00 00 00 00 00 00 00 "
    // attachment index
    "0a 3b 00 00 00 00 00 00 00 ce 00 00 00 00 00 00 00 39 00 00 00 00 00 00 00 07 00 00 00 00 00 00 "
    "00 00 00 00 00 00 00 00 00 01 00 00 00 00 00 00 00 01 00 00 00 66 0a 00 00 00 74 65 78 74 2f 70 "
    "6c 61 69 6e "
    // summary offset of records 03
    "0e 11 00 00 00 00 00 00 00 03 14 01 00 00 00 00 00 00 24 00 00 00 00 00 00 00 "
    // summary offset of records 04
    "0e 11 00 00 00 00 00 00 00 04 38 01 00 00 00 00 00 00 1f 00 00 00 00 00 00 00 "
    // summary offset of records 0b
    "0e 11 00 00 00 00 00 00 00 0b 57 01 00 00 00 00 00 00 41 00 00 00 00 00 00 00 "
    // summary offset of records 08
    "0e 11 00 00 00 00 00 00 00 08 98 01 00 00 00 00 00 00 53 00 00 00 00 00 00 00 "
    // summary offset of records 0a
    "0e 11 00 00 00 00 00 00 00 0a eb 01 00 00 00 00 00 00 44 00 00 00 00 00 00 00 "
    // footer
    "02 14 00 00 00 00 00 00 00 14 01 00 00 00 00 00 00 2f 02 00 00 00 00 00 00 d0 dd a1 e7 "
    // magic
    "89 4d 43 41 50 30 0d 0a ";

inline std::string file() {
  return bytes_of(kSmallFile);
}

}  // namespace cairn::exchange::small_mcap

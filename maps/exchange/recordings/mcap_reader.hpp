// Reads MCAP files from front to back (https://mcap.dev/spec), with or without their index, in memory for one record at
// a time.
//
// Every checksum that the file has is compared. What is damaged or cut off is reported and left out: records are their
// own units, so that a file whose writer was killed is read up to its last whole chunk.
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace cairn::exchange {

// These bytes are no MCAP file at all.
class McapError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Valid during the call that hands them over.
struct McapChannel {
  std::uint16_t id = 0;
  std::string_view topic;
  std::string_view encoding;         // of its messages: "cdr", "json", ...
  std::string_view schema;           // "sensor_msgs/msg/Range"; empty: none
  std::string_view schema_encoding;  // "ros2msg", "jsonschema", ...
  std::string_view schema_data;
};

struct McapMessage {
  std::uint16_t channel = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::string_view data;
  std::uint64_t offset = 0;  // in the file: of the chunk or the record that it is in
};

struct McapAttachment {
  std::string_view name;
  std::string_view media_type;
  std::string_view data;
};

// What is called as the file is read. Those that are not set do nothing. What they throw passes through.
struct McapHandlers {
  std::function<void(const McapChannel&)> channel;  // before its first message; again only when it has changed
  std::function<void(const McapMessage&)> message;
  std::function<void(const McapAttachment&)> attachment;
  std::function<void(std::uint64_t offset, const std::string& what)> damaged;  // a record that is left out
  std::function<void()> look;  // once for each MiB that a chunk unpacks to, and for each that is read out of it
};

enum class McapEnding {
  whole,  // up to the magic at its end
  cut     // somewhere before
};

// At most so many bytes; fewer at the end of the file only.
using McapSource = std::function<std::size_t(char* to, std::size_t count)>;

// Throws McapError when the bytes do not begin as an MCAP file.
McapEnding read_mcap(const McapSource& source, const McapHandlers& handlers);
// The whole file in memory.
McapEnding read_mcap(std::string_view file, const McapHandlers& handlers);

}  // namespace cairn::exchange

// Writes MCAP files: messages of any encoding by time (https://mcap.dev/spec).
//
// Chunks are indexed and compressed by Zstandard, and every checksum that the format has is written. The bytes go out
// in the order of the file and are never changed again: what a program has written when it is killed is whole up to the
// last chunk. The same calls write the same bytes. Not thread-safe.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cairn::exchange {

enum class McapCompression : std::uint8_t { none, zstd };

struct McapOptions {
  std::string profile;  // empty: messages of no one framework
  std::string library = "cairn";
  McapCompression compression = McapCompression::zstd;
  std::size_t chunk_bytes = 768 * 1024;        // a chunk ends with the message that reaches this
  std::uint64_t chunk_ns = 10'000'000'000ULL;  // or that is so much later than its first
};

class McapWriter {
 public:
  using Ids = std::uint16_t;
  using Sink = std::function<void(std::string_view)>;

  // What the sink throws passes through. Throws std::runtime_error when there is no memory to compress in.
  McapWriter(Sink sink, McapOptions options = {});

  // name: as the encoding has it, "sensor_msgs/msg/Range"; encoding: "jsonschema", "ros2msg", ... Returns the id.
  Ids add_schema(std::string_view name, std::string_view encoding, std::string_view data);
  // schema: 0 for none. encoding: of its messages, "json", "cdr", ... Returns the id.
  Ids add_channel(std::string_view topic, Ids schema, std::string_view encoding);
  void write(Ids channel, std::uint64_t time_ns, std::string_view message);
  // A file beside the messages. Ends the chunk.
  void attach(std::string_view name, std::string_view media_type, std::uint64_t time_ns, std::string_view data);
  void end_chunk();
  // Writes the index of the whole. Nothing may be written after it.
  void close();

 private:
  struct Span {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    std::uint64_t messages = 0;
    void add(std::uint64_t time_ns);
  };
  struct Channel {
    Ids schema = 0;
    std::string record;
    bool is_written = false;
    std::uint32_t messages = 0;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> in_chunk;  // time and offset
  };
  struct Schema {
    std::string record;
    bool is_written = false;
  };

  void put(std::string_view bytes);
  void put_message_indexes(std::map<Ids, std::uint64_t>& offsets);
  void introduce(Channel& channel);
  [[nodiscard]] std::string compressed() const;
  [[nodiscard]] std::string statistics() const;

  Sink sink_;
  McapOptions options_;
  std::uint64_t offset_ = 0;
  std::uint32_t crc_ = 0;  // of all that was put
  std::map<Ids, Schema> schemas_;
  std::map<Ids, Channel> channels_;
  std::string chunk_;
  Span chunk_span_;
  Span file_span_;
  std::vector<std::string> chunk_indexes_;
  std::vector<std::string> attachment_indexes_;
};

}  // namespace cairn::exchange

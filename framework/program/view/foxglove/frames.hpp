// The frames of Foxglove's WebSocket protocol: JSON texts, and binary ones with little-endian numbers.
//
// Two names of it are in use, foxglove.websocket.v1 (older clients) and foxglove.sdk.v1; the frames are the same, and
// the second has control of playback besides.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cairn::foxglove_protocol {

inline constexpr const char* kOldName = "foxglove.websocket.v1";
inline constexpr const char* kName = "foxglove.sdk.v1";

struct Frame {
  bool is_text = false;
  std::string bytes;
};

struct Channel {
  std::uint32_t id = 0;
  std::string topic;
  std::string encoding;
  std::string schema_name;
  std::string schema;
  std::string schema_encoding;
};

// A call with JSON, answered by JSON.
struct Service {
  std::uint32_t id = 0;
  std::string name;
  std::string type;
  std::string request_schema;  // JSON schemas
  std::string response_schema;
};

struct Range {
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;
};

// From the server. playback: the times that can be played and controlled.
[[nodiscard]] Frame server_info(const std::string& name, const std::string& session,
                                const std::optional<Range>& playback);
[[nodiscard]] Frame advertise(const std::vector<Channel>& channels);
[[nodiscard]] Frame advertise_services(const std::vector<Service>& services);
enum class Level { info = 0, warning = 1, error = 2 };
[[nodiscard]] Frame status(Level level, const std::string& message);
[[nodiscard]] Frame service_failure(std::uint32_t service, std::uint32_t call, const std::string& message);

[[nodiscard]] Frame message_data(std::uint32_t subscription, std::uint64_t time_ns, std::string_view payload);
[[nodiscard]] Frame time(std::uint64_t time_ns);
[[nodiscard]] Frame service_response(std::uint32_t service, std::uint32_t call, std::string_view payload);
enum class Playing { playing = 0, paused = 1, buffering = 2, ended = 3 };
[[nodiscard]] Frame playback_state(Playing playing, std::uint64_t time_ns, float speed, bool did_seek,
                                   std::string_view request);

// From the client.
struct ServiceCall {
  std::uint32_t service = 0;
  std::uint32_t call = 0;
  std::string_view encoding;
  std::string_view payload;
};
struct PlaybackControl {
  bool is_playing = false;
  float speed = 1.0F;
  std::optional<std::uint64_t> seek_ns;
  std::string_view request;
};
// Behind the byte that names the frame. None: it is none of these.
[[nodiscard]] std::optional<ServiceCall> service_call_of(std::string_view frame);
[[nodiscard]] std::optional<PlaybackControl> playback_control_of(std::string_view frame);

}  // namespace cairn::foxglove_protocol

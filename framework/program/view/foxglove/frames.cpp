#include "framework/program/view/foxglove/frames.hpp"

#include <bit>
#include <nlohmann/json.hpp>

namespace cairn::foxglove_protocol {
namespace {

using nlohmann::ordered_json;

enum class FromServer : std::uint8_t { message = 1, time = 2, service_response = 3, playback_state = 5 };
enum class FromClient : std::uint8_t { service_call = 2, playback_control = 3 };

Frame text(const ordered_json& json) {
  return {true, json.dump(-1, ' ', false, ordered_json::error_handler_t::replace)};
}

class Bytes {
 public:
  explicit Bytes(FromServer kind) { u8(static_cast<std::uint8_t>(kind)); }
  Bytes& u8(std::uint8_t value) { return number(value); }
  Bytes& u32(std::uint32_t value) { return number(value); }
  Bytes& u64(std::uint64_t value) { return number(value); }
  Bytes& append(std::string_view bytes) {
    frame_.bytes += bytes;
    return *this;
  }
  Bytes& sized(std::string_view bytes) { return u32(static_cast<std::uint32_t>(bytes.size())).append(bytes); }
  [[nodiscard]] Frame take() { return std::move(frame_); }

 private:
  template <class Unsigned>
  Bytes& number(Unsigned value) {
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
      frame_.bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFFU);
    return *this;
  }
  Frame frame_;
};

// Reads what is there; afterwards is_whole() says whether all of it was.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}
  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }
  std::string_view sized() { return take(u32()); }
  std::string_view rest() { return take(bytes_.size()); }
  [[nodiscard]] bool is_whole() const { return is_whole_; }

 private:
  std::string_view take(std::size_t count) {
    is_whole_ = is_whole_ && count <= bytes_.size();
    if (!is_whole_) return {};
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::uint64_t number(std::size_t size) {
    std::uint64_t value = 0;
    const std::string_view bytes = take(size);
    for (std::size_t i = 0; i < bytes.size(); ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    return value;
  }
  std::string_view bytes_;
  bool is_whole_ = true;
};

ordered_json time_json(std::uint64_t time_ns) {
  constexpr std::uint64_t kNsOfSecond = 1'000'000'000;
  return {{"sec", time_ns / kNsOfSecond}, {"nsec", time_ns % kNsOfSecond}};
}

ordered_json json_message(const std::string& name, const std::string& schema) {
  return {{"encoding", "json"}, {"schemaName", name}, {"schemaEncoding", "jsonschema"}, {"schema", schema}};
}

}  // namespace

Frame server_info(const std::string& name, const std::string& session, const std::optional<Range>& playback) {
  ordered_json info{{"op", "serverInfo"},
                    {"name", name},
                    {"capabilities", {"time", "services"}},
                    {"supportedEncodings", {"json"}},
                    {"metadata", ordered_json::object()},
                    {"sessionId", session}};
  if (playback) {
    info["capabilities"].push_back("playbackControl");
    info["dataStartTime"] = time_json(playback->begin_ns);
    info["dataEndTime"] = time_json(playback->end_ns);
  }
  return text(info);
}

Frame advertise(const std::vector<Channel>& channels) {
  ordered_json all = ordered_json::array();
  for (const Channel& channel : channels)
    all.push_back({{"id", channel.id},
                   {"topic", channel.topic},
                   {"encoding", channel.encoding},
                   {"schemaName", channel.schema_name},
                   {"schema", channel.schema},
                   {"schemaEncoding", channel.schema_encoding}});
  return text({{"op", "advertise"}, {"channels", std::move(all)}});
}

Frame advertise_services(const std::vector<Service>& services) {
  ordered_json all = ordered_json::array();
  for (const Service& service : services)
    all.push_back({{"id", service.id},
                   {"name", service.name},
                   {"type", service.type},
                   {"request", json_message(service.type + "Request", service.request_schema)},
                   {"response", json_message(service.type + "Response", service.response_schema)},
                   {"requestSchema", service.request_schema},
                   {"responseSchema", service.response_schema}});
  return text({{"op", "advertiseServices"}, {"services", std::move(all)}});
}

Frame status(Level level, const std::string& message) {
  return text({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

Frame service_failure(std::uint32_t service, std::uint32_t call, const std::string& message) {
  return text({{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", message}});
}

Frame message_data(std::uint32_t subscription, std::uint64_t time_ns, std::string_view payload) {
  return Bytes(FromServer::message).u32(subscription).u64(time_ns).append(payload).take();
}

Frame time(std::uint64_t time_ns) {
  return Bytes(FromServer::time).u64(time_ns).take();
}

Frame service_response(std::uint32_t service, std::uint32_t call, std::string_view payload) {
  return Bytes(FromServer::service_response).u32(service).u32(call).sized("json").append(payload).take();
}

Frame playback_state(Playing playing, std::uint64_t time_ns, float speed, bool did_seek, std::string_view request) {
  return Bytes(FromServer::playback_state)
      .u8(static_cast<std::uint8_t>(playing))
      .u64(time_ns)
      .u32(std::bit_cast<std::uint32_t>(speed))
      .u8(did_seek ? 1 : 0)
      .sized(request)
      .take();
}

std::optional<ServiceCall> service_call_of(std::string_view frame) {
  Fields fields(frame);
  if (fields.u8() != static_cast<std::uint8_t>(FromClient::service_call)) return std::nullopt;
  ServiceCall call;
  call.service = fields.u32();
  call.call = fields.u32();
  call.encoding = fields.sized();
  call.payload = fields.rest();
  return fields.is_whole() ? std::optional(call) : std::nullopt;
}

std::optional<PlaybackControl> playback_control_of(std::string_view frame) {
  Fields fields(frame);
  if (fields.u8() != static_cast<std::uint8_t>(FromClient::playback_control)) return std::nullopt;
  const std::uint8_t command = fields.u8();
  PlaybackControl control;
  control.is_playing = command == 0;
  control.speed = std::bit_cast<float>(fields.u32());
  const bool has_seek = fields.u8() != 0;
  const std::uint64_t seek_ns = fields.u64();
  if (has_seek) control.seek_ns = seek_ns;
  control.request = fields.sized();
  return fields.is_whole() && command <= 1 ? std::optional(control) : std::nullopt;
}

}  // namespace cairn::foxglove_protocol

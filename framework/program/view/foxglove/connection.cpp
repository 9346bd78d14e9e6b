#include "framework/program/view/foxglove/connection.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

namespace cairn {
namespace {

namespace protocol = foxglove_protocol;
using protocol::Level;

constexpr const char* kNotOffered = "a binary message that is not offered here";

enum FoxgloveService : std::uint32_t { plan_service = 1, pause_service, resume_service, cancel_service };

std::vector<protocol::Service> services() {
  const std::string ask =
      R"({"type":"object","properties":{"from":{"type":"string"},"to":{"type":"string"}},"required":["from","to"]})";
  const std::string any = R"({"type":"object"})";
  return {{plan_service, "/plan", "cairn.Plan", ask, any},
          {pause_service, "/pause", "cairn.Pause", any, any},
          {resume_service, "/resume", "cairn.Resume", any, any},
          {cancel_service, "/cancel", "cairn.Cancel", any, any}};
}

std::optional<std::uint32_t> id_of(const nlohmann::json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > UINT32_MAX) return std::nullopt;
  return value.get<std::uint32_t>();
}

const nlohmann::json& list_of(const nlohmann::json& message, const char* key) {
  static const nlohmann::json kEmpty = nlohmann::json::array();
  const auto found = message.find(key);
  return found != message.end() && found->is_array() ? *found : kEmpty;
}

}  // namespace

FoxgloveConnection::FoxgloveConnection(FoxgloveServices services) : services_(std::move(services)) {}

FoxgloveConnection::Frames FoxgloveConnection::greeting_of(const std::string& name, const std::string& session,
                                                           const std::optional<protocol::Range>& playback,
                                                           const std::vector<protocol::Channel>& channels) {
  return {protocol::server_info("cairn: " + name, session, playback), protocol::advertise(channels),
          protocol::advertise_services(services())};
}

std::optional<protocol::Frame> FoxgloveConnection::refused_subscription(std::uint32_t id, std::uint32_t channel,
                                                                        bool has_channel, bool has_subscription,
                                                                        std::size_t subscriptions) {
  if (!has_channel) return protocol::status(Level::error, "there is no channel " + std::to_string(channel));
  if (has_subscription)
    return protocol::status(Level::error, "subscription " + std::to_string(id) + " is there already");
  if (subscriptions >= kMaxFoxgloveSubscriptions)
    return protocol::status(Level::error,
                            "so many subscriptions are there already: " + std::to_string(kMaxFoxgloveSubscriptions));
  return std::nullopt;
}

FoxgloveConnection::Frames FoxgloveConnection::on_text(std::string_view text) {
  const auto message = nlohmann::json::parse(text, nullptr, false);
  if (!message.is_object() || !message.contains("op") || !message["op"].is_string())
    return {protocol::status(Level::error, "the message is no JSON object with an \"op\"")};
  const auto& op = message["op"].get_ref<const std::string&>();
  Frames frames;
  if (op == "subscribe") {
    for (const auto& one : list_of(message, "subscriptions")) {
      const auto id = one.is_object() && one.contains("id") ? id_of(one["id"]) : std::nullopt;
      const auto channel = one.is_object() && one.contains("channelId") ? id_of(one["channelId"]) : std::nullopt;
      Frames answers = id && channel ? subscribe(*id, *channel)
                                     : Frames{protocol::status(Level::error, "a subscription has id and channelId")};
      std::ranges::move(answers, std::back_inserter(frames));
    }
  } else if (op == "unsubscribe") {
    for (const auto& one : list_of(message, "subscriptionIds"))
      if (const auto id = id_of(one)) unsubscribe(*id);
  } else {
    frames.push_back(protocol::status(Level::warning, "\"" + op.substr(0, 64) + "\" is not offered here"));
  }
  return frames;
}

FoxgloveConnection::Frames FoxgloveConnection::on_binary(std::string_view frame) {
  if (const auto asked = protocol::service_call_of(frame)) return call(*asked);
  if (const auto asked = protocol::playback_control_of(frame)) return control(*asked);
  return {protocol::status(Level::error, kNotOffered)};
}

FoxgloveConnection::Frames FoxgloveConnection::control(const protocol::PlaybackControl&) {
  return {protocol::status(Level::error, kNotOffered)};
}

std::string FoxgloveConnection::answer_of(const protocol::ServiceCall& asked) const {
  if (asked.service == plan_service) return services_.plan(std::string(asked.payload));
  return services_.steer(asked.service == pause_service    ? "pause"
                         : asked.service == resume_service ? "resume"
                                                           : "cancel");
}

FoxgloveConnection::Frames FoxgloveConnection::call(const protocol::ServiceCall& asked) const {
  const auto refuse = [&](const std::string& why) {
    return Frames{protocol::service_failure(asked.service, asked.call, why)};
  };
  if (asked.service < plan_service || asked.service > cancel_service) return refuse("there is no such service");
  if (asked.encoding != "json") return refuse("the encoding must be json");
  try {
    return {protocol::service_response(asked.service, asked.call, answer_of(asked))};
  } catch (const std::exception& error) {
    return refuse(error.what());
  }
}

}  // namespace cairn

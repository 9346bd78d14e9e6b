#include "framework/program/view/foxglove/connection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace cairn {
namespace {

namespace protocol = foxglove_protocol;
using protocol::Level;

constexpr double kNsOfSecond = 1e9;
constexpr double kMaxStep_s = 1.0;  // so that a computer that slept does not leap
constexpr float kMinSpeed = 0.01F;
constexpr float kMaxSpeed = 100.0F;

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

FoxgloveConnection::FoxgloveConnection(const PlayedRecording& recording, bool has_control, std::string session,
                                       Plan plan)
    : recording_(recording),
      has_control_(has_control),
      session_(std::move(session)),
      plan_(std::move(plan)),
      position_ns_(recording.times.begin_ns) {}

FoxgloveConnection::Frames FoxgloveConnection::greeting() const {
  std::vector<protocol::Channel> channels;
  for (const PlayedChannel& channel : recording_.channels) channels.push_back(channel.channel);
  const auto playback = has_control_ ? std::optional(recording_.times) : std::nullopt;
  return {protocol::server_info("cairn: " + recording_.name, session_, playback), protocol::advertise(channels),
          protocol::advertise_services(services())};
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
      if (const auto id = id_of(one)) subscriptions_.erase(*id);
  } else {
    frames.push_back(protocol::status(Level::warning, "\"" + op.substr(0, 64) + "\" is not offered here"));
  }
  return frames;
}

FoxgloveConnection::Frames FoxgloveConnection::subscribe(std::uint32_t id, std::uint32_t channel) {
  const auto found =
      std::ranges::find(recording_.channels, channel, [](const PlayedChannel& played) { return played.channel.id; });
  if (found == recording_.channels.end())
    return {protocol::status(Level::error, "there is no channel " + std::to_string(channel))};
  if (subscriptions_.contains(id))
    return {protocol::status(Level::error, "subscription " + std::to_string(id) + " is there already")};
  if (subscriptions_.size() >= kMaxFoxgloveSubscriptions)
    return {protocol::status(Level::error,
                             "so many subscriptions are there already: " + std::to_string(kMaxFoxgloveSubscriptions))};
  is_begun_ = true;
  rewind(subscriptions_[id] = {&*found, 0});
  return {};
}

// To the message that shows how things stand at the position.
void FoxgloveConnection::rewind(Subscription& subscription) const {
  const auto& messages = subscription.channel->messages;
  const auto after = std::ranges::upper_bound(messages, position_ns_, {}, &PlayedMessage::time_ns);
  subscription.next = static_cast<std::size_t>(after - messages.begin());
  if (subscription.next > 0) --subscription.next;
  if (subscription.channel->is_incremental) subscription.next = 0;
}

FoxgloveConnection::Frames FoxgloveConnection::on_binary(std::string_view frame) {
  if (const auto asked = protocol::service_call_of(frame)) return call(*asked);
  const auto asked = protocol::playback_control_of(frame);
  if (asked && has_control_) return control(*asked);
  return {protocol::status(Level::error, "a binary message that is not offered here")};
}

FoxgloveConnection::Frames FoxgloveConnection::call(const protocol::ServiceCall& asked) const {
  const auto refuse = [&](const std::string& why) {
    return Frames{protocol::service_failure(asked.service, asked.call, why)};
  };
  if (asked.service < plan_service || asked.service > cancel_service) return refuse("there is no such service");
  if (asked.service != plan_service) return refuse("steering is not allowed: this is a view of what is finished");
  if (asked.encoding != "json") return refuse("the encoding must be json");
  try {
    return {protocol::service_response(asked.service, asked.call, plan_(std::string(asked.payload)))};
  } catch (const std::exception& error) {
    return refuse(error.what());
  }
}

FoxgloveConnection::Frames FoxgloveConnection::control(const protocol::PlaybackControl& asked) {
  if (!(asked.speed > 0.0F)) return {protocol::status(Level::error, "the speed of playback must be above 0")};
  speed_ = std::clamp(asked.speed, kMinSpeed, kMaxSpeed);
  if (asked.seek_ns) {
    position_ns_ = std::clamp(*asked.seek_ns, recording_.times.begin_ns, recording_.times.end_ns);
    rest_ns_ = 0.0;
    for (auto& [id, subscription] : subscriptions_) rewind(subscription);
  }
  is_playing_ = asked.is_playing;
  is_end_reported_ = position_ns_ == recording_.times.end_ns;
  is_begun_ = is_begun_ || is_playing_;
  return {state(asked.seek_ns.has_value(), asked.request)};
}

protocol::Frame FoxgloveConnection::state(bool did_seek, std::string_view request) const {
  const bool is_ended = position_ns_ == recording_.times.end_ns;
  const auto playing = is_ended      ? protocol::Playing::ended
                       : is_playing_ ? protocol::Playing::playing
                                     : protocol::Playing::paused;
  return protocol::playback_state(playing, position_ns_, speed_, did_seek, request);
}

// In the order of time. False: there was more than could be sent.
bool FoxgloveConnection::send_until(std::uint64_t time_ns, std::size_t max_bytes, std::size_t& bytes, Frames& frames) {
  while (true) {
    auto earliest = subscriptions_.end();
    for (auto one = subscriptions_.begin(); one != subscriptions_.end(); ++one) {
      const auto& [channel, next] = one->second;
      if (next == channel->messages.size() || channel->messages[next].time_ns > time_ns) continue;
      if (earliest == subscriptions_.end() ||
          channel->messages[next].time_ns < earliest->second.channel->messages[earliest->second.next].time_ns)
        earliest = one;
    }
    if (earliest == subscriptions_.end()) return true;
    if (bytes >= max_bytes) return false;
    Subscription& subscription = earliest->second;
    const PlayedMessage& message = subscription.channel->messages[subscription.next++];
    frames.push_back(protocol::message_data(earliest->first, message.time_ns, message.data));
    bytes += frames.back().bytes.size();
    position_ns_ = std::max(position_ns_, message.time_ns);
  }
}

FoxgloveConnection::Frames FoxgloveConnection::advance(double elapsed_s, std::size_t max_bytes) {
  Frames frames;
  std::size_t bytes = 0;
  const std::uint64_t end_ns = recording_.times.end_ns;
  bool is_all_sent = send_until(position_ns_, max_bytes, bytes, frames);
  if (is_all_sent && is_begun_ && is_playing_ && position_ns_ != end_ns) {
    const std::uint64_t before_ns = position_ns_;
    const double step_ns =
        rest_ns_ + kNsOfSecond * static_cast<double>(speed_) * std::clamp(elapsed_s, 0.0, kMaxStep_s);
    rest_ns_ = step_ns - std::floor(step_ns);
    const std::uint64_t target_ns = before_ns + std::min(end_ns - before_ns, static_cast<std::uint64_t>(step_ns));
    is_all_sent = send_until(target_ns, max_bytes, bytes, frames);
    if (is_all_sent) position_ns_ = target_ns;
    if (position_ns_ != before_ns) frames.push_back(protocol::time(position_ns_));
  }
  if (is_all_sent && is_begun_ && position_ns_ == end_ns && !std::exchange(is_end_reported_, true) && has_control_)
    frames.push_back(state(false, ""));
  return frames;
}

}  // namespace cairn

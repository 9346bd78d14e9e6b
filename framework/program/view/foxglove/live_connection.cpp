#include "framework/program/view/foxglove/live_connection.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace cairn {
namespace {

namespace protocol = foxglove_protocol;
using protocol::Level;

constexpr double kLargeEvery_s = 1.0;

}  // namespace

LiveConnection::LiveConnection(std::string name, std::string session, FoxgloveServices services)
    : FoxgloveConnection(std::move(services)), name_(std::move(name)), session_(std::move(session)) {}

LiveConnection::Frames LiveConnection::greeting() const {
  return greeting_of(name_, session_, std::nullopt, LiveScene::channels());
}

void LiveConnection::add(const LiveMessage& message, Frames& frames) const {
  for (const auto& [id, channel] : channel_of_)
    if (channel == message.channel) frames.push_back(protocol::message_data(id, message.time_ns, message.data));
}

std::vector<LiveMessage> LiveConnection::standing(std::uint32_t channel, Frames& frames) const {
  try {
    return scene_.standing(channel);
  } catch (const std::exception& error) {
    frames.push_back(protocol::status(Level::error, error.what()));
    return {};
  }
}

LiveConnection::Frames LiveConnection::take(std::string_view line) {
  Frames frames;
  try {
    const auto json = nlohmann::json::parse(line);
    const std::uint64_t before_ns = scene_.time_ns();
    for (const LiveMessage& message : scene_.take(json)) add(message, frames);
    if (scene_.time_ns() != before_ns) frames.push_back(protocol::time(scene_.time_ns()));
    if (!json.value("ok", true)) frames.push_back(protocol::status(Level::error, json.value("error", "refused")));
    if (json.value("ended", false)) frames.push_back(protocol::status(Level::info, "the mission has ended"));
  } catch (const std::exception& error) {
    frames.push_back(
        protocol::status(Level::error, std::string("the run's stream is not understood: ") + error.what()));
  }
  return frames;
}

LiveConnection::Frames LiveConnection::advance(double elapsed_s, std::size_t) {
  since_large_s_ += elapsed_s;
  if (since_large_s_ < kLargeEvery_s) return {};
  since_large_s_ = 0.0;
  Frames frames;
  for (const LiveChannel large : {live_map, live_driven}) {
    const bool is_asked = std::ranges::any_of(channel_of_, [&](const auto& one) { return one.second == large; });
    if (is_asked && scene_.has_changed(large))
      for (const LiveMessage& message : standing(large, frames)) add(message, frames);
  }
  return frames;
}

LiveConnection::Frames LiveConnection::subscribe(std::uint32_t id, std::uint32_t channel) {
  const bool has_channel = channel >= live_map && channel <= live_status;
  if (auto refused = refused_subscription(id, channel, has_channel, channel_of_.contains(id), channel_of_.size()))
    return {std::move(*refused)};
  channel_of_[id] = channel;
  Frames frames;
  for (const LiveMessage& message : standing(channel, frames))
    frames.push_back(protocol::message_data(id, message.time_ns, message.data));
  return frames;
}

}  // namespace cairn

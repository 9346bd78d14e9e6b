#include "framework/program/view/foxglove/playback.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace cairn {
namespace {

namespace protocol = foxglove_protocol;
using protocol::Level;

constexpr double kNsOfSecond = 1e9;
constexpr double kMaxStep_s = 1.0;  // so that a computer that slept does not leap
constexpr float kMinSpeed = 0.01F;
constexpr float kMaxSpeed = 100.0F;

}  // namespace

PlaybackConnection::PlaybackConnection(std::shared_ptr<const PlayedRecording> recording, bool has_control,
                                       std::string session, FoxgloveServices services)
    : FoxgloveConnection(std::move(services)),
      recording_(std::move(recording)),
      has_control_(has_control),
      session_(std::move(session)),
      position_ns_(recording_->times.begin_ns) {}

PlaybackConnection::Frames PlaybackConnection::greeting() const {
  std::vector<protocol::Channel> channels;
  for (const PlayedChannel& channel : recording_->channels) channels.push_back(channel.channel);
  const auto playback = has_control_ ? std::optional(recording_->times) : std::nullopt;
  return greeting_of(recording_->name, session_, playback, channels);
}

PlaybackConnection::Frames PlaybackConnection::subscribe(std::uint32_t id, std::uint32_t channel) {
  const auto found =
      std::ranges::find(recording_->channels, channel, [](const PlayedChannel& played) { return played.channel.id; });
  if (auto refused = refused_subscription(id, channel, found != recording_->channels.end(), subscriptions_.contains(id),
                                          subscriptions_.size()))
    return {std::move(*refused)};
  is_begun_ = true;
  rewind(subscriptions_[id] = {&*found, 0});
  return {};
}

// To the message that shows how things stand at the position.
void PlaybackConnection::rewind(Subscription& subscription) const {
  const auto& messages = subscription.channel->messages;
  const auto after = std::ranges::upper_bound(messages, position_ns_, {}, &PlayedMessage::time_ns);
  subscription.next = static_cast<std::size_t>(after - messages.begin());
  if (subscription.next > 0) --subscription.next;
  if (subscription.channel->is_incremental) subscription.next = 0;
}

PlaybackConnection::Frames PlaybackConnection::control(const protocol::PlaybackControl& asked) {
  if (!has_control_) return FoxgloveConnection::control(asked);
  if (!(asked.speed > 0.0F)) return {protocol::status(Level::error, "the speed of playback must be above 0")};
  speed_ = std::clamp(asked.speed, kMinSpeed, kMaxSpeed);
  if (asked.seek_ns) {
    position_ns_ = std::clamp(*asked.seek_ns, recording_->times.begin_ns, recording_->times.end_ns);
    rest_ns_ = 0.0;
    for (auto& [id, subscription] : subscriptions_) rewind(subscription);
  }
  is_playing_ = asked.is_playing;
  is_end_reported_ = position_ns_ == recording_->times.end_ns;
  is_begun_ = is_begun_ || is_playing_;
  return {state(asked.seek_ns.has_value(), asked.request)};
}

protocol::Frame PlaybackConnection::state(bool did_seek, std::string_view request) const {
  const bool is_ended = position_ns_ == recording_->times.end_ns;
  const auto playing = is_ended      ? protocol::Playing::ended
                       : is_playing_ ? protocol::Playing::playing
                                     : protocol::Playing::paused;
  return protocol::playback_state(playing, position_ns_, speed_, did_seek, request);
}

// In the order of time. False: there was more than could be sent.
bool PlaybackConnection::send_until(std::uint64_t time_ns, std::size_t max_bytes, std::size_t& bytes, Frames& frames) {
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

PlaybackConnection::Frames PlaybackConnection::advance(double elapsed_s, std::size_t max_bytes) {
  Frames frames;
  std::size_t bytes = 0;
  const std::uint64_t end_ns = recording_->times.end_ns;
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

// A viewer of Foxglove's protocol to whom a recording is played.
//
// Playback begins with the first subscription, runs by the wall clock and stops at the end. A new subscription gets the
// last message of its channel before, of landmarks all of them. Playback waits for a viewer that is slow: it never
// leaves out a message, and never queues more than it is allowed to. Not thread-safe.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "framework/program/view/foxglove/connection.hpp"
#include "framework/program/view/foxglove/recording.hpp"

namespace cairn {

class PlaybackConnection final : public FoxgloveConnection {
 public:
  // has_control: the viewer knows control of playback.
  PlaybackConnection(std::shared_ptr<const PlayedRecording> recording, bool has_control, std::string session,
                     FoxgloveServices services);

  [[nodiscard]] Frames greeting() const override;
  // Time has gone on. No more messages once these have max_bytes together.
  [[nodiscard]] Frames advance(double elapsed_s, std::size_t max_bytes) override;

  [[nodiscard]] std::uint64_t position_ns() const { return position_ns_; }

 private:
  struct Subscription {
    const PlayedChannel* channel = nullptr;
    std::size_t next = 0;  // of its messages
  };

  [[nodiscard]] Frames subscribe(std::uint32_t id, std::uint32_t channel) override;
  void unsubscribe(std::uint32_t id) override { subscriptions_.erase(id); }
  [[nodiscard]] Frames control(const foxglove_protocol::PlaybackControl& control) override;
  void rewind(Subscription& subscription) const;
  [[nodiscard]] bool send_until(std::uint64_t time_ns, std::size_t max_bytes, std::size_t& bytes, Frames& frames);
  [[nodiscard]] foxglove_protocol::Frame state(bool did_seek, std::string_view request) const;

  const std::shared_ptr<const PlayedRecording> recording_;
  const bool has_control_;
  const std::string session_;
  std::map<std::uint32_t, Subscription> subscriptions_;
  std::uint64_t position_ns_;
  double rest_ns_ = 0.0;  // of the position, below one
  float speed_ = 1.0F;
  bool is_begun_ = false;
  bool is_playing_ = true;
  bool is_end_reported_ = false;
};

}  // namespace cairn

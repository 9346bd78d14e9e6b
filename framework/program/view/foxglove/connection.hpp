// One viewer of Foxglove's protocol: what is said to it, without the network.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/program/view/foxglove/frames.hpp"

namespace cairn {

inline constexpr std::size_t kMaxFoxgloveSubscriptions = 1024;

// What viewers can call. Both throw std::exception with why it is refused.
struct FoxgloveServices {
  // The JSON of a plan to that of its answer (`POST /api/plan`).
  std::function<std::string(const std::string& request)> plan;
  // pause, resume or cancel; returns the answer of the mission's control socket.
  std::function<std::string(const std::string& command)> steer;
};

// Of a kind: a recording that is played (playback.hpp), or a run that is watched (live_connection.hpp).
class FoxgloveConnection {
 public:
  using Frames = std::vector<foxglove_protocol::Frame>;

  virtual ~FoxgloveConnection() = default;
  FoxgloveConnection(const FoxgloveConnection&) = delete;
  FoxgloveConnection& operator=(const FoxgloveConnection&) = delete;

  [[nodiscard]] virtual Frames greeting() const = 0;
  [[nodiscard]] Frames on_text(std::string_view text);
  // A call of a service may come from another thread than all else: it is answered by the services alone.
  [[nodiscard]] Frames on_binary(std::string_view frame);
  // So much wall clock has gone by. No more messages once these have max_bytes together.
  [[nodiscard]] virtual Frames advance(double elapsed_s, std::size_t max_bytes) = 0;

 protected:
  explicit FoxgloveConnection(FoxgloveServices services);

  [[nodiscard]] static Frames greeting_of(const std::string& name, const std::string& session,
                                          const std::optional<foxglove_protocol::Range>& playback,
                                          const std::vector<foxglove_protocol::Channel>& channels);
  // None: the viewer may subscribe.
  [[nodiscard]] static std::optional<foxglove_protocol::Frame> refused_subscription(
      std::uint32_t id, std::uint32_t channel, bool has_channel, bool has_subscription, std::size_t subscriptions);
  // Unless it is overridden, refused.
  [[nodiscard]] virtual Frames control(const foxglove_protocol::PlaybackControl& control);

 private:
  [[nodiscard]] virtual Frames subscribe(std::uint32_t id, std::uint32_t channel) = 0;
  virtual void unsubscribe(std::uint32_t id) = 0;
  [[nodiscard]] Frames call(const foxglove_protocol::ServiceCall& call) const;
  [[nodiscard]] std::string answer_of(const foxglove_protocol::ServiceCall& asked) const;

  const FoxgloveServices services_;
};

}  // namespace cairn

// A viewer of Foxglove's protocol who watches a run.
//
// What happens is sent as it comes to those who subscribed; map and driven path, which are large, once a second when
// they have changed. A new subscription gets how things stand. Not thread-safe.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "framework/program/view/foxglove/connection.hpp"
#include "framework/program/view/foxglove/live_scene.hpp"

namespace cairn {

class LiveConnection final : public FoxgloveConnection {
 public:
  LiveConnection(std::string name, std::string session, FoxgloveServices services);

  [[nodiscard]] Frames greeting() const override;
  // A line of the run's stream.
  [[nodiscard]] Frames take(std::string_view line);
  [[nodiscard]] Frames advance(double elapsed_s, std::size_t max_bytes) override;

 private:
  [[nodiscard]] Frames subscribe(std::uint32_t id, std::uint32_t channel) override;
  void unsubscribe(std::uint32_t id) override { channel_of_.erase(id); }
  void add(const LiveMessage& message, Frames& frames) const;
  // How a channel stands; what it cannot show is told to the viewer.
  [[nodiscard]] std::vector<LiveMessage> standing(std::uint32_t channel, Frames& frames) const;

  const std::string name_;
  const std::string session_;
  LiveScene scene_;
  std::map<std::uint32_t, std::uint32_t> channel_of_;  // a subscription
  double since_large_s_ = 0.0;
};

}  // namespace cairn

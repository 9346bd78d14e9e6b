// Near echoes of the last 15 to 30 s (once to twice kept_s): somebody who has left leaves some that no later one
// takes away.
#pragma once

#include <optional>

#include "framework/contracts/world_view.hpp"
#include "plugins/behaviours/local_map/near_echoes.hpp"

namespace cairn::behaviours {

struct RecentEchoSettings {
  double kept_s = 15.0;
  NearEchoSettings near;
  static void describe(Fields<RecentEchoSettings>& fields);
};

class RecentEchoes {
 public:
  explicit RecentEchoes(const RecentEchoSettings& settings = {}) : settings_(settings) {}
  // Every tick.
  void see(const WorldView& world);
  // All but where the robot stands.
  void forget(const WorldView& world);
  // After the first see().
  [[nodiscard]] const NearEchoes& now() const { return *now_; }

 private:
  void add(const WorldView& world);

  RecentEchoSettings settings_;
  std::optional<NearEchoes> now_;
  std::optional<NearEchoes> later_;  // will be now_
  double since_s_ = 0.0;
};

}  // namespace cairn::behaviours

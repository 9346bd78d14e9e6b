// Drives until a robot that does not know where it is in its map has found itself.
//
// It explores the map of its own that it draws until then, as `explore` does: what is new, then every edge and every
// object from near by. Success as soon as the pose is believed, at once where it is known; failure when nothing is left
// to see, when its time is up or when it has driven far enough.
#pragma once

#include <optional>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/exploring/explore.hpp"

namespace cairn::behaviours {

struct FindMyselfConfig : ExploreConfig {
  double at_most_m = 100.0;
  static void describe(Fields<FindMyselfConfig>& fields);
};

class FindMyself : public Behaviour {
 public:
  explicit FindMyself(const FindMyselfConfig& config);
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;
  [[nodiscard]] bool needs_pose() const override { return false; }

 private:
  [[nodiscard]] std::optional<Status> ended(const WorldView& world);

  FindMyselfConfig config_;
  Explore wide_;   // what is new
  Explore close_;  // and then from near by
  bool is_close_ = false;
  std::optional<double> begun_s_;
  Point at_m_{0.0, 0.0};
  double driven_m_ = 0.0;
};

}  // namespace cairn::behaviours

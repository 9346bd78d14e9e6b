// Keeps the display of a sensor up to date, and takes the orders that people give there.
#pragma once

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "framework/contracts/optional/mission_display.hpp"
#include "framework/mission/events.hpp"
#include "framework/mission/orders/orders.hpp"
#include "framework/modules/staged.hpp"

namespace cairn {

class DisplayFeed final : public Listener {
 public:
  // None: it does nothing.
  explicit DisplayFeed(const Staged<MissionDisplay>& display) : display_(display) {}

  [[nodiscard]] explicit operator bool() const { return static_cast<bool>(display_); }

  // Remembers the path that is being driven.
  void on(const Event& event, const MissionView& view) override;
  // describe: what the mission does, asked for now and then. Sentences for people: why nothing is shown any more.
  template <class Describe>
  [[nodiscard]] std::vector<std::string> show(const WorldView& world, const Twist& commanded, Describe&& describe) {
    if (!display_) return {};
    if (world.time_s - described_s_ >= kDescribeEvery_s) {
      doing_ = describe();
      described_s_ = world.time_s;
    }
    return show({world, path_, commanded, doing_});
  }
  // Before the tick of the steps. Sentences for people: what was no order.
  [[nodiscard]] std::vector<std::string> hand_orders_to(Orders& orders);

 private:
  static constexpr double kDescribeEvery_s = 0.5;

  [[nodiscard]] std::vector<std::string> show(const MissionSnapshot& snapshot);
  [[nodiscard]] std::string given_up(const std::exception& fault);

  Staged<MissionDisplay> display_;
  std::vector<Pose2> path_;
  std::string doing_;
  double described_s_ = -kDescribeEvery_s;
};

}  // namespace cairn

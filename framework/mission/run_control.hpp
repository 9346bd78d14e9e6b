// A hold on a running mission for other threads: pause, go on, cancel, give orders, and ask how it stands.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "framework/behaviour_tree/time_left.hpp"
#include "framework/contracts/localizer.hpp"
#include "framework/mission/orders/order_inbox.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn {

inline constexpr std::chrono::milliseconds kControlPollInterval(20);  // of a thread that waits

// What a signal handler can reach.
struct ControlFlags {
  std::atomic<bool> cancel{false};
  std::atomic<bool> pause{false};
};

enum class RunState : std::uint8_t { starting, running, paused, ended };
[[nodiscard]] std::string_view name_of(RunState state);

struct RunStatus {
  RunState state = RunState::starting;
  std::string mission{};
  std::size_t step = 0;  // under way, from 1; 0: none
  std::size_t steps = 0;
  std::string step_name{};
  std::string node{};   // path of the behaviour under way
  std::string doing{};  // what it says
  double time_s = 0.0;  // of the mission's clock, which stands while the mission is paused
  double paused_s = 0.0;
  double explored_ratio = 0.0;
  Pose2 T_map_robot{};
  PoseTrust trust = PoseTrust::tracking;  // lost: the pose is not one in the map
  double distance_m = 0.0;
  std::size_t landmarks = 0;
  std::optional<TimeLeft> left{};  // none: it has no steps, or has ended
  std::string outcome{};           // once it has ended
  std::string reason{};
  std::string map_file{};
};

class RunControl {
 public:
  explicit RunControl(ControlFlags& flags, std::string mission);

  [[nodiscard]] ControlFlags& flags() const { return flags_; }
  [[nodiscard]] OrderInbox& orders() { return orders_; }

  // The mission as it is at its next tick; as it was last, when that has not come within at_most.
  [[nodiscard]] RunStatus status(std::chrono::milliseconds at_most);
  // The same, once the mission is in that state or has ended.
  [[nodiscard]] RunStatus status_in(RunState wanted, std::chrono::milliseconds at_most);

  // For the mission's thread, in every tick: cheap when nobody waits. look is called when somebody does.
  void tick(const std::function<RunStatus()>& look);
  // As the mission changes its state. Once it has ended it takes no orders.
  void publish(RunStatus status);

 private:
  ControlFlags& flags_;
  OrderInbox orders_;
  std::atomic<int> waiting_{0};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t reported_ = 0;
  RunStatus last_;
};

}  // namespace cairn

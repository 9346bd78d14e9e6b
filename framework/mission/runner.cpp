#include "framework/mission/runner.hpp"

#include <atomic>
#include <cmath>
#include <functional>
#include <future>
#include <thread>

#include "framework/mission/loop/mission_loop.hpp"

namespace cairn {
namespace {

using OnWait = std::function<void(const std::string&)>;

// Reports to people what the sensor waits for, in a thread of its own: neither the module that is asked nor a terminal
// that takes nothing may hold up the thread that stops the wheels.
class WaitReporter {
 public:
  // Without on_wait nothing is reported.
  WaitReporter(std::shared_ptr<const MissionLoop> loop, OnWait on_wait) {
    if (!on_wait) return;
    thread_ = std::thread(
        [loop = std::move(loop), on_wait = std::move(on_wait), is_over = is_over_, done = std::move(done_)]() mutable {
          report(*loop, on_wait, *is_over);
          done.set_value();
        });
  }
  // Whether the thread has ended; one that is stuck is left behind.
  [[nodiscard]] bool end() {
    constexpr std::chrono::seconds kMaxWait(1);
    if (!thread_.joinable()) return true;
    *is_over_ = true;
    const bool has_ended = is_done_.wait_for(kMaxWait) == std::future_status::ready;
    if (has_ended)
      thread_.join();
    else
      thread_.detach();
    return has_ended;
  }

 private:
  static void report(const MissionLoop& loop, const OnWait& on_wait, const std::atomic<bool>& is_over) {
    for (bool is_waiting = false; !is_over; std::this_thread::sleep_for(kControlPollInterval)) {
      const std::string sentence = loop.waits_for();
      if (!sentence.empty() && !is_waiting) on_wait(sentence);
      is_waiting = !sentence.empty();
    }
  }

  std::shared_ptr<std::atomic<bool>> is_over_ = std::make_shared<std::atomic<bool>>(false);
  std::promise<void> done_;
  std::future<void> is_done_ = done_.get_future();
  std::thread thread_;
};

}  // namespace

std::string_view name_of(MissionOutcome outcome) {
  switch (outcome) {
    case MissionOutcome::done:
      return "done";
    case MissionOutcome::step_failed:
      return "step_failed";
    case MissionOutcome::out_of_time:
      return "out_of_time";
    case MissionOutcome::cancelled:
      return "cancelled";
    case MissionOutcome::sensor_fault:
      return "sensor_fault";
    case MissionOutcome::module_fault:
      return "module_fault";
    case MissionOutcome::map_not_saved:
      return "map_not_saved";
  }
  return "?";
}

MissionRunner::MissionRunner(const Mission& mission, const ModuleLibrary& library, const RunOptions& options)
    : loop_(std::make_shared<MissionLoop>(mission, library, options)),
      wall_clock_(options.wall_clock),
      control_(options.control),
      longest_call_s_(mission.config.watchdog_s),
      on_wait_(options.on_wait) {}

MissionRunner::~MissionRunner() = default;

void MissionRunner::subscribe(Listener& listener) {
  loop_->subscribe(listener);
}

const std::vector<std::string>& MissionRunner::listener_faults() const {
  return loop_->listener_faults();
}

const Pose2& MissionRunner::T_map_start() const {
  return loop_->T_map_start();
}

bool MissionRunner::has_drive() const {
  return loop_->has_drive();
}

MissionResult MissionRunner::run() {
  watch();
  if (control_ != nullptr) control_->publish(loop_->last_status());
  return loop_->result();
}

void MissionRunner::watch() {
  std::promise<void> promise;
  std::future<void> done = promise.get_future();
  // The thread shares the loop, so that a call that comes back late finds everything where it was.
  std::thread thread([loop = loop_, promise = std::move(promise)]() mutable {
    const std::shared_ptr<void> stack = alternate_stack();
    loop->run();
    promise.set_value();
  });
  WaitReporter reporter(loop_, on_wait_);
  const std::chrono::nanoseconds longest(std::llround(longest_call_s_ * 1e9));
  while (!wall_clock_->wait_for(done, kControlPollInterval) && !gave_up_) {
    loop_->stop_if_stalled();
    gave_up_ = loop_->give_up_after(longest);
  }
  if (gave_up_)
    thread.detach();
  else
    thread.join();
  gave_up_ = !reporter.end() || gave_up_ || loop_->exit_was_called_elsewhere();
}

RunStatus MissionRunner::status() const {
  return loop_->status();
}

std::vector<NodeReport> MissionRunner::node_reports() const {
  return loop_->node_reports();
}

const OccupancyGrid* MissionRunner::grid() const {
  return loop_->grid();
}
const CoarseGrid* MissionRunner::coarse_grid() const {
  return loop_->coarse_grid();
}
const LandmarkGraph& MissionRunner::graph() const {
  return loop_->graph();
}
const std::vector<Pose2>& MissionRunner::driven_path() const {
  return loop_->tracker().driven_path();
}
ClusterTree MissionRunner::clusters() const {
  return loop_->clusters();
}

std::vector<StageTime> MissionRunner::times() const {
  return loop_->times();
}

}  // namespace cairn

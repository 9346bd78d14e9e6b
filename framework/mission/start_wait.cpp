#include "framework/mission/start_wait.hpp"

#include <utility>

#include "framework/contracts/optional/wait_report.hpp"

namespace cairn {
namespace {

constexpr std::chrono::milliseconds kLookEvery(20);

}  // namespace

StartWait::StartWait(const Sensor& sensor, std::function<void(const std::string&)> on_wait,
                     std::chrono::milliseconds every)
    : sensor_(sensor), on_wait_(std::move(on_wait)), every_(every) {
  if (on_wait_ && dynamic_cast<const WaitReport*>(&sensor_) != nullptr)
    thread_ = std::jthread([this](const std::stop_token& ended) { watch(ended); });
}

void StartWait::watch(const std::stop_token& ended) {
  const auto& report = dynamic_cast<const WaitReport&>(sensor_);
  std::unique_lock lock(mutex_);
  while (!ended.stop_requested()) {
    const std::string sentence = report.waits_for();
    if (!sentence.empty()) on_wait_(sentence);
    never_.wait_for(lock, ended, sentence.empty() ? kLookEvery : every_, [] { return false; });
  }
}

}  // namespace cairn

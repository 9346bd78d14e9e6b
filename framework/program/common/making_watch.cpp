#include "framework/program/common/making_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <utility>

#include "framework/modules/making.hpp"
#include "framework/program/common/commands.hpp"

namespace cairn {
namespace {

constexpr std::chrono::milliseconds kLookEvery(20);
constexpr double kMaxAfterCancel_s = 2.0;
constexpr double kMinMaking_s = 10.0;  // a short watchdog_s is meant for calls, not for packages and nets

}  // namespace

MakingWatch::MakingWatch(const Limits& limits, End end)
    : limits_(limits), end_(std::move(end)), thread_([this](const std::stop_token& ended) { watch(ended); }) {}

void MakingWatch::watch(const std::stop_token& ended) const {
  std::optional<std::chrono::steady_clock::time_point> cancelled;
  for (; !ended.stop_requested(); std::this_thread::sleep_for(kLookEvery)) {
    const auto now = std::chrono::steady_clock::now();
    if (limits_.is_cancelled && !cancelled) cancelled = now;
    const auto making = module_being_made();
    if (!making) continue;
    if (cancelled && std::chrono::duration<double>(now - *cancelled).count() > kMaxAfterCancel_s)
      end_(fmt::format("module {} was still being made", making->module), true);
    if (limits_.max_s > 0.0 && !making->may_take_long && making->for_s > limits_.max_s)
      end_(fmt::format("module {} has not been made within {:g} s and was given up", making->module, limits_.max_s),
           false);
  }
}

double max_making_s(double watchdog_s) {
  return watchdog_s > 0.0 ? std::max(watchdog_s, kMinMaking_s) : 0.0;
}

MakingWatch watch_making(double max_s, const std::atomic<bool>& is_cancelled) {
  return MakingWatch({max_s, is_cancelled}, [](const std::string& sentence, bool by_user) {
    std::cerr << "cairn: " << sentence << "\n" << std::flush;
    std::_Exit(by_user ? kExitNotSolved : kExitBadInput);
  });
}

}  // namespace cairn

#include "framework/modules/making.hpp"

#include <chrono>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace cairn {
namespace {

using Clock = std::chrono::steady_clock;

struct Begun {
  std::string module;
  bool may_take_long = false;
  Clock::time_point at;
};

struct AllMaking {
  std::mutex mutex;
  std::map<std::thread::id, std::vector<Begun>> of_thread;  // the innermost last
};

// Never destroyed: a module's thread may outlive main().
AllMaking& all_making() {
  static auto* const all = new AllMaking;
  return *all;
}

}  // namespace

ModuleMaking::ModuleMaking(std::string module, bool may_take_long) {
  AllMaking& all = all_making();
  const std::lock_guard lock(all.mutex);
  all.of_thread[std::this_thread::get_id()].push_back({std::move(module), may_take_long, Clock::now()});
}

ModuleMaking::~ModuleMaking() {
  AllMaking& all = all_making();
  const std::lock_guard lock(all.mutex);
  const auto mine = all.of_thread.find(std::this_thread::get_id());
  mine->second.pop_back();
  if (mine->second.empty()) all.of_thread.erase(mine);
}

std::optional<ModuleBeingMade> module_being_made() {
  AllMaking& all = all_making();
  const std::lock_guard lock(all.mutex);
  const Begun* earliest = nullptr;
  for (const auto& [thread, begun] : all.of_thread)
    if (earliest == nullptr || begun.back().at < earliest->at) earliest = &begun.back();
  if (earliest == nullptr) return std::nullopt;
  const double for_s = std::chrono::duration<double>(Clock::now() - earliest->at).count();
  return ModuleBeingMade{earliest->module, for_s, earliest->may_take_long};
}

std::optional<std::string> module_being_made_here() {
  AllMaking& all = all_making();
  const std::lock_guard lock(all.mutex);
  const auto mine = all.of_thread.find(std::this_thread::get_id());
  return mine == all.of_thread.end() ? std::nullopt : std::optional(mine->second.back().module);
}

}  // namespace cairn

#include "framework/modules/making.hpp"

#include <map>
#include <mutex>
#include <thread>
#include <utility>

namespace cairn {
namespace {

thread_local const ModuleMaking* making_here = nullptr;  // the innermost

}  // namespace

struct MakingNow {
  std::mutex mutex;
  std::map<std::thread::id, const ModuleMaking*> of_thread;  // the innermost of each

  // Never destroyed: a module's thread may outlive main().
  static MakingNow& all() {
    static auto* const now = new MakingNow;
    return *now;
  }
  static const char* name_of(const ModuleMaking& making) { return making.module_.c_str(); }

  std::optional<ModuleBeingMade> longest() {
    const std::lock_guard lock(mutex);
    const ModuleMaking* first = nullptr;
    for (const auto& [thread, making] : of_thread)
      if (first == nullptr || making->begin_ < first->begin_) first = making;
    if (first == nullptr) return std::nullopt;
    const double for_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - first->begin_).count();
    return ModuleBeingMade{first->module_, for_s, first->may_take_long_};
  }
};

ModuleMaking::ModuleMaking(std::string module, bool may_take_long)
    : module_(std::move(module)), may_take_long_(may_take_long), outer_(making_here) {
  MakingNow& now = MakingNow::all();
  const std::lock_guard lock(now.mutex);
  now.of_thread[std::this_thread::get_id()] = making_here = this;
}

ModuleMaking::~ModuleMaking() {
  MakingNow& now = MakingNow::all();
  const std::lock_guard lock(now.mutex);
  making_here = outer_;
  if (outer_ == nullptr) {
    now.of_thread.erase(std::this_thread::get_id());
    return;
  }
  outer_->begin_ = std::chrono::steady_clock::now();
  now.of_thread[std::this_thread::get_id()] = outer_;
}

std::optional<ModuleBeingMade> module_being_made() {
  return MakingNow::all().longest();
}

const char* module_being_made_here() noexcept {
  return making_here == nullptr ? nullptr : MakingNow::name_of(*making_here);
}

}  // namespace cairn

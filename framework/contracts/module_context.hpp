// What the factory of a module of any kind may use; kinds that need more derive a context of their own.
#pragma once

#include <cstdint>
#include <memory>

#include "framework/contracts/plugin_kind.hpp"

namespace cairn {

struct PluginChoice;
struct RobotModel;
struct ModuleContext;

// Makes modules by name; the only means for one module to use another (a hybrid planner its path planner).
class ModuleMaker {
 public:
  virtual ~ModuleMaker() = default;
  template <class Interface>
  [[nodiscard]] std::shared_ptr<Interface> make(const PluginChoice& choice, const ContextOf<Interface>& context) const {
    return std::static_pointer_cast<Interface>(make_any(kind_of<Interface>(), choice, context));
  }

 private:
  // `context` is the one of that kind. Throws ConfigError on an unknown name (with the nearest one) or a bad field.
  [[nodiscard]] virtual std::shared_ptr<void> make_any(PluginKind kind, const PluginChoice& choice,
                                                       const ModuleContext& context) const = 0;
};

// References and pointers are valid during the call only: copy what you keep.
struct ModuleContext {
  const RobotModel& robot;
  std::uint64_t seed = 1;  // of this module alone
  const ModuleMaker* modules = nullptr;
};

}  // namespace cairn

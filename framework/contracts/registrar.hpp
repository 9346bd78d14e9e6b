// What a module registers: named factories with their settings described, one a plugin. Includes no contract.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/module_context.hpp"

namespace cairn {

struct RegisteredModule {
  PluginKind kind = PluginKind::sensor;
  std::string name;
  std::string summary;
  Schema schema;
  // The context is the one of that kind.
  std::function<std::shared_ptr<void>(const ConfigValue& config, const ModuleContext& context)> make;
};

class Registrar {
 public:
  // make: (const Config&, const ContextOf<Interface>&) -> std::unique_ptr of something that is an Interface.
  template <class Interface, class Config, class Make>
  void add(std::string name, std::string summary, Make make) {
    RegisteredModule module;
    module.kind = kind_of<Interface>();
    std::string what = "plugin " + name;
    module.name = std::move(name);
    module.summary = std::move(summary);
    module.schema = schema_of<Config>();
    module.make = [make = std::move(make), schema = module.schema, what = std::move(what)](
                      const ConfigValue& value, const ModuleContext& context) -> std::shared_ptr<void> {
      Config config;
      schema.load_into(&config, value, what);
      std::unique_ptr<Interface> object =
          make(static_cast<const Config&>(config), static_cast<const ContextOf<Interface>&>(context));
      if (!object) throw std::logic_error(what + ": its factory made nothing");
      return std::shared_ptr<Interface>(std::move(object));
    };
    modules_.push_back(std::move(module));
  }

  [[nodiscard]] const std::vector<RegisteredModule>& modules() const { return modules_; }

 private:
  std::vector<RegisteredModule> modules_;
};

// For modules without settings.
struct NoConfig {
  static void describe(Fields<NoConfig>&) {}
};

}  // namespace cairn

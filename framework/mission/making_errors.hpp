// What making modules throws, each once.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/config_errors.hpp"
#include "framework/modules/fence.hpp"

namespace cairn {

class MakingErrors {
 public:
  template <class Make>
  void attempt(Make make) {
    try {
      make();
    } catch (const ConfigError& error) {
      for (const ConfigError& one : each_of(error)) add(one.what());
    } catch (const ModuleFault& fault) {
      add(fault.what());
    }
  }
  void add(const char* error) {
    if (std::ranges::find(errors_, error) == errors_.end()) errors_.emplace_back(error);
  }
  [[nodiscard]] std::vector<std::string> take() && { return std::move(errors_); }

 private:
  std::vector<std::string> errors_;
};

}  // namespace cairn

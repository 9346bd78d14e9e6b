// Orders that people give while a mission runs. An order is written as a step of a mission is.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "framework/config/config_value.hpp"

namespace cairn {

// `stop` ends the order under way; `finish` ends the step that takes orders. The others are steps of missions.
inline constexpr std::array<std::string_view, 6> kOrderKinds{"goto", "explore", "return_home",
                                                             "name", "stop",    "finish"};

struct Order {
  std::string kind;      // one of kOrderKinds
  ConfigValue settings;  // as the step of that name takes them; an empty map where none are given
  std::string text;      // the whole order as JSON, in one line: `{"goto":"pillar"}`
};

}  // namespace cairn

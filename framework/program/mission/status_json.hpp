// How a mission stands, as JSON: on its control socket.
#pragma once

#include <nlohmann/json.hpp>

#include "framework/mission/run_control.hpp"

namespace cairn {

[[nodiscard]] nlohmann::ordered_json json_of(const RunStatus& status);

}  // namespace cairn

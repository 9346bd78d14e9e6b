// What an event says to people.
#pragma once

#include <string>

#include "framework/mission/events.hpp"

namespace cairn {

// A sentence for the report; empty: the event has none.
[[nodiscard]] std::string sentence_of(const Event& event);

}  // namespace cairn

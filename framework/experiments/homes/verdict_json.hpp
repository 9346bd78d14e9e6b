// What came of a home, as an experiment's table.json has it.
#pragma once

#include <string>

#include "framework/experiments/homes/record.hpp"
#include "framework/experiments/homes/tag_record.hpp"

namespace cairn {

[[nodiscard]] std::string json_of(const HomeVerdict& home);
[[nodiscard]] std::string json_of(const TagVerdict& tags);

}  // namespace cairn

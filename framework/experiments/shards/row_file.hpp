// What was measured of one run of an experiment, as a file beside it, so that other processes can make the table.
#pragma once

#include <string>

#include "framework/experiments/experiment.hpp"

namespace cairn {

inline constexpr const char* kRowFile = "row.json";

// All that tables, JSON, charts and exit status are made of, to the last bit; of the result no more than that. Not the
// run's folder. experiment: the fingerprint of what the run is of (experiment_fingerprint).
[[nodiscard]] std::string row_text(const ExperimentRow& row, const std::string& experiment);
// Throws std::runtime_error with a sentence, without the file's name: it is no such text, it is cut off, or it is of
// another experiment.
[[nodiscard]] ExperimentRow row_from(const std::string& text, const std::string& experiment);

}  // namespace cairn

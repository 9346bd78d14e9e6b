// How fast robots have touched things, by the truth.
#pragma once

#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"

namespace cairn {

// Markdown, a row a mission and variant: contacts, the fastest, and how many were faster than max_contact_mps. Empty
// without that limit.
[[nodiscard]] std::string contacts_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);
// Without the limit: yes.
[[nodiscard]] bool keeps_contact_limit(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

}  // namespace cairn

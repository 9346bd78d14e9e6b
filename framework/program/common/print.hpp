// What commands write to standard output: JSON with --json, else text for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/program/common/commands.hpp"

namespace cairn {

// One line; what is not UTF-8 in it is replaced.
void print_json(const nlohmann::ordered_json& json);
// The one that was asked for. The text ends with its line feed.
void print(const nlohmann::ordered_json& json, const std::string& text, const CommonOptions& common);
// The line and the warnings; with --json both on standard error, where warnings go anyway, and the object as well.
void print_report(const nlohmann::ordered_json& json, const std::string& line, const std::vector<std::string>& warnings,
                  const CommonOptions& common);

}  // namespace cairn

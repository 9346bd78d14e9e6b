#include "framework/program/map/exchange_report.hpp"

#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "maps/base/spelling.hpp"

namespace cairn {

void fail_extension(const std::filesystem::path& file, const char* verb, const std::vector<std::string>& known) {
  std::string list;
  for (const std::string& extension : known) list += (list.empty() ? "" : ", ") + extension;
  const std::string extension = file.extension().string();
  throw std::runtime_error(file.string() + ": cannot be " + verb + ": " +
                           (extension.empty() ? "it has no extension" : "unknown extension " + shown(extension)) +
                           did_you_mean(extension, known) + "; known are " + list);
}

std::vector<std::string> about(const std::filesystem::path& file, std::vector<std::string> warnings) {
  for (std::string& warning : warnings)
    if (!warning.starts_with(file.string() + ":")) warning.insert(0, file.string() + ": ");
  return warnings;
}

void print_text(const std::string& line, const std::vector<std::string>& warnings, const CommonOptions& common) {
  (common.json ? std::cerr : std::cout) << line << "\n";
  for (const std::string& warning : warnings) std::cerr << "  " << warning << "\n";
}

void print_json(const nlohmann::ordered_json& json) {
  std::cout << json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << "\n";
}

}  // namespace cairn

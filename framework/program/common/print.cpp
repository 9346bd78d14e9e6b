#include "framework/program/common/print.hpp"

#include <iostream>
#include <nlohmann/json.hpp>

namespace cairn {

void print_json(const nlohmann::ordered_json& json) {
  std::cout << json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << "\n";
}

void print(const nlohmann::ordered_json& json, const std::string& text, const CommonOptions& common) {
  if (common.json)
    print_json(json);
  else
    std::cout << text;
}

void print_report(const nlohmann::ordered_json& json, const std::string& line, const std::vector<std::string>& warnings,
                  const CommonOptions& common) {
  (common.json ? std::cerr : std::cout) << line << "\n";
  for (const std::string& warning : warnings) std::cerr << "  " << warning << "\n";
  if (common.json) print_json(json);
}

}  // namespace cairn

#include "framework/program/map/exchange_report.hpp"

#include <stdexcept>

#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"

namespace cairn {

void fail_extension(const std::filesystem::path& file, const char* verb, const std::vector<std::string>& known) {
  const std::string extension = file.extension().string();
  throw std::runtime_error(file.string() + ": cannot be " + verb + ": " +
                           (extension.empty() ? "it has no extension" : "unknown extension " + in_quotes(extension)) +
                           did_you_mean(extension, known) + "; known are " + joined(known));
}

std::vector<std::string> about(const std::filesystem::path& file, std::vector<std::string> warnings) {
  for (std::string& warning : warnings)
    if (!warning.starts_with(file.string() + ":")) warning.insert(0, file.string() + ": ");
  return warnings;
}

}  // namespace cairn

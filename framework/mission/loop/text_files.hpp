// Texts that behaviours write into the output folder.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "framework/contracts/behaviour.hpp"

namespace cairn {

class TextFiles {
 public:
  // goes_on: texts of the same mission that lie there already may be added to. Otherwise nothing of an earlier mission
  // into the same folder is left in a file.
  TextFiles(std::filesystem::path folder, bool goes_on) : folder_(std::move(folder)), goes_on_(goes_on) {}

  // Success, or failure with its reason.
  Status write(const OutputText& output);

 private:
  const std::filesystem::path folder_;
  const bool goes_on_;
  std::set<std::string> written_;
};

}  // namespace cairn

// Values of a saved map that can be read but cannot be true: a landmark at 1e18 m, a negative cost, a degree above 1.
//
// load_map() takes over what is finite and fits together. These ranges are those of what Cairn itself writes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cairn {

struct ValueFinding {
  std::string table;
  std::string row;  // the key of the row, or what has it
  std::string column;
  std::string what;  // "holds 1e+18, allowed is -1000000 to 1000000"
};

inline constexpr std::size_t kMaxFindings = 1000;  // the rest is left out

// All that are found, table by table; what cannot be read is left to salvage_map(). Throws StoreError when the file is
// no saved map of a version that is known.
[[nodiscard]] std::vector<ValueFinding> check_values(const std::filesystem::path& file);

}  // namespace cairn

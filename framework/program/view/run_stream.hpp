// The stream of a run that one who views it gets (`watch` on its control socket).
#pragma once

#include <filesystem>
#include <string>

namespace cairn {

struct RunStream {
  int descriptor = -1;  // of the one who asked, with the command said
  std::string why{};    // there is none
};
// folder: of the run's output; empty: this is the view of a map.
[[nodiscard]] RunStream watch_run(const std::filesystem::path& folder);

inline constexpr std::size_t kMaxRunLine = std::size_t{1} << 26;  // the largest: all of a large map

}  // namespace cairn

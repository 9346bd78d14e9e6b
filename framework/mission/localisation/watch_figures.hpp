// What came of watching a robot that knows its place (carried_watch.hpp), for reports.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "maps/relocalisation/pose_check.hpp"

namespace cairn {

// Readings that contradict the map, or an estimate that has jumped.
enum class DoubtCause : std::uint8_t { readings, jump };
[[nodiscard]] constexpr std::string_view name_of(DoubtCause cause) {
  return cause == DoubtCause::jump ? "jump" : "readings";
}

// A doubt of a mission under way, and what came of it; open: the mission ended before.
struct DoubtRecord {
  double begun_s = 0.0;
  DoubtCause cause = DoubtCause::readings;
  PoseCheck check;
};
// A robot that was carried while its mission was under way.
struct CarriedRecord {
  double noticed_s = 0.0;
  double distance_m = 0.0;  // driven by the mission until then
  double driven_m = 0.0;    // from the doubt until then
  std::optional<double> found_s{};
  double searched_m = 0.0;  // driven from the doubt until it was found
  Pose2 T_map_robot{};      // when it was found
};
struct WatchFigures {
  std::vector<DoubtRecord> doubts;  // the first of them
  std::size_t doubts_left_out = 0;
  std::vector<CarriedRecord> carried;

  static constexpr std::size_t kMaxDoubts = 100;  // that are kept
  void add(DoubtRecord doubt) {
    if (doubts.size() < kMaxDoubts)
      doubts.push_back(std::move(doubt));
    else
      ++doubts_left_out;
  }
};

}  // namespace cairn

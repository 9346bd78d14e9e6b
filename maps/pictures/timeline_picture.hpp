// What ran when, as a PNG: a row a thing with bars over time, and rows of marks above them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cairn {

enum class BarKind : std::uint8_t { success, failure, halted };
struct TimelineBar {
  double begin_s = 0.0;
  double end_s = 0.0;
  BarKind kind = BarKind::success;
};
struct TimelineRow {
  std::string label{};
  std::size_t depth = 0;  // how far the label is moved in
  std::vector<TimelineBar> bars{};
};

enum class MarkKind : std::uint8_t { pause, stop, bump, save };
struct TimelineMark {
  double begin_s = 0.0;
  double end_s = 0.0;
  std::string text{};  // beside it, where there is room
};
struct TimelineMarks {
  std::string label{};
  MarkKind kind = MarkKind::pause;
  std::vector<TimelineMark> marks{};
};

struct Timeline {
  std::string title{};
  std::string subtitle{};
  double begin_s = 0.0;
  double end_s = 0.0;
  std::vector<TimelineMarks> marks{};
  std::vector<TimelineRow> rows{};
};

inline constexpr std::size_t kMaxTimelineRows = 80;

// What lies outside the time is cut off. Throws std::runtime_error with the file and the reason: too many rows, or the
// file cannot be written.
void write_timeline_picture(const std::filesystem::path& file, const Timeline& timeline);

}  // namespace cairn

// Line charts as PNG files, drawn by gnuplot: degrees over time, time against size, and the like.
//
// All in one style: one font and size, the legend beside the plot, axes that begin at 0 where nothing is less.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

enum class SeriesStyle : std::uint8_t { lines, points, lines_and_points, steps };

struct Series {
  std::string name;
  std::vector<Point> points;  // (x, y); a point that is not finite leaves a gap
  SeriesStyle style = SeriesStyle::lines;
  std::vector<double> half_widths;  // of error bars, one a point; empty: none
  std::vector<Point> ends{};  // of bars that are not even, (lower, upper), one a point, joined by a line; empty: none
};

struct HorizontalLine {
  std::string name;  // e.g. tau_match
  double y = 0.0;
};

struct Chart {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Series> series;
  std::vector<HorizontalLine> horizontal_lines;  // dashed
  std::vector<std::string> x_names;              // in place of numbers, at x = 0, 1, ...
  bool of_shares = false;                        // both axes from 0 to 1
  bool of_shares_over_x = false;                 // the y axis from 0 to 1
  bool log_x = false;
  bool log_y = false;
};

// Whether the chart was drawn; if not, why, in a sentence. No gnuplot on the machine is such a reason.
struct ChartOutcome {
  bool drawn = false;
  std::string reason;
};

[[nodiscard]] ChartOutcome write_chart(const std::filesystem::path& file, const Chart& chart);

// What write_chart lets gnuplot do, for tests and for those who draw elsewhere.
[[nodiscard]] std::string gnuplot_script(const Chart& chart);

}  // namespace cairn

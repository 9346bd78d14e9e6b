#include "maps/pictures/drawing/chart.hpp"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <boost/process/io.hpp>
#include <boost/process/search_path.hpp>
#include <boost/process/system.hpp>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "maps/base/output_file.hpp"
#include "maps/base/source_text.hpp"

namespace cairn {
namespace {

using exchange::number_text;
namespace process = boost::process;

// The colours of the categories on the map pictures, in the same order.
constexpr std::array kChartColours{"#d33c4b", "#1976d2", "#388e3c", "#8e44ad",
                                   "#e69100", "#00838f", "#8d5a3c", "#c21882"};

// Filled disc, square, triangle, diamond: where the colours begin again.
constexpr std::array kMarks{7, 5, 9, 13};

constexpr const char* kHead =
    "set terminal pngcairo size 1000,560 enhanced font 'DejaVu Sans,11' background '#fafaf8'\n"
    "set encoding utf8\n"
    "set decimalsign '.'\n"
    "set border 3 linecolor '#8a949a'\n"
    "set tics nomirror textcolor '#26323a'\n"
    "set grid linecolor '#dfe3e6' linetype 1 linewidth 1\n"
    "set key outside right top textcolor '#26323a' noenhanced samplen 2\n";

// In single quotes gnuplot takes every character as it is, but for the quote itself; and a doubled one it does not take
// at the beginning of a text. So it becomes an apostrophe.
std::string gnuplot_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'')
      result += "\u2019";
    else
      result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + "'";
}

const char* style_of(SeriesStyle style) {
  switch (style) {
    case SeriesStyle::points:
      return "points pointtype 7 pointsize 0.8";
    case SeriesStyle::lines_and_points:
      return "linespoints pointtype 7 pointsize 0.7 linewidth 2";
    case SeriesStyle::steps:
      return "steps linewidth 2";
    default:
      return "lines linewidth 2";
  }
}

// A data block a series; the script has no other file to read.
std::string data_of(const Series& series, std::size_t number) {
  const bool bars = !series.half_widths.empty();
  const bool ends = !series.ends.empty();
  std::string data = fmt::format("$data{} << END_OF_DATA\n", number);
  bool any = false;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const Point& p = series.points[i];
    any = any || p.allFinite();
    if (p.allFinite()) data += fmt::format("{} {}", number_text(p.x()), number_text(p.y()));
    if (p.allFinite() && bars) data += " " + number_text(series.half_widths[i]);
    if (p.allFinite() && ends) data += " " + number_text(series.ends[i].x()) + " " + number_text(series.ends[i].y());
    data += "\n";
  }
  if (!any) data += ends ? "NaN NaN NaN NaN\n" : bars ? "NaN NaN NaN\n" : "NaN NaN\n";
  return data + "END_OF_DATA\n";
}

std::string plot_of(const Chart& chart) {
  std::string plot = "plot ";
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const bool bars = !chart.series[i].half_widths.empty();
    const std::string with = !chart.series[i].ends.empty()
                                 ? "1:2:3:4 with yerrorlines pointtype 7 pointsize 0.8 linewidth 1.5"
                             : bars ? fmt::format("1:2:3 with yerrorbars pointsize 0.9 linewidth 1.5 pointtype {}",
                                                  kMarks[i / kChartColours.size() % kMarks.size()])
                                    : fmt::format("1:2 with {}", style_of(chart.series[i].style));
    plot += fmt::format("$data{} using {} linecolor '{}' title {}, ", i, with, kChartColours[i % kChartColours.size()],
                        gnuplot_quoted(chart.series[i].name));
  }
  for (const HorizontalLine& line : chart.horizontal_lines)
    if (std::isfinite(line.y))
      plot += fmt::format("{} with lines dashtype 2 linewidth 1.5 linecolor '#5f6b73' title {}, ", number_text(line.y),
                          gnuplot_quoted(line.name));
  return plot + "NaN notitle\n";
}

// Whether an axis begins at 0: it shows numbers, none of them below.
bool begins_at_zero(const Chart& chart, Eigen::Index axis) {
  const auto is_less = [axis](const Point& p) { return p.allFinite() && p[axis] < 0.0; };
  const bool line_is_less =
      axis == 1 && std::ranges::any_of(chart.horizontal_lines, [](const HorizontalLine& line) { return line.y < 0.0; });
  return !line_is_less && std::ranges::none_of(chart.series, [&](const Series& series) {
    // The ends of bars are both of the y axis.
    const bool end_is_less =
        axis == 1 && std::ranges::any_of(series.ends, [](const Point& ends) { return ends.x() < 0.0; });
    return end_is_less || std::ranges::any_of(series.points, is_less);
  });
}

std::string axes_of(const Chart& chart) {
  const bool y_is_share = chart.of_shares || chart.of_shares_over_x;
  const bool x_from_zero = chart.x_names.empty() && !chart.log_x && !chart.of_shares && begins_at_zero(chart, 0);
  const bool y_from_zero = !chart.log_y && !y_is_share && begins_at_zero(chart, 1);
  std::string axes;
  if (chart.of_shares) axes += "set xrange [0:1.01]\n";
  if (x_from_zero) axes += "set xrange [0:*]\n";
  if (y_is_share) axes += "set yrange [0:1.01]\n";
  if (y_from_zero) axes += "set yrange [0:*]\n";
  // Room beyond what is drawn, but not where an axis has a fixed end.
  axes += std::string("set offsets 0, ") + (chart.x_names.empty() && !chart.of_shares ? "graph 0.02" : "0") + ", " +
          (y_is_share ? "0" : "graph 0.05") + ", " + (y_is_share || y_from_zero ? "0" : "graph 0.02") + "\n";
  if (chart.log_x) axes += "set logscale x\n";
  if (chart.log_y) axes += "set logscale y\n";
  return axes;
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// The script and gnuplot's complaints go through memory, not pipes: neither side ever waits for the
// other, and a gnuplot that dies early sends no signal here.
File memory_file(const char* name) {
  return File(::fdopen(::memfd_create(name, MFD_CLOEXEC), "w+"));
}

std::string bytes_of(std::FILE* file) {
  std::string bytes;
  std::array<char, 65536> block{};
  std::rewind(file);
  while (const std::size_t got = std::fread(block.data(), 1, block.size(), file)) bytes.append(block.data(), got);
  return bytes;
}

std::string first_line_of(std::FILE* file) {
  std::rewind(file);
  std::string text(300, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  const std::size_t start = std::min(text.find_first_not_of("\n "), text.size());
  return text.substr(start, text.find('\n', start) - start);
}

ChartOutcome failed(const std::string& what, int error) {
  return {false, what + ": " + std::strerror(error)};
}

// gnuplot -d reads no start-up files of whoever runs it.
ChartOutcome run_gnuplot(const std::string& script_text, std::FILE* picture) {
  const File script = memory_file("chart script");
  const File complaints = memory_file("chart complaints");
  if (!script || !complaints || std::fputs(script_text.c_str(), script.get()) < 0)
    return failed("no memory for a chart", errno);
  std::rewind(script.get());
  const boost::filesystem::path gnuplot = process::search_path("gnuplot");
  if (gnuplot.empty()) return {false, "gnuplot is not installed, charts need it (package gnuplot-nox)"};
  std::error_code error;
  const int status = process::system(gnuplot, "-d", (process::std_in < script.get()), (process::std_out > picture),
                                     (process::std_err > complaints.get()), error);
  if (error) return {false, "gnuplot cannot be started: " + error.message()};
  return status == 0 ? ChartOutcome{true, ""}
                     : ChartOutcome{false, "gnuplot failed: " + first_line_of(complaints.get())};
}

}  // namespace

std::string gnuplot_script(const Chart& chart) {
  std::string script = kHead;
  script += fmt::format("set title {} noenhanced font ',14' textcolor '#26323a'\n", gnuplot_quoted(chart.title));
  script += fmt::format("set xlabel {} noenhanced textcolor '#26323a'\n", gnuplot_quoted(chart.x_label));
  script += fmt::format("set ylabel {} noenhanced textcolor '#26323a'\n", gnuplot_quoted(chart.y_label));
  if (!chart.x_names.empty()) {
    script += fmt::format("set xrange [-0.5:{}]\nset xtics rotate by -20 noenhanced (",
                          number_text(static_cast<double>(chart.x_names.size()) - 0.5));
    for (std::size_t i = 0; i < chart.x_names.size(); ++i)
      script += fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_quoted(chart.x_names[i]), i);
    script += ")\n";
  }
  script += axes_of(chart);
  for (std::size_t i = 0; i < chart.series.size(); ++i) script += data_of(chart.series[i], i);
  return script + plot_of(chart);
}

ChartOutcome write_chart(const std::filesystem::path& file, const Chart& chart) {
  const File picture = memory_file("chart");
  if (!picture) return failed("no memory for a chart", errno);
  ChartOutcome outcome = run_gnuplot(gnuplot_script(chart), picture.get());
  if (!outcome.drawn) return outcome;
  const std::string bytes = bytes_of(picture.get());
  if (bytes.empty()) return {false, "gnuplot drew nothing"};
  try {
    replace_file(file, bytes);
  } catch (const OutputError& error) {
    return {false, file.string() + " " + error.what()};
  }
  return outcome;
}

}  // namespace cairn

#include "maps/pictures/drawing/chart.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "maps/base/source_text.hpp"

extern char** environ;

namespace cairn {
namespace {

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
    "set key outside right top textcolor '#26323a' noenhanced samplen 2\n"
    "set offsets graph 0, 0, graph 0.05, graph 0.02\n";

// In single quotes gnuplot takes every character as it is, but for the quote itself; and a doubled one it does not take
// at the beginning of a text. So it becomes an apostrophe.
std::string quoted(const std::string& text) {
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
  std::string data = "$data" + std::to_string(number) + " << END_OF_DATA\n";
  bool any = false;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const Point& p = series.points[i];
    any = any || p.allFinite();
    if (p.allFinite())
      data += exchange::number_text(p.x()) + " " + exchange::number_text(p.y()) +
              (bars ? " " + exchange::number_text(series.half_widths[i]) : "");
    data += "\n";
  }
  if (!any) data += bars ? "NaN NaN NaN\n" : "NaN NaN\n";
  return data + "END_OF_DATA\n";
}

std::string plot_of(const Chart& chart) {
  std::string plot = "plot ";
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const bool bars = !chart.series[i].half_widths.empty();
    plot += "$data" + std::to_string(i) +
            (bars ? " using 1:2:3 with yerrorbars pointsize 0.9 linewidth 1.5 pointtype " +
                        std::to_string(kMarks[i / kChartColours.size() % kMarks.size()])
                  : std::string(" using 1:2 with ") + style_of(chart.series[i].style)) +
            " linecolor '" + kChartColours[i % kChartColours.size()] + "' title " + quoted(chart.series[i].name) + ", ";
  }
  for (const HorizontalLine& line : chart.horizontal_lines)
    if (std::isfinite(line.y))
      plot += exchange::number_text(line.y) + " with lines dashtype 2 linewidth 1.5 linecolor '#5f6b73' title " +
              quoted(line.name) + ", ";
  return plot + "NaN notitle\n";
}

// The script and gnuplot's complaints go through memory, not pipes: neither side ever waits for the
// other, and a gnuplot that dies early sends no signal here.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : fd_(::memfd_create(name, MFD_CLOEXEC)) {}
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int fd() const { return fd_; }
  [[nodiscard]] bool fill(const std::string& text) const {
    return ::write(fd_, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
           ::lseek(fd_, 0, SEEK_SET) == 0;
  }
  [[nodiscard]] std::string first_line() const {
    std::string text(300, '\0');
    const ssize_t size = ::pread(fd_, text.data(), text.size(), 0);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    const std::size_t start = std::min(text.find_first_not_of("\n "), text.size());
    return text.substr(start, text.find('\n', start) - start);
  }

 private:
  int fd_;
};

// gnuplot -d reads no start-up files of whoever runs it. Returns 0 or the error that kept it from starting.
int start_gnuplot(int script, int picture, int complaints, pid_t& child) {
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, script, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, picture, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, complaints, STDERR_FILENO);
  std::array<char*, 3> arguments{const_cast<char*>("gnuplot"), const_cast<char*>("-d"), nullptr};
  const int error = ::posix_spawnp(&child, "gnuplot", &files, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  return error;
}

ChartOutcome failed(const std::string& what, int error) {
  return {false, what + ": " + std::strerror(error)};
}

ChartOutcome run_gnuplot(const std::string& script_text, int picture) {
  const MemoryFile script("chart script");
  const MemoryFile complaints("chart complaints");
  if (script.fd() < 0 || complaints.fd() < 0 || !script.fill(script_text))
    return failed("no memory for a chart", errno);
  pid_t child = 0;
  const int error = start_gnuplot(script.fd(), picture, complaints.fd(), child);
  if (error == ENOENT) return {false, "gnuplot is not installed, charts need it (package gnuplot-nox)"};
  if (error != 0) return failed("gnuplot cannot be started", error);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return failed("gnuplot was lost", errno);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {true, ""};
  return {false, "gnuplot failed: " + complaints.first_line()};
}

}  // namespace

std::string gnuplot_script(const Chart& chart) {
  std::string script = kHead;
  script += "set title " + quoted(chart.title) + " noenhanced font ',14' textcolor '#26323a'\n";
  script += "set xlabel " + quoted(chart.x_label) + " noenhanced textcolor '#26323a'\n";
  script += "set ylabel " + quoted(chart.y_label) + " noenhanced textcolor '#26323a'\n";
  if (!chart.x_names.empty()) {
    script += "set xrange [-0.5:" + exchange::number_text(static_cast<double>(chart.x_names.size()) - 0.5) +
              "]\nset xtics rotate by -20 noenhanced (";
    for (std::size_t i = 0; i < chart.x_names.size(); ++i)
      script += (i == 0 ? "" : ", ") + quoted(chart.x_names[i]) + " " + std::to_string(i);
    script += ")\n";
  }
  if (chart.of_shares) script += "set xrange [0:1.01]\nset yrange [0:1.01]\n";
  if (chart.log_x) script += "set logscale x\n";
  if (chart.log_y) script += "set logscale y\n";
  for (std::size_t i = 0; i < chart.series.size(); ++i) script += data_of(chart.series[i], i);
  return script + plot_of(chart);
}

ChartOutcome write_chart(const std::filesystem::path& file, const Chart& chart) {
  const int picture = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (picture < 0) return failed(file.string() + " cannot be written", errno);
  ChartOutcome outcome = run_gnuplot(gnuplot_script(chart), picture);
  ::close(picture);
  std::error_code ignored;
  if (outcome.drawn && std::filesystem::file_size(file, ignored) == 0) outcome = {false, "gnuplot drew nothing"};
  if (!outcome.drawn) std::filesystem::remove(file, ignored);
  return outcome;
}

}  // namespace cairn

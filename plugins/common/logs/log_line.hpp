// A line of a log cut into words, its words asked for as what they must be.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/config_value.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn::log_common {

// Farther than any recorded robot or echo; what is beyond is a broken number, not a place.
inline constexpr double kFarthest_m = 1e5;

// A number as logs write it ("+3.5", "nan", "inf", "1.#INF" too); false when the text is anything else or the
// number fits no double.
[[nodiscard]] bool read_number(std::string_view text, double& value);

class LogLine {
 public:
  explicit LogLine(std::string file) : file_(std::move(file)) {}

  // Cuts another line at blanks, or at a separator and then without the blanks around the words; the text must outlive
  // the words.
  void cut(std::string_view text, int line, std::optional<char> separator = {});

  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] std::size_t size() const { return words_.size(); }
  [[nodiscard]] std::string_view word(std::size_t i) const { return words_[i]; }
  // Where a word stands, or where it would have to begin.
  [[nodiscard]] SourcePlace place(std::size_t i) const;

  // All of these throw ConfigError at the word; what: what it is for people.
  [[nodiscard]] double number(std::size_t i, std::string_view what) const;
  [[nodiscard]] double finite(std::size_t i, std::string_view what) const;
  // Within +-kFarthest_m.
  [[nodiscard]] double metres(std::size_t i, std::string_view what) const;
  // Radians, within some hundred thousand turns of 0, as written.
  [[nodiscard]] double heading(std::size_t i) const;
  // x, y and heading in three words, the heading wrapped.
  [[nodiscard]] Pose2 pose(std::size_t i) const;
  // Any number; one beyond kFarthest_m is infinite: logs write such for "no echo".
  [[nodiscard]] double range_m(std::size_t i) const;
  // So many of them, `step` words apart.
  [[nodiscard]] std::vector<double> ranges_m(std::size_t first, std::size_t count, std::size_t step = 1) const;
  // A whole number from 0 to 1,000,000.
  [[nodiscard]] std::size_t count(std::size_t i, std::string_view what) const;

 private:
  std::string file_;
  std::string_view text_;
  int line_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace cairn::log_common

// About how long something still takes.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace cairn {

struct TimeLeft {
  double about_s = 0.0;                                    // of all that can be said
  double max_s = std::numeric_limits<double>::infinity();  // it has ended by then; infinite: nothing says so
  std::vector<std::string> without{};  // kinds of nodes of which nothing is known: what they take comes on top
};

// Once, however often it is published.
void add_unknown(TimeLeft& left, const std::string& what);
// Both, one after the other.
[[nodiscard]] TimeLeft one_after_other(TimeLeft first, const TimeLeft& then);
// At most so long.
[[nodiscard]] TimeLeft cut(TimeLeft left, double max_s);

// "about 80 s left", "about 80 s left; goto, save not counted", "time left unknown, at most 900 s".
[[nodiscard]] std::string text_of(const TimeLeft& left);

}  // namespace cairn

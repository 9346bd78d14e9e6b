#include "framework/behaviour_tree/time_left.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "maps/base/text.hpp"

namespace cairn {

void add_unknown(TimeLeft& left, const std::string& what) {
  if (std::find(left.without.begin(), left.without.end(), what) == left.without.end()) left.without.push_back(what);
}

TimeLeft one_after_other(TimeLeft first, const TimeLeft& then) {
  first.about_s += then.about_s;
  first.max_s += then.max_s;
  for (const std::string& what : then.without) add_unknown(first, what);
  return first;
}

TimeLeft cut(TimeLeft left, double max_s) {
  left.max_s = std::min(left.max_s, std::max(0.0, max_s));
  left.about_s = std::min(left.about_s, left.max_s);
  return left;
}

std::string text_of(const TimeLeft& left) {
  const std::string without = joined(left.without);
  const bool is_known = without.empty() || left.about_s >= 0.5;
  std::string text = is_known ? fmt::format("about {:.0f} s left", left.about_s) : std::string("time left unknown");
  if (is_known && !without.empty()) text += "; " + without + " not counted";
  return is_known || !std::isfinite(left.max_s) ? text : text + fmt::format(", at most {:.0f} s", left.max_s);
}

}  // namespace cairn

#include "maps/base/spelling.hpp"

#include <algorithm>

#include "maps/base/printable.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

constexpr std::size_t kShownBytes = 60;
constexpr std::size_t kLongestComparedName = 64;

// Optimal string alignment distance: insertion, deletion, change, swap of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  if (name.empty() || name.size() > kLongestComparedName) return "";
  const std::string wanted = lower_case(name);
  std::size_t allowed = std::max<std::size_t>(1, wanted.size() / 3);
  std::string nearest;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kLongestComparedName) continue;
    std::size_t distance = edit_distance(wanted, lower_case(candidate));
    // A forgotten unit ("angle" for "angle_deg") is one mistake, however long the unit.
    if (wanted.size() >= 2 && candidate.starts_with(wanted + "_")) distance = 1;
    if (distance > allowed || (distance == allowed && !nearest.empty())) continue;
    allowed = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : " (did you mean " + in_quotes(nearest) + "?)";
}

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  std::size_t end = std::min(text.size(), kShownBytes);
  // Not in the middle of a UTF-8 character.
  while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  for (const std::string_view shown = text.substr(0, end); const char c : printable(shown, "\n")) {
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  }
  return out + (end < text.size() ? "...\"" : "\"");
}

}  // namespace cairn

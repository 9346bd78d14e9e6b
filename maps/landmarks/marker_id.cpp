#include "maps/landmarks/marker_id.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>

namespace cairn {
namespace {

constexpr std::string_view kTag = "tag ";

std::optional<int> marker_number_in(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

}  // namespace

std::optional<MarkerFamily> marker_family_of(std::string_view name) {
  const auto* const found =
      std::ranges::find_if(kMarkerFamilies, [&](MarkerFamily family) { return name_of(family) == name; });
  return found == std::end(kMarkerFamilies) ? std::nullopt : std::optional(*found);
}

std::string text_of(const MarkerId& marker) {
  std::string text(kTag);
  if (marker.family != MarkerFamily::tag36h11) text.append(name_of(marker.family)).append(" ");
  return text.append(std::to_string(marker.number));
}

std::optional<MarkerName> marker_name_in(std::string_view text) {
  if (!text.starts_with(kTag)) return std::nullopt;
  text.remove_prefix(kTag.size());
  std::optional<MarkerFamily> family;
  if (const std::size_t blank = text.find(' '); blank != std::string_view::npos) {
    family = marker_family_of(text.substr(0, blank));
    if (!family) return std::nullopt;
    text.remove_prefix(blank + 1);
  }
  const std::optional<int> number = marker_number_in(text);
  return number ? std::optional(MarkerName{family, *number}) : std::nullopt;
}

std::string number_fault(int number, std::span<const MarkerFamily> families) {
  std::string numbers;
  for (const MarkerFamily family : families) {
    if (number < count_of(family)) return {};
    if (!numbers.empty()) numbers += ", ";
    numbers.append(name_of(family)).append(" has 0 to ").append(std::to_string(count_of(family) - 1));
  }
  return numbers;
}

std::string marker_name_fault(std::string_view text) {
  const std::optional<MarkerName> name = marker_name_in(text);
  if (!name) return {};
  const std::string numbers = name->family ? number_fault(name->number, std::span(&*name->family, 1))
                                           : number_fault(name->number, kMarkerFamilies);
  return numbers.empty() ? numbers : "there is no such tag: " + numbers;
}

}  // namespace cairn

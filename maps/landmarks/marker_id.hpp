// Which printed tag (AprilTag) it is: its family and its number.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cairn {

enum class MarkerFamily : std::uint8_t { tag36h11, tag25h9, tagStandard41h12 };
inline constexpr MarkerFamily kMarkerFamilies[] = {MarkerFamily::tag36h11, MarkerFamily::tag25h9,
                                                   MarkerFamily::tagStandard41h12};
// As robot files, worlds, missions and maps write it.
[[nodiscard]] constexpr std::string_view name_of(MarkerFamily family) {
  switch (family) {
    case MarkerFamily::tag36h11:
      return "36h11";
    case MarkerFamily::tag25h9:
      return "25h9";
    case MarkerFamily::tagStandard41h12:
      return "standard41h12";
  }
  return "?";
}

// How many markers a family has: their numbers are 0 to one less.
[[nodiscard]] constexpr int count_of(MarkerFamily family) {
  switch (family) {
    case MarkerFamily::tag36h11:
      return 587;
    case MarkerFamily::tag25h9:
      return 35;
    case MarkerFamily::tagStandard41h12:
      return 2115;
  }
  return 0;
}

// Numbers are unique within a family only.
struct MarkerId {
  MarkerFamily family = MarkerFamily::tag36h11;
  int number = 0;
  auto operator<=>(const MarkerId&) const = default;
};

[[nodiscard]] std::optional<MarkerFamily> marker_family_of(std::string_view name);
// "tag 7"; of another family than 36h11 "tag 25h9 7".
[[nodiscard]] std::string text_of(const MarkerId& marker);

// A marker as people name it: "tag 7" is one of any family, the first that there is in the order above.
struct MarkerName {
  std::optional<MarkerFamily> family;
  int number = 0;
};
[[nodiscard]] std::optional<MarkerName> marker_name_in(std::string_view text);

// Why none of the families has a marker of that number: "36h11 has 0 to 586, 25h9 has 0 to 34". Empty: one has.
[[nodiscard]] std::string number_fault(int number, std::span<const MarkerFamily> families);
// Why a text that names a marker names one that cannot be; empty: it can, or the text names no marker.
[[nodiscard]] std::string marker_name_fault(std::string_view text);

}  // namespace cairn

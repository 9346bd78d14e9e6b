// Landmarks whose category has won by a hair.
#pragma once

#include <optional>
#include <string>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// Two degrees of one matching that are nearer than this say little of which category it is.
inline constexpr double kCloseDegrees = 0.05;

// What the last matching at a landmark's place has said of its category and of the next best one.
struct CloseCategories {
  std::string category, other;
  double degree = 0.0, other_degree = 0.0;
  bool operator==(const CloseCategories&) const = default;
};
// None where the category is clear, and of a landmark without evidence (an imported place).
[[nodiscard]] std::optional<CloseCategories> close_categories(const Landmark& landmark);

// "0.71", or "0.74, close: square 0.71, circle 0.69".
[[nodiscard]] std::string degree_text(const Landmark& landmark);
// "square 0.71, circle 0.69", or an empty text where the category is clear.
[[nodiscard]] std::string close_text(const Landmark& landmark);

}  // namespace cairn

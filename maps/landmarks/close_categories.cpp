#include "maps/landmarks/close_categories.hpp"

#include <fmt/format.h>

namespace cairn {

std::optional<CloseCategories> close_categories(const Landmark& landmark) {
  const CategoryEvidence* own = nullptr;
  const CategoryEvidence* other = nullptr;
  for (const CategoryEvidence& evidence : landmark.evidence) {
    if (evidence.category == landmark.category)
      own = &evidence;
    else if (other == nullptr || evidence.last_degree > other->last_degree)
      other = &evidence;
  }
  if (own == nullptr || other == nullptr || own->last_degree <= 0.0 || other->last_degree <= 0.0) return std::nullopt;
  if (own->last_degree - other->last_degree >= kCloseDegrees) return std::nullopt;
  return CloseCategories{own->category, other->category, own->last_degree, other->last_degree};
}

std::string close_text(const Landmark& landmark) {
  const std::optional<CloseCategories> close = close_categories(landmark);
  if (!close) return "";
  return fmt::format("{} {:.2f}, {} {:.2f}", close->category, close->degree, close->other, close->other_degree);
}

std::string degree_text(const Landmark& landmark) {
  const std::string close = close_text(landmark);
  return fmt::format("{:.2f}{}", landmark.degree, close.empty() ? "" : ", close: " + close);
}

}  // namespace cairn

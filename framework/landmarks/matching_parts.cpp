#include "framework/landmarks/matching_parts.hpp"

#include <algorithm>

namespace cairn {
namespace {

// Best first, and that of the detection before all others; a detector that reports none says it by its detection.
std::vector<CategoryDegree> fitting_degrees(const Matching& matching) {
  std::vector<CategoryDegree> degrees;
  std::ranges::copy_if(matching.degrees, std::back_inserter(degrees), &CategoryDegree::fits);
  std::ranges::stable_sort(degrees, std::greater{}, &CategoryDegree::degree);
  if (!matching.detection) return degrees;
  const auto& [category, T_map_landmark, degree, templates] = *matching.detection;
  const auto own = std::ranges::find(degrees, category, &CategoryDegree::category);
  if (own == degrees.end())
    degrees.insert(degrees.begin(), {category, degree, T_map_landmark.theta_rad, T_map_landmark.position()});
  else
    std::rotate(degrees.begin(), own, own + 1);
  return degrees;
}

std::vector<TemplateDegree> templates_of(const Detection& detection, const std::vector<CategoryDegree>& degrees) {
  std::vector<TemplateDegree> own;
  std::ranges::copy_if(detection.templates, std::back_inserter(own), [&](const TemplateDegree& t) {
    return std::ranges::find(degrees, t.category, &CategoryDegree::category) != degrees.end();
  });
  return own;
}

}  // namespace

Point place_of(const Matching& part) {
  return part.detection ? part.detection->T_map_landmark.position() : part.degrees.front().at_m;
}

std::vector<Matching> parts_of(const Matching& matching, double apart_m) {
  std::vector<Matching> parts;
  for (const CategoryDegree& degree : fitting_degrees(matching)) {
    const auto there = std::ranges::find_if(
        parts, [&](const Matching& part) { return (place_of(part) - degree.at_m).norm() <= apart_m; });
    Matching& part = there != parts.end() ? *there : parts.emplace_back();
    part.degrees.push_back(degree);
    if (parts.size() == 1 && part.degrees.size() == 1) part.detection = matching.detection;
  }
  if (!matching.detection) return parts;
  for (Matching& part : parts) part.templates = templates_of(*matching.detection, part.degrees);
  parts.front().detection->templates = parts.front().templates;
  return parts;
}

}  // namespace cairn

// Which categories of a template set are mistaken for which, tried out: each shape is sensed and mapped
// alone, at each of its orientations and half a step further, and shown to the detector.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/modules/module_library.hpp"
#include "framework/templates/landmark_orbit.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cairn {

// One shape shown to the detector once.
struct TemplateView {
  std::string shown;
  double orientation_rad = 0.0;
  std::string found;    // empty: nothing was recognised
  double degree = 0.0;  // of the category found, or the best of all
  std::string rival;    // the best other category, where the answer is wrong; may be empty
  double rival_degree = 0.0;
  double right_degree = 0.0;           // the best of the category shown
  double orientation_error_rad = 0.0;  // of a right answer; 0 for round shapes
  [[nodiscard]] bool is_right() const { return found == shown; }
};

struct TemplateCheck {
  std::vector<std::string> categories;
  std::vector<TemplateView> views;  // by category, then orientation
  std::vector<std::string> advice;  // sentences for people

  // How often a category was taken for which; "" stands for nothing recognised.
  [[nodiscard]] std::map<std::string, int> found_for(const std::string& category) const;
  [[nodiscard]] bool has_mistakes() const;  // one category taken for another
};

struct CheckedDetector {
  PluginChoice quick;     // may leave out degrees of what it does not recognise
  PluginChoice thorough;  // the same with all degrees, asked about wrong answers only
};

// Throws what the modules throw. Time: an orbit and its matchings for every view.
[[nodiscard]] TemplateCheck check_templates(const std::shared_ptr<const TemplateSet>& set,
                                            const CheckedDetector& detector, const OrbitCrew& crew);

// How far the outlines lie apart where they differ most, when one is laid upon the other as well as can be
// (turned in whole degrees about their centres).
[[nodiscard]] double outline_difference_m(const Contour& a, const Contour& b);

}  // namespace cairn

// Whether two template sets are of one landmark, as a likelihood ratio (docs/method.md 8.2).
//
// A degree is one minus the mean mismatch, so exp(degree / degree_scale) is a likelihood, and the degrees of a set give
// a probability to each category and to each orientation of a category. Two sets agree by
//
//   sum over templates t of P_a(t) P_b(t) / P(t)
//
// which is p(a, b | one landmark) / (p(a) p(b)) where both are independent given the template. P(t) is uniform. Two
// orientations are the same template as far as the compass lets one know. A set is chance with some probability, the
// less the more matchings stand behind it: that is how an early category gives way.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/contracts/detector.hpp"
#include "framework/landmarks/config.hpp"
#include "maps/geometry/contour.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

struct OrientationBelief {
  double orientation_rad = 0.0;
  double probability = 0.0;  // of this orientation, given the category
};
struct CategoryBelief {
  std::string category;
  double probability = 0.0;
  std::vector<OrientationBelief> orientations;  // none: anyhow
};
struct TemplateBelief {
  std::vector<CategoryBelief> categories;
  double chance = 0.0;  // that it says nothing
};

class TemplateSets {
 public:
  TemplateSets(const LandmarksConfig& config, const std::vector<LandmarkShape>& shapes);

  // Of what a matching shows at one place (parts_of()).
  [[nodiscard]] TemplateBelief belief_of(const Matching& matching) const;
  // Of a landmark's evidence and templates.
  [[nodiscard]] TemplateBelief belief_of(const Landmark& landmark) const;
  // Log of the likelihood ratio "of one landmark" to "of two, independent of each other". heading_variance_rad2: of the
  // robot's heading between the two.
  [[nodiscard]] double log_agreement(const TemplateBelief& a, const TemplateBelief& b,
                                     double heading_variance_rad2) const;

 private:
  [[nodiscard]] double orientation_ratio(const CategoryBelief& a, const CategoryBelief& b,
                                         double heading_variance_rad2) const;

  LandmarksConfig config_;
  std::map<std::string, double> period_rad_;  // a category's orientations repeat after this; 0: it has only one
};

}  // namespace cairn

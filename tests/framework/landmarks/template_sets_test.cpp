#include "framework/landmarks/template_sets.hpp"

#include <gtest/gtest.h>

#include "framework/landmarks/evidence.hpp"

namespace cairn {
namespace {

class TemplateSetsTest : public testing::Test {
 protected:
  TemplateSets sets_{{},
                     {{"circle", Contour::circle(0.5)},
                      {"square", Contour::polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}})},
                      {"triangle", Contour::polygon({{0, 0}, {0.6, 0}, {0.3, 0.52}})}}};

  static Matching part(const std::string& category, double angle_deg, double degree = 0.8) {
    Matching matching;
    matching.degrees = {{category, degree, radians(angle_deg), {0.0, 0.0}}};
    matching.templates = {{category, radians(angle_deg), degree}, {category, radians(angle_deg + 15.0), degree - 0.05}};
    matching.detection = Detection{category, {0.0, 0.0, radians(angle_deg)}, degree, matching.templates};
    return matching;
  }

  static Landmark landmark(const std::string& category, double angle_deg, int matchings) {
    Landmark seen;
    seen.category = category;
    for (int i = 0; i < matchings; ++i) add_evidence(seen, part(category, angle_deg), 1.0);
    return seen;
  }

  double agreement(const Matching& matching, const Landmark& landmark, double heading_deg = 0.0) const {
    return sets_.log_agreement(sets_.belief_of(matching), sets_.belief_of(landmark),
                               radians(heading_deg) * radians(heading_deg));
  }
};

TEST_F(TemplateSetsTest, TheSameTemplatesSpeakForOneLandmarkAndOtherCategoriesAgainst) {
  EXPECT_GT(agreement(part("square", 15.0), landmark("square", 15.0, 10)), 1.5);
  EXPECT_LT(agreement(part("circle", 0.0), landmark("square", 15.0, 10)), -1.5);
}

TEST_F(TemplateSetsTest, TheSameShapeTurnedByThirtyDegreesIsAnotherTemplate) {
  EXPECT_LT(agreement(part("square", 45.0), landmark("square", 15.0, 10)), 0.0);
  EXPECT_NEAR(agreement(part("square", 105.0), landmark("square", 15.0, 10)),
              agreement(part("square", 15.0), landmark("square", 15.0, 10)), 1e-9)
      << "a square repeats after 90 degrees";
  EXPECT_LT(agreement(part("triangle", 75.0), landmark("triangle", 15.0, 10)), 0.0);
}

TEST_F(TemplateSetsTest, WithoutACompassATurnSaysLittle) {
  const double turned = agreement(part("square", 45.0), landmark("square", 15.0, 10), 60.0);
  EXPECT_NEAR(turned, agreement(part("square", 15.0), landmark("square", 15.0, 10), 60.0), 0.3);
  EXPECT_GT(turned, 0.5) << "the category still agrees";
}

TEST_F(TemplateSetsTest, AnEarlyCategoryCountsLessThanALateOne) {
  const double early = agreement(part("circle", 0.0), landmark("square", 15.0, 1));
  const double late = agreement(part("circle", 0.0), landmark("square", 15.0, 20));
  EXPECT_GT(early, -2.0);
  EXPECT_LT(late, early - 1.0);
}

TEST_F(TemplateSetsTest, CategoriesThatFitNearlyAlikeAreNotToldApart) {
  Matching unsure = part("square", 15.0);
  unsure.degrees.push_back({"circle", 0.795, 0.0, {0.0, 0.0}});
  EXPECT_GT(agreement(unsure, landmark("circle", 0.0, 10)), -0.5);
  EXPECT_LT(agreement(part("square", 15.0), landmark("circle", 0.0, 10)), -1.5);
}

TEST_F(TemplateSetsTest, APlaceWithoutCategorySaysNothing) {
  EXPECT_DOUBLE_EQ(agreement(part("square", 15.0), Landmark{}), 0.0);
}

}  // namespace
}  // namespace cairn

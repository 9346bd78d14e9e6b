#include "maps/submaps/likelihood_field.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cairn {
namespace {

TEST(LikelihoodField, ACellsValueIsTheLikelihoodOfTheDistanceToTheNearestEcho) {
  const std::vector<Point> echoes_m = {{0.05, 0.05}, {1.05, 0.05}};
  const LikelihoodField field(echoes_m, 0.1, 0.1);
  for (int x = -3; x <= 13; ++x)
    for (int y = -3; y <= 3; ++y) {
      const Point centre_m(0.1 * (x + 0.5), 0.1 * (y + 0.5));
      const double nearest_m = std::min((centre_m - echoes_m[0]).norm(), (centre_m - echoes_m[1]).norm());
      const double likelihood = nearest_m > 0.5 ? 0.0 : std::exp(-0.5 * nearest_m * nearest_m / 0.01);
      EXPECT_NEAR(field.value(x, y), 255.0 * likelihood, 3.0) << x << ", " << y;
    }
  EXPECT_EQ(field.value(1000, 0), 0) << "outside";
}

TEST(LikelihoodField, LeavesOutWhatIsNoPlaceAndWhatIsTooFarForAField) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Point> echoes_m = {{infinity, 0.0}, {0.0, std::nan("")}, {0.05, 0.05}, {1e9, 0.0}};
  const LikelihoodField field(echoes_m, 0.1, 0.1);
  EXPECT_EQ(field.value(0, 0), 255);
  EXPECT_LT(field.width(), 20);
  EXPECT_EQ(LikelihoodField({}, 0.1, 0.1).value(0, 0), 0);
}

}  // namespace
}  // namespace cairn

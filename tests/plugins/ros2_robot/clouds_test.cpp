// Clouds of points as rings of sonars.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "plugins/ros2_robot/messages.hpp"

namespace cairn::ros2_robot {
namespace {

using testing::HasSubstr;

// x and y as numbers of that type, one point after the other, with `gap` bytes before each number.
template <class Number>
class Cloud2 {
 public:
  Cloud2(std::initializer_list<std::pair<double, double>> points, std::size_t gap = 0, bool is_bigendian = false) {
    fields_[0] = {names_[0], static_cast<std::uint32_t>(gap), sizeof(Number) == 4 ? std::uint8_t{7} : std::uint8_t{8},
                  1};
    fields_[1] = fields_[0];
    fields_[1].name = names_[1];
    fields_[1].offset = static_cast<std::uint32_t>(2 * gap + sizeof(Number));
    for (const auto& [x, y] : points)
      for (const double value : {x, y}) {
        data_.insert(data_.end(), gap, 0);
        const Number number = static_cast<Number>(value);
        std::uint8_t bytes[sizeof number];
        std::memcpy(bytes, &number, sizeof number);
        if (is_bigendian != (std::endian::native == std::endian::big)) std::reverse(std::begin(bytes), std::end(bytes));
        data_.insert(data_.end(), std::begin(bytes), std::end(bytes));
      }
    message.height = 1;
    message.width = static_cast<std::uint32_t>(points.size());
    message.point_step = static_cast<std::uint32_t>(2 * (gap + sizeof(Number)));
    message.row_step = message.point_step * message.width;
    message.is_bigendian = is_bigendian;
    message.fields._buffer = fields_;
    message.fields._length = 2;
    message.data._buffer = data_.data();
    message.data._length = static_cast<std::uint32_t>(data_.size());
  }
  PointCloud2 message{};

 private:
  char names_[2][2] = {"x", "y"};
  sensor_msgs_msg_dds__PointField_ fields_[2]{};
  std::vector<std::uint8_t> data_;
};

std::string refusal_of(const PointCloud2& cloud) {
  try {
    (void)points_of(cloud);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Clouds, AreReadWhateverTheirLayout) {
  for (const bool is_bigendian : {false, true})
    for (const std::size_t gap : {0U, 3U}) {
      EXPECT_EQ(points_of(Cloud2<float>({{1.0, 2.0}, {-0.5, 4.0}}, gap, is_bigendian).message),
                (std::vector<Point>{{1.0, 2.0}, {-0.5, 4.0}}));
      EXPECT_EQ(points_of(Cloud2<double>({{1.0, 2.0}}, gap, is_bigendian).message), (std::vector<Point>{{1.0, 2.0}}));
    }
  Cloud2<float> rows({{1.0, 2.0}, {3.0, 4.0}});
  rows.message.height = 2;
  rows.message.width = 1;
  rows.message.row_step = rows.message.point_step;
  EXPECT_EQ(points_of(rows.message).back(), Point(3.0, 4.0));
  EXPECT_TRUE(points_of(PointCloud2{}).empty());
}

TEST(Clouds, WhoseLayoutCannotBeAreRefused) {
  Cloud2<float> cut({{1.0, 2.0}, {3.0, 4.0}});
  cut.message.data._length -= 1;
  EXPECT_THAT(refusal_of(cut.message), HasSubstr("its data end before its points do"));
  Cloud2<float> beyond({{1.0, 2.0}});
  beyond.message.fields._buffer[1].offset = std::numeric_limits<std::uint32_t>::max();
  EXPECT_THAT(refusal_of(beyond.message), HasSubstr("its field y reaches beyond a point"));
  Cloud2<float> integers({{1.0, 2.0}});
  integers.message.fields._buffer[0].datatype = 5;
  EXPECT_THAT(refusal_of(integers.message), HasSubstr("its field x is neither float nor double"));
  Cloud2<float> without({{1.0, 2.0}});
  without.message.fields._length = 1;
  EXPECT_THAT(refusal_of(without.message), HasSubstr("it has no field y"));
  Cloud2<float> huge({{1.0, 2.0}});
  huge.message.width = huge.message.height = std::numeric_limits<std::uint32_t>::max();
  EXPECT_THAT(refusal_of(huge.message), HasSubstr("its data end before its points do"));
}

TEST(Clouds, OfOldHaveTheirPointsAsTheyAre) {
  geometry_msgs_msg_dds__Point32_ points[] = {{1.0F, 2.0F, 0.3F}, {std::nanf(""), 0.0F, 0.0F}};
  PointCloud cloud{};
  cloud.points._buffer = points;
  cloud.points._length = 2;
  const std::vector<Point> read = points_of(cloud);
  EXPECT_EQ(read[0], Point(1.0, 2.0));
  EXPECT_TRUE(std::isnan(read[1].x()));
}

}  // namespace
}  // namespace cairn::ros2_robot

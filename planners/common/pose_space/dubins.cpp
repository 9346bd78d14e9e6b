#include "planners/common/pose_space/dubins.hpp"

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>

namespace cairn {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kRounding = 1e-11;  // radians, and turning radii

// A word: turns about the first and last centre to the side given (1 left, -1 right), and between them a
// straight segment or a turn to the other side.
struct Word {
  double side = 0.0;
  double last_side = 0.0;
  double first_rad = 0.0;
  double straight_m = 0.0;
  double middle_rad = 0.0;
  double last_rad = 0.0;

  [[nodiscard]] double length_m(double radius_m) const {
    return radius_m * (first_rad + middle_rad + last_rad) + straight_m;
  }
  [[nodiscard]] std::array<MotionElement, 4> elements(double radius_m) const {
    return {MotionElement::arc(radius_m, side * first_rad), MotionElement::straight(straight_m),
            MotionElement::arc(radius_m, -side * middle_rad), MotionElement::arc(radius_m, last_side * last_rad)};
  }
};

using Words = boost::container::static_vector<Word, 8>;

// To [0, 2 pi), where a hair less than a whole turn is none.
double turned(double angle_rad) {
  const double rad = angle_rad - kTwoPi * std::floor(angle_rad / kTwoPi);
  return kTwoPi - rad < kRounding ? 0.0 : rad;
}

Point centre_of_turn(const Pose2& pose, double side, double radius_m) {
  return pose.position() + side * radius_m * Point(-std::sin(pose.theta_rad), std::cos(pose.theta_rad));
}

double angle_of(const Point& v) {
  return std::atan2(v.y(), v.x());
}

// Circle, common tangent, circle.
void add_with_straight(const Pose2& from, const Pose2& to, double side, double last_side, double radius_m,
                       Words& words) {
  const Point between = centre_of_turn(to, last_side, radius_m) - centre_of_turn(from, side, radius_m);
  if (side == last_side && between.norm() < kRounding * radius_m) {  // one and the same circle
    words.push_back({side, side, turned(side * (to.theta_rad - from.theta_rad)), 0.0, 0.0, 0.0});
    return;
  }
  const double across_m = (side - last_side) * radius_m;
  const double squared = between.squaredNorm() - across_m * across_m;
  if (squared < -kRounding * radius_m * radius_m) return;  // no tangent: the circles overlap
  const double straight_m = std::sqrt(std::max(squared, 0.0));
  const double heading_rad = angle_of(between) + std::atan2(across_m, straight_m);
  words.push_back({side, last_side, turned(side * (heading_rad - from.theta_rad)), straight_m, 0.0,
                   turned(last_side * (to.theta_rad - heading_rad))});
}

// Circle, a circle that touches both, circle.
void add_with_turn(const Pose2& from, const Pose2& to, double side, double radius_m, Words& words) {
  const Point first = centre_of_turn(from, side, radius_m);
  const Point last = centre_of_turn(to, side, radius_m);
  const double half_m = 0.5 * (last - first).norm();
  if (half_m == 0.0 || half_m > 2.0 * radius_m) return;
  const Point along = (last - first) / (2.0 * half_m);
  const double height_m = std::sqrt(4.0 * radius_m * radius_m - half_m * half_m);
  for (const double above : {1.0, -1.0}) {
    const Point middle = 0.5 * (first + last) + above * height_m * Point(-along.y(), along.x());
    const double first_heading_rad = angle_of(middle - first) + side * 0.5 * std::numbers::pi;
    const double last_heading_rad = angle_of(middle - last) + side * 0.5 * std::numbers::pi;
    words.push_back({side, side, turned(side * (first_heading_rad - from.theta_rad)), 0.0,
                     turned(side * (first_heading_rad - last_heading_rad)),
                     turned(side * (to.theta_rad - last_heading_rad))});
  }
}

bool leads(const Word& word, Pose2 from, const Pose2& to, double radius_m, double tolerance) {
  for (const MotionElement& element : word.elements(radius_m)) from = driven(from, element);
  return are_alike(from, to, tolerance);
}

Word shortest_word(const Pose2& from, const Pose2& to, double radius_m, double tolerance) {
  Words words;
  for (const double side : {1.0, -1.0}) {
    for (const double last_side : {1.0, -1.0}) add_with_straight(from, to, side, last_side, radius_m, words);
    add_with_turn(from, to, side, radius_m, words);
  }
  const Word* shortest = nullptr;
  for (const Word& word : words)
    if ((shortest == nullptr || word.length_m(radius_m) < shortest->length_m(radius_m)) &&
        leads(word, from, to, radius_m, tolerance))
      shortest = &word;
  return shortest != nullptr ? *shortest : words.front();
}

}  // namespace

Motion dubins_motion(const Pose2& from, const Pose2& to, double radius_m, double tolerance) {
  const auto elements = shortest_word(from, to, radius_m, tolerance).elements(radius_m);
  return {from, {elements.begin(), elements.end()}};
}

double dubins_length_m(const Pose2& from, const Pose2& to, double radius_m, double tolerance) {
  return shortest_word(from, to, radius_m, tolerance).length_m(radius_m);
}

}  // namespace cairn

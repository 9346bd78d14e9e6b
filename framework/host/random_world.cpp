#include "framework/host/random_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace cairn {
namespace {

// The same numbers on every compiler, unlike the distributions of the standard library.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : random_(seed) {}
  double share() { return static_cast<double>(random_() >> 11) * 0x1.0p-53; }
  double between(double low, double high) { return low + (high - low) * share(); }
  // One of low .. high, both included.
  int whole(int low, int high) { return low + std::min(high - low, static_cast<int>((high - low + 1) * share())); }

 private:
  std::mt19937_64 random_;
};

struct Thing {
  std::string outline;  // its key and value in a world file
  double radius_m = 0.0;
  Point at_m{0.0, 0.0};
  double angle_deg = 0.0;
};

Thing landmark(const RandomWorldConfig& config, const std::vector<LandmarkShape>& shapes, Chance& chance) {
  const LandmarkShape& shape = shapes[static_cast<std::size_t>(chance.whole(0, static_cast<int>(shapes.size()) - 1))];
  const double scale = 1.0 + config.size_tolerance_ratio * chance.between(-1.0, 1.0);
  return {fmt::format("template: {}, scale: {:.3f}", shape.category, scale),
          0.5 * scale * shape.contour.outer_diameter_m(),
          {},
          chance.between(0.0, 360.0)};
}

// What stands about in rooms: a pole, a shelf, an angle of two shelves.
Thing distractor(Chance& chance) {
  const int kind = chance.whole(0, 2);
  const double long_m = chance.between(0.75, 1.0);
  const double thin_m = chance.between(0.15, 0.3);
  std::string outline;
  if (kind == 0) {
    outline = fmt::format("circle_diameter_m: {:.3f}", thin_m);
  } else if (kind == 1) {
    outline = fmt::format("polygon_m: [[0, 0], [{0:.3f}, 0], [{0:.3f}, {1:.3f}], [0, {1:.3f}]]", long_m, thin_m);
  } else {
    outline = fmt::format(
        "polygon_m: [[0, 0], [{0:.3f}, 0], [{0:.3f}, {1:.3f}], [{1:.3f}, {1:.3f}], [{1:.3f}, {0:.3f}], [0, {0:.3f}]]",
        long_m, thin_m);
  }
  // No corner is farther from the centroid than the longest diagonal.
  const double radius_m = kind == 0 ? 0.5 * thin_m : kind == 1 ? 0.5 * std::hypot(long_m, thin_m) : 0.75 * long_m;
  return {outline, radius_m, {}, chance.between(0.0, 360.0)};
}

// Whether all things found a place.
bool place_all(const RandomWorldConfig& config, const Point& room_m, std::vector<Thing>& things, Chance& chance) {
  constexpr int kTries = 200;
  for (std::size_t i = 0; i < things.size(); ++i) {
    Thing& thing = things[i];
    const double margin_m = thing.radius_m + config.gap_m;
    if (room_m.minCoeff() <= 2.0 * margin_m) return false;
    bool is_placed = false;
    for (int t = 0; t < kTries && !is_placed; ++t) {
      const double x_m = chance.between(margin_m, room_m.x() - margin_m);
      thing.at_m = {x_m, chance.between(margin_m, room_m.y() - margin_m)};
      is_placed = (thing.at_m - config.start_m).norm() > thing.radius_m + config.start_gap_m;
      for (std::size_t k = 0; k < i && is_placed; ++k)
        is_placed = (thing.at_m - things[k].at_m).norm() > margin_m + things[k].radius_m;
    }
    if (!is_placed) return false;
  }
  return true;
}

std::string surface(double specular_ratio, Chance& chance) {
  return chance.share() < specular_ratio ? "smooth" : "rough";
}

}  // namespace

void RandomWorldConfig::describe(Fields<RandomWorldConfig>& fields) {
  using C = RandomWorldConfig;
  constexpr Range kRoom_m{1.0, 100.0};
  fields.point("smallest_room_m", &C::smallest_room_m, "m", "least length and width of the room", kRoom_m);
  fields.point("largest_room_m", &C::largest_room_m, "m",
               "greatest length and width; a room that is too full is made larger all the same", kRoom_m);
  fields.integer("least_landmarks", &C::least_landmarks, {0.0, 100.0}, "at least so many landmarks");
  fields.integer("most_landmarks", &C::most_landmarks, {0.0, 100.0}, "at most so many landmarks");
  fields.integer("most_distractors", &C::most_distractors, {0.0, 100.0},
                 "at most so many poles, shelves and angles that no template describes");
  fields.number("size_tolerance_ratio", &C::size_tolerance_ratio, {0.0, 0.5}, "",
                "landmarks are larger or smaller than their template by up to this share");
  fields.number("gap_m", &C::gap_m, {0.3, 10.0}, "m", "free space between things, and between them and the walls");
  fields.point("start_m", &C::start_m, "m", "where the mission's robot begins; kept free", {0.0, kRoom_m.max});
  fields.number("start_gap_m", &C::start_gap_m, {0.1, 10.0}, "m", "free space round it");
}

std::string random_world_yaml(const RandomWorldConfig& config, const std::vector<LandmarkShape>& shapes,
                              double specular_ratio, std::uint64_t seed) {
  if (shapes.empty()) throw std::invalid_argument("a random world needs templates to take its landmarks from");
  Chance chance(seed);
  Chance surfaces(~seed);
  Point room_m{chance.between(config.smallest_room_m.x(), config.largest_room_m.x()), 0.0};
  room_m.y() = chance.between(config.smallest_room_m.y(), config.largest_room_m.y());
  std::vector<Thing> things;
  const int landmarks = chance.whole(config.least_landmarks, std::max(config.least_landmarks, config.most_landmarks));
  for (int i = 0; i < landmarks; ++i) things.push_back(landmark(config, shapes, chance));
  const int distractors = chance.whole(0, config.most_distractors);
  for (int i = 0; i < distractors; ++i) things.push_back(distractor(chance));
  while (!place_all(config, room_m, things, chance)) room_m += Point(0.25, 0.25);
  const double x = room_m.x();
  const double y = room_m.y();
  std::string text = fmt::format("# Random world {}: {} landmarks, {} other things.\n", seed, landmarks, distractors);
  text += fmt::format("bounds_m: [[0, 0], [{:.3f}, {:.3f}]]\nwalls:\n", x, y);
  const Point corners[] = {{0, 0}, {x, 0}, {x, y}, {0, y}, {0, 0}};
  for (int i = 0; i < 4; ++i)
    text += fmt::format("  - {{points_m: [[{:.3f}, {:.3f}], [{:.3f}, {:.3f}]], surface: {}}}\n", corners[i].x(),
                        corners[i].y(), corners[i + 1].x(), corners[i + 1].y(), surface(specular_ratio, surfaces));
  text += things.empty() ? "" : "objects:\n";
  for (const Thing& thing : things)
    text += fmt::format("  - {{{}, at_m: [{:.3f}, {:.3f}], angle_deg: {:.1f}, surface: {}}}\n", thing.outline,
                        thing.at_m.x(), thing.at_m.y(), thing.angle_deg, surface(specular_ratio, surfaces));
  return text;
}

}  // namespace cairn

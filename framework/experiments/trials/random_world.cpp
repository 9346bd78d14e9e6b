#include "framework/experiments/trials/random_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>

#include "maps/base/portable_random.hpp"
#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

struct Thing {
  std::string outline;  // its key and value in a world file
  double radius_m = 0.0;
  Point at_m{0.0, 0.0};
  double angle_deg = 0.0;
  bool is_landmark = false;
  double shelf_deg = 0.0;  // where its shelf stands, seen from it
};

constexpr double kShelfDepth_m = 0.3;
constexpr double kShelfLength_m = 0.8;
constexpr double kChair_m = 0.4;           // from leg to leg
constexpr double kChairLeg_m = 0.04;       // diameter
constexpr double kChairClearance_m = 0.5;  // free space round a chair

// Of the circle about a landmark that holds its shelf too.
double radius_with_shelf_m(double radius_m, double shelf_gap_m) {
  return std::hypot(radius_m + shelf_gap_m + kShelfDepth_m, 0.5 * kShelfLength_m);
}

Thing landmark(const RandomWorldConfig& config, const std::vector<LandmarkShape>& shapes, PortableRandom& chance) {
  const LandmarkShape& shape = shapes[static_cast<std::size_t>(chance.whole(0, static_cast<int>(shapes.size()) - 1))];
  const double scale = config.landmark_scale * (1.0 + config.size_tolerance_ratio * chance.between(-1.0, 1.0));
  return {fmt::format("template: {}, scale: {:.3f}", shape.category, scale),
          0.5 * scale * shape.contour.outer_diameter_m(),
          {},
          chance.between(0.0, 360.0),
          true};
}

// What stands about in rooms: a pole, a shelf, an angle of two shelves.
Thing distractor(PortableRandom& chance) {
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

// The radius of what must not touch other things.
double occupied_radius_m(const RandomWorldConfig& config, const Thing& thing) {
  return thing.is_landmark && config.shelf_gap_m ? radius_with_shelf_m(thing.radius_m, *config.shelf_gap_m)
                                                 : thing.radius_m;
}

// So far from one of the four walls.
void put_at_wall(Thing& thing, const Point& room_m, double gap_m, PortableRandom& chance) {
  const int wall = chance.whole(0, 3);
  const int axis = wall / 2;
  const double from_wall_m = thing.radius_m + gap_m;
  thing.at_m[axis] = wall % 2 == 0 ? from_wall_m : room_m[axis] - from_wall_m;
}

// Whether all things found a place.
bool place_all(const RandomWorldConfig& config, const Point& room_m, std::vector<Thing>& things,
               PortableRandom& chance) {
  constexpr int kTries = 200;
  for (std::size_t i = 0; i < things.size(); ++i) {
    Thing& thing = things[i];
    const double radius_m = occupied_radius_m(config, thing);
    const double margin_m = radius_m + config.gap_m;
    if (room_m.minCoeff() <= 2.0 * margin_m) return false;
    bool is_placed = false;
    for (int t = 0; t < kTries && !is_placed; ++t) {
      const double x_m = chance.between(margin_m, room_m.x() - margin_m);
      thing.at_m = {x_m, chance.between(margin_m, room_m.y() - margin_m)};
      if (thing.is_landmark && config.wall_gap_m) put_at_wall(thing, room_m, *config.wall_gap_m, chance);
      is_placed = (thing.at_m - config.start_m).norm() > radius_m + config.start_gap_m;
      for (std::size_t k = 0; k < i && is_placed; ++k)
        is_placed = (thing.at_m - things[k].at_m).norm() > margin_m + occupied_radius_m(config, things[k]);
    }
    if (!is_placed) return false;
  }
  return true;
}

// Whether all chairs found a place. A chair is a thing whose radius reaches over its legs.
bool place_chairs(const RandomWorldConfig& config, const Point& room_m, const std::vector<Thing>& things,
                  std::vector<Thing>& chairs, PortableRandom& chance) {
  constexpr int kTries = 200;
  constexpr double kRadius_m = 0.5 * (std::numbers::sqrt2 * kChair_m + kChairLeg_m);
  constexpr double kMargin_m = kRadius_m + kChairClearance_m;
  if (config.chairs > 0 && room_m.minCoeff() <= 2.0 * kMargin_m) return false;
  const auto is_clear = [&](const Point& at_m, const Thing& other) {
    return (at_m - other.at_m).norm() > kMargin_m + occupied_radius_m(config, other);
  };
  for (int t = 0; t < kTries * config.chairs && std::ssize(chairs) < config.chairs; ++t) {
    const double x_m = chance.between(kMargin_m, room_m.x() - kMargin_m);
    const Point at_m(x_m, chance.between(kMargin_m, room_m.y() - kMargin_m));
    const auto clear_of = [&](const Thing& other) { return is_clear(at_m, other); };
    if ((at_m - config.start_m).norm() > kRadius_m + config.start_gap_m && std::ranges::all_of(things, clear_of) &&
        std::ranges::all_of(chairs, clear_of))
      chairs.push_back({{}, kRadius_m, at_m, chance.between(0.0, 360.0)});
  }
  return std::ssize(chairs) == config.chairs;
}

std::string chair_text(const Thing& chair) {
  std::string text;
  for (int leg = 0; leg < 4; ++leg) {
    const Point at_m =
        chair.at_m + kChair_m * std::numbers::sqrt2 / 2.0 * unit_vector(radians(chair.angle_deg + 45.0 + 90.0 * leg));
    text += fmt::format("  - {{circle_diameter_m: {}, at_m: [{:.3f}, {:.3f}], surface: rough}}\n", kChairLeg_m,
                        at_m.x(), at_m.y());
  }
  return text;
}

// The file places an object by its centroid.
std::string shelf_text(const Thing& landmark, double gap_m, const std::string& surface) {
  const Point at_m =
      landmark.at_m + (landmark.radius_m + gap_m + 0.5 * kShelfDepth_m) * unit_vector(radians(landmark.shelf_deg));
  return fmt::format(
      "  - {{polygon_m: [[0, 0], [{0}, 0], [{0}, {1}], [0, {1}]], at_m: [{2:.3f}, {3:.3f}], angle_deg: {4:.1f}, "
      "surface: "
      "{5}}}\n",
      kShelfDepth_m, kShelfLength_m, at_m.x(), at_m.y(), landmark.shelf_deg, surface);
}

// A line of the world file, or none where no path is free.
std::string mover(const RandomWorldConfig& config, const Point& room_m, const std::vector<Thing>& things, int number,
                  PortableRandom& chance) {
  constexpr int kTries = 200;
  constexpr double kDiameter_m = 0.4;
  constexpr double kClear_m = 0.1;
  constexpr double kShortest_m = 1.0;
  constexpr double kRadius_m = 0.5 * kDiameter_m;
  const double speed_mps = chance.between(0.3, 0.8);
  const double pause_s = chance.between(1.0, 10.0);
  for (int t = 0; t < kTries; ++t) {
    const auto place = [&](double size_m) {
      return chance.between(kRadius_m + kClear_m, size_m - kRadius_m - kClear_m);
    };
    const double x_m = place(room_m.x());
    const Point from_m(x_m, place(room_m.y()));
    const double to_x_m = place(room_m.x());
    const Point to_m(to_x_m, place(room_m.y()));
    if ((to_m - from_m).norm() < kShortest_m) continue;
    if ((from_m - config.start_m).norm() < kRadius_m + config.start_gap_m + kShortest_m) continue;
    const bool free = std::ranges::all_of(things, [&](const Thing& thing) {
      return distance_to_segment_m(thing.at_m, from_m, to_m) > occupied_radius_m(config, thing) + kRadius_m + kClear_m;
    });
    if (free)
      return fmt::format(
          "  - {{name: person {}, circle_diameter_m: {}, path_m: [[{:.3f}, {:.3f}], [{:.3f}, {:.3f}]], "
          "speed_mps: {:.3f}, pause_s: {:.1f}}}\n",
          number, kDiameter_m, from_m.x(), from_m.y(), to_m.x(), to_m.y(), speed_mps, pause_s);
  }
  return {};
}

// The rooms behind the doors: how far each reaches to the east, and where its door begins.
struct Annex {
  double west_m;
  double door_m;
  double width_m;  // of the door
  double every_s;
  double for_s;
};

std::vector<Annex> annexes(const RandomWorldConfig& config, Point& size_m, PortableRandom& chance) {
  std::vector<Annex> rooms(static_cast<std::size_t>(chance.whole(0, config.max_doors)));
  for (Annex& room : rooms) {
    room.west_m = size_m.x();
    room.width_m = std::min(1.0, 0.5 * size_m.y());
    room.door_m = chance.between(0.1, 0.9) * (size_m.y() - room.width_m);
    room.every_s = chance.between(30.0, 90.0);
    room.for_s = chance.between(0.2, 0.5) * room.every_s;
    size_m.x() += chance.between(2.0, 3.5);
  }
  return rooms;
}

std::string doors_text(const std::vector<Annex>& rooms) {
  std::string text;
  for (const Annex& room : rooms)
    text += fmt::format(
        "  - {{name: door {}, from_m: [{:.3f}, {:.3f}], to_m: [{:.3f}, {:.3f}], closes: {{every_s: {:.1f}, for_s: "
        "{:.1f}, first_s: {:.1f}}}}}\n",
        &room - rooms.data() + 1, room.west_m, room.door_m, room.west_m, room.door_m + room.width_m, room.every_s,
        room.for_s, room.every_s - room.for_s);
  return text.empty() ? text : "doors:\n" + text;
}

std::string movers_text(const RandomWorldConfig& config, const Point& room_m, const std::vector<Thing>& things,
                        PortableRandom& chance) {
  std::string text;
  const int count = chance.whole(config.min_movers, std::max(config.min_movers, config.max_movers));
  for (int i = 1; i <= count; ++i) text += mover(config, room_m, things, i, chance);
  return text.empty() ? text : "movers:\n" + text;
}

std::string wall(const Point& from_m, const Point& to_m, const std::string& surface) {
  return fmt::format("  - {{points_m: [[{:.3f}, {:.3f}], [{:.3f}, {:.3f}]], surface: {}}}\n", from_m.x(), from_m.y(),
                     to_m.x(), to_m.y(), surface);
}

std::string surface(double specular_ratio, PortableRandom& chance) {
  return chance.share() < specular_ratio ? "smooth" : "rough";
}

}  // namespace

void RandomWorldConfig::describe(Fields<RandomWorldConfig>& fields) {
  using C = RandomWorldConfig;
  constexpr Range kRoom_m{1.0, 100.0};
  fields.point("smallest_room_m", &C::smallest_room_m, "m", "least length and width of the room", kRoom_m);
  fields.point("largest_room_m", &C::largest_room_m, "m",
               "greatest length and width; a room that is too full is made larger all the same", kRoom_m);
  fields.integer("min_landmarks", &C::min_landmarks, {0.0, 100.0}, "at least so many landmarks");
  fields.integer("max_landmarks", &C::max_landmarks, {0.0, 100.0}, "at most so many landmarks");
  fields.integer("max_distractors", &C::max_distractors, {0.0, 100.0},
                 "at most so many poles, shelves and angles that no template describes");
  fields.number("size_tolerance_ratio", &C::size_tolerance_ratio, {0.0, 0.5}, "",
                "landmarks are larger or smaller than their template by up to this share");
  fields.number("landmark_scale", &C::landmark_scale, {0.2, 5.0}, "",
                "landmarks are so many times as large as their template, before the tolerance");
  fields.number("gap_m", &C::gap_m, {0.3, 10.0}, "m", "free space between things, and between them and the walls");
  fields.number(
      "wall_gap_m", &C::wall_gap_m, {0.0, 10.0}, "m",
      "free space between a landmark's outer circle and one wall, exactly; left out, landmarks stand anywhere");
  fields.number("shelf_gap_m", &C::shelf_gap_m, {0.0, 10.0}, "m",
                "beside each landmark stands a shelf, so far from its outer circle; left out, there are none");
  fields.integer("chairs", &C::chairs, {0.0, 50.0}, "so many chairs of four thin legs, at least 0.5 m from all else");
  fields.point("start_m", &C::start_m, "m", "where the mission's robot begins; kept free", {0.0, kRoom_m.max});
  fields.number("start_gap_m", &C::start_gap_m, {0.1, 10.0}, "m", "free space round it");
  fields.integer("min_movers", &C::min_movers, {0.0, 20.0}, "at least so many people, where there is room for them");
  fields.integer("max_movers", &C::max_movers, {0.0, 20.0}, "at most so many people that go there and back");
  fields.integer("max_doors", &C::max_doors, {0.0, 5.0},
                 "at most so many doors that open and close, each to one more room in the east");
}

std::string random_world_yaml(const RandomWorldConfig& config, const std::vector<LandmarkShape>& shapes,
                              double specular_ratio, std::uint64_t seed) {
  if (shapes.empty()) throw std::invalid_argument("a random world needs templates to take its landmarks from");
  PortableRandom chance(seed);
  PortableRandom surfaces(~seed);
  Point room_m{chance.between(config.smallest_room_m.x(), config.largest_room_m.x()), 0.0};
  room_m.y() = chance.between(config.smallest_room_m.y(), config.largest_room_m.y());
  std::vector<Thing> things;
  const int landmarks = chance.whole(config.min_landmarks, std::max(config.min_landmarks, config.max_landmarks));
  std::generate_n(std::back_inserter(things), landmarks, [&] { return landmark(config, shapes, chance); });
  const int distractors = chance.whole(0, config.max_distractors);
  std::generate_n(std::back_inserter(things), distractors, [&] { return distractor(chance); });
  // Streams of their own: without them the rest stays as it is.
  PortableRandom furnishing(seed ^ 0x6368616972730000ULL);
  PortableRandom moving(seed ^ 0x6d6f76696e670000ULL);
  PortableRandom opening(seed ^ 0x646f6f7273000000ULL);
  std::vector<Thing> chairs;
  const auto furnish = [&] {
    chairs.clear();
    return place_all(config, room_m, things, chance) && place_chairs(config, room_m, things, chairs, furnishing);
  };
  while (!furnish()) room_m += Point(0.25, 0.25);
  for (Thing& thing : things) thing.shelf_deg = furnishing.between(0.0, 360.0);
  const Point first_room_m = room_m;
  const std::vector<Annex> rooms = annexes(config, room_m, opening);
  const double x = room_m.x();
  const double y = room_m.y();
  std::string text = fmt::format("# Random world {}: {} landmarks, {} other things.\n", seed, landmarks, distractors);
  text += fmt::format("bounds_m: [[0, 0], [{:.3f}, {:.3f}]]\nwalls:\n", x, y);
  const Point corners[] = {{0, 0}, {x, 0}, {x, y}, {0, y}, {0, 0}};
  for (int i = 0; i < 4; ++i) text += wall(corners[i], corners[i + 1], surface(specular_ratio, surfaces));
  for (const Annex& room : rooms) {
    text += wall({room.west_m, 0.0}, {room.west_m, room.door_m}, surface(specular_ratio, opening));
    text += wall({room.west_m, room.door_m + room.width_m}, {room.west_m, y}, surface(specular_ratio, opening));
  }
  text += things.empty() && chairs.empty() ? "" : "objects:\n";
  for (const Thing& thing : things)
    text += fmt::format("  - {{{}, at_m: [{:.3f}, {:.3f}], angle_deg: {:.1f}, surface: {}}}\n", thing.outline,
                        thing.at_m.x(), thing.at_m.y(), thing.angle_deg, surface(specular_ratio, surfaces));
  for (const Thing& thing : things)
    if (thing.is_landmark && config.shelf_gap_m)
      text += shelf_text(thing, *config.shelf_gap_m, surface(specular_ratio, furnishing));
  for (const Thing& chair : chairs) text += chair_text(chair);
  things.insert(things.end(), chairs.begin(), chairs.end());
  return text + doors_text(rooms) + movers_text(config, first_room_m, things, moving);
}

}  // namespace cairn

#include "framework/experiments/buildings/config.hpp"

namespace cairn {

void BuildingsConfig::describe(Fields<BuildingsConfig>& fields) {
  using C = BuildingsConfig;
  fields.numbers("sides_m", &C::sides_m, {50.0, 800.0}, "m", "one square building of each side");
  fields.integer("landmarks", &C::landmarks, {1.0, 100000.0},
                 "landmarks of the largest; the others have as many to the square metre");
  fields.number("cell_m", &C::cell_m, {0.02, 0.5}, "m", "side of a cell of the maps");
  fields.number("radius_m", &C::radius_m, {0.05, 0.4}, "m", "radius of the robot");
  fields.integer("pairs", &C::pairs, {1.0, 1e5}, "questions about each map, between random places");
  fields.integer("whole_pairs", &C::whole_pairs, {0.0, 1e5},
                 "the first so many of them are also answered by the shortest path over the whole grid");
  fields.integer("first_answers", &C::first_answers, {1.0, 1e4},
                 "the first so many of them are also asked one by one, each of a program of its own");
}

}  // namespace cairn

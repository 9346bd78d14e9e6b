// What `cairn plan` is asked, and the map that it is asked about.
#include <cmath>
#include <fstream>
#include <optional>

#include "framework/config/config_value.hpp"
#include "framework/planning/place.hpp"
#include "framework/program/plan/line_reader.hpp"
#include "framework/program/plan/plan_query.hpp"
#include "maps/store/repair.hpp"
#include "tests/fuzz/scratch.hpp"

namespace cairn::fuzz {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Landmark landmark(LandmarkId id, const std::string& name, const std::string& category, double x_m) {
  Landmark made;
  made.id = id;
  made.name = name;
  made.category = category;
  made.T_map_landmark = {x_m, 1.0, 0.0};
  return made;
}

SavedMap two_landmarks_and_a_route() {
  SavedMap map;
  map.graph.add(landmark(1, "door", "square", 1.0));
  map.graph.add(landmark(2, "bay 3", "circle", 4.0));
  Route route;
  route.id = 1;
  route.from = 1;
  route.to = 2;
  route.cost_m = 3.0;
  map.graph.add_route(std::move(route));
  return map;
}

const SavedMap& small_map() {
  static const SavedMap kept = two_landmarks_and_a_route();
  return kept;
}

// Without the pages that nobody asks for. nullopt when it is refused.
std::optional<OccupancyGrid> grid_read_in_part(const std::filesystem::path& file) {
  try {
    const MapFile opened(file);
    static_cast<void>(opened.without_cells());
    return opened.grid_within(opened.lattice().bounds());
  } catch (const StoreError&) {
    return std::nullopt;
  }
}

}  // namespace

// A map that loads is one that can be saved, and then gives the same bytes for ever.
void read_saved_map(Input input) {
  const std::filesystem::path file = scratch_file("fuzzed.cairn", text_of(input));
  const std::optional<OccupancyGrid> grid = grid_read_in_part(file);
  SavedMap map;
  try {
    map = load_map(file);
  } catch (const StoreError&) {
    return;
  }
  promise(grid == map.grid, "all parts of a map are the map");
  const std::filesystem::path first = scratch() / "first.cairn";
  const std::filesystem::path second = scratch() / "second.cairn";
  save_map(first, map);
  save_map(second, load_map(first));
  promise(bytes_of(first) == bytes_of(second), "a saved map reads as what was saved");
}

// What is saved of a file is a map, and of a sound file all. Nothing lost does not mean sound: definitions of tables
// are replaced, and there is room in a file that holds nothing.
void read_damaged_map(Input input) {
  const std::filesystem::path file = scratch_file("fuzzed.cairn", text_of(input));
  const std::optional<OccupancyGrid> grid = grid_read_in_part(file);
  std::optional<SavedMap> whole;
  try {
    whole = load_map(file);
  } catch (const StoreError&) {
  }
  SalvagedMap salvaged;
  try {
    salvaged = salvage_map(file);
  } catch (const StoreError&) {
    promise(!whole, "a map that loads can be repaired");
    return;
  }
  const std::filesystem::path first = scratch() / "first.cairn";
  save_map(first, salvaged.map);
  if (!whole) return;
  promise(grid == whole->grid, "all parts of a map are the map");
  promise(salvaged.losses.empty(), "a map that loads has lost nothing");
  const std::filesystem::path second = scratch() / "second.cairn";
  save_map(second, *whole);
  promise(bytes_of(first) == bytes_of(second), "what is saved of a sound map is that map");
}

void read_plan_queries(Input input) {
  const std::filesystem::path file = scratch_file("queries", text_of(input));
  try {
    LineReader lines(file.string());
    for (std::string line; lines.next(line);) {
      const PlanQuery query = query_of_line(line, "fuzzed", lines.number(), {});
      static_cast<void>(task_of(query.question, small_map().graph, small_map().clusters));
    }
  } catch (const ConfigError&) {
  } catch (const PlaceError&) {
  }
}

void read_place(Input input) {
  try {
    const Place place = parse_place(std::string(text_of(input)), small_map().graph);
    promise(place.pose.has_value() != !place.landmarks.empty(), "a place is a pose or landmarks");
    if (place.pose)
      promise(place.pose->position().allFinite() && std::isfinite(place.pose->theta_rad), "a place is finite");
  } catch (const PlaceError&) {
  }
}

}  // namespace cairn::fuzz

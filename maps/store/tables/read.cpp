#include <algorithm>
#include <array>
#include <charconv>
#include <span>

#include "maps/base/spelling.hpp"
#include "maps/store/tables/codec.hpp"
#include "maps/store/tables/reading.hpp"
#include "maps/store/tables/tables.hpp"
#include "maps/store/tables/trajectory.hpp"

namespace cairn::store {
namespace {

constexpr std::size_t kTileBytes = 2 * OccupancyGrid::kTileSide * OccupancyGrid::kTileSide;

// A grid beyond these would only exhaust the memory of whoever works with it.
constexpr std::int64_t kMaxCellIndex = OccupancyGrid::kLargestCellIndex;
constexpr std::int64_t kMaxCells = OccupancyGrid::kMaxCells;
constexpr double kMinCellM = 1e-6;  // below it places overflow the indices of their cells
constexpr double kMaxCellM = 1000.0;
constexpr double kMaxClampNat = 127.0;
constexpr std::int64_t kMaxPoses = 10'000'000;
constexpr std::size_t kMaxCorners = 10'000;

// Grids and tiles of other floors are for later versions.
void require_level_zero(const Statement& row, int column) {
  static_cast<void>(row.integer_within(column, 0, 0));
}

// Unpacks a blob column with the checksum in the column behind it.
std::string unpacked_column(const Statement& row, int column, std::size_t raw_size, const std::string& what) {
  try {
    std::string raw = unpacked_bytes(row.blob(column), raw_size);
    if (crc32_of(raw) != row.integer(column + 1)) throw StoreError("its bytes do not match its checksum");
    return raw;
  } catch (const StoreError& error) {
    throw StoreError(what + " is damaged: " + error.what());
  }
}

OccupancyGrid read_grid(Reading& reading) {
  Statement row(reading.database, "SELECT * FROM grid ORDER BY level");
  if (!row.step()) throw StoreError("has no row");
  require_level_zero(row, 0);
  const double cell_m = row.real(1);
  const double clamp_nat = row.real(4);
  if (!(cell_m >= kMinCellM) || cell_m > kMaxCellM)
    throw StoreError("cell_m must be in [0.000001, 1000], is " + std::to_string(cell_m));
  if (!(clamp_nat > 0.0) || clamp_nat > kMaxClampNat)
    throw StoreError("clamp_nat must be in (0, 127], is " + std::to_string(clamp_nat));
  const auto index = [&row](int column) {
    return static_cast<int>(row.integer_within(column, -kMaxCellIndex, kMaxCellIndex));
  };
  const CellBox bounds{{index(5), index(6)}, {index(7), index(8)}};
  const bool none = bounds == CellBox{};
  if ((bounds.empty() && !none) || std::int64_t{bounds.width()} * bounds.height() > kMaxCells)
    throw StoreError("bounds of " + std::to_string(bounds.width()) + " x " + std::to_string(bounds.height()) +
                     " cells are not possible, at most " + std::to_string(kMaxCells) + " cells are");
  OccupancyGrid grid(cell_m, clamp_nat, {row.real(2), row.real(3)});
  grid.include(bounds);
  if (row.step()) throw StoreError("has more than one row, this version knows one level");
  return grid;
}

// Of a tile that reaches beyond the bounds.
void require_unknown_outside(const CellBox& bounds, Cell first, std::span<const LogOdds> values,
                             const std::string& what) {
  for (int i = 0; i < static_cast<int>(values.size()); ++i)
    if (values[static_cast<std::size_t>(i)] != 0 &&
        !bounds.contains(first + Cell{i % OccupancyGrid::kTileSide, i / OccupancyGrid::kTileSide}))
      throw StoreError(what + " has known cells outside the grid's bounds");
}

// The cells of a tile that lie in the box. A tile far off would grow the grid: nothing is written before all is
// checked.
void take_tile(OccupancyGrid& grid, Cell tile, const std::string& raw, const CellBox& box, const std::string& what) {
  constexpr int kSide = OccupancyGrid::kTileSide;
  std::array<LogOdds, static_cast<std::size_t>(kSide) * kSide> values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = little_endian_at<LogOdds>(raw, 2 * i);
  const Cell first{tile.x * kSide, tile.y * kSide};
  const CellBox cells{first, first + Cell{kSide, kSide}};
  const CellBox bounds = grid.bounds();
  if (intersected(cells, bounds) != cells) require_unknown_outside(bounds, first, values, what);
  const auto clamp = static_cast<int>(grid.clamp_nat() * kLogOddsPerNat);
  const auto [least, most] = std::ranges::minmax(values);
  if (most > clamp || least < -clamp) throw StoreError(what + " holds log-odds beyond the grid's clamp");
  const CellBox inside = intersected(cells, box);
  if (inside.empty()) return;
  LogOdds* const taken = grid.cells_of_tile_for_writing(tile);
  for (int y = inside.min.y - first.y; y < inside.max.y - first.y; ++y)
    for (int x = inside.min.x - first.x; x < inside.max.x - first.x; ++x) {
      const auto i = static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
      taken[i] = values[i];
    }
}

void read_tiles(Reading& reading, const std::string& where, const CellBox& box, OccupancyGrid& grid) {
  const std::string select = "SELECT level, tx, ty, log_odds, crc32 FROM tiles" + where + " ORDER BY level, ty, tx";
  reading.rows("tiles", select, [&](Statement& row) {
    require_level_zero(row, 0);
    constexpr std::int64_t kMaxTile = kMaxCellIndex / OccupancyGrid::kTileSide;
    const Cell tile{static_cast<int>(row.integer_within(1, -kMaxTile, kMaxTile)),
                    static_cast<int>(row.integer_within(2, -kMaxTile, kMaxTile))};
    const std::string what = "tile (" + std::to_string(tile.x) + ", " + std::to_string(tile.y) + ")";
    reading.at_tile(tile);
    take_tile(grid, tile, unpacked_column(row, 3, kTileBytes, what), box, what);
  });
}

std::vector<Pose2> read_trajectory(const Statement& row, int poses_column, const std::string& what) {
  const auto poses = static_cast<std::size_t>(row.integer_within(poses_column, 0, kMaxPoses));
  const std::string packed = row.blob(poses_column + 1);
  try {
    if (crc32_of(packed) != row.integer(poses_column + 2)) throw StoreError("its bytes do not match its checksum");
    return unpacked_trajectory(packed, poses);
  } catch (const StoreError& error) {
    throw StoreError(what + " is damaged: " + error.what());
  }
}

Route route_in(const Statement& row) {
  Route route;
  route.id = row.integer_within(0, 1, kMaxId);
  route.level = static_cast<int>(row.integer_within(1, -kMaxLevel, kMaxLevel));
  route.from = row.integer(2);
  route.to = row.integer(3);
  route.cost_m = row.real(4);
  route.driven = row.integer_within(5, 0, 1) != 0;
  route.closed = row.integer_within(6, 0, 1) != 0;
  route.trajectory = read_trajectory(row, 7, "the trajectory of " + numbered("route", route.id));
  route.speed_limit_mps = row.optional_real(10);
  route.annotations = annotations_in(row, 11);
  return route;
}

void read_routes(Reading& reading, LandmarkGraph& graph) {
  reading.rows("routes", "SELECT * FROM routes ORDER BY id", [&](Statement& row) { graph.add_route(route_in(row)); });
}

void read_next_ids(Reading& reading, SavedMap& map) {
  Statement row(reading.database, "SELECT kind, id FROM next_ids ORDER BY kind");
  const auto next = [&row](const std::string& kind) {
    if (!row.step() || row.text(0) != kind) throw StoreError("has no row for " + kind);
    return row.integer_within(1, 1, kMaxId + 1);
  };
  if (const LandmarkId candidate = next("candidate"); map.progress) map.progress->candidates.reserve_ids(candidate, 1);
  map.clusters.next_id = next("cluster");
  const LandmarkId next_landmark = next("landmark");
  map.graph.reserve_ids(next_landmark, next("route"));
}

// Takes one number off the front of the text.
double take_number(std::string_view& text) {
  double value = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) throw StoreError("a number is expected at " + in_quotes(text.substr(0, 20)));
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  return value;
}

void take_separator(std::string_view& text, char separator) {
  if (!text.starts_with(separator))
    throw StoreError(std::string("'") + separator + "' is expected at " + in_quotes(text.substr(0, 20)));
  text.remove_prefix(1);
}

Contour contour_of(const std::string& kind, std::string_view parameters) {
  if (kind != "circle" && kind != "polygon" && kind != "polygons")
    throw StoreError("kind " + in_quotes(kind) + " is not circle, polygon or polygons");
  if (kind == "circle") {
    const double diameter_m = take_number(parameters);
    if (!parameters.empty()) throw StoreError("a circle has one parameter, its diameter");
    return Contour::circle(diameter_m);
  }
  std::vector<std::vector<Point>> polygons(1);
  for (std::size_t corners = 1; !parameters.empty(); ++corners) {
    if (corners > kMaxCorners) throw StoreError("has more than " + std::to_string(kMaxCorners) + " corners");
    if (kind == "polygons" && parameters.starts_with(';')) {
      take_separator(parameters, ';');
      polygons.emplace_back();
    }
    if (!polygons.back().empty()) take_separator(parameters, ' ');
    const double x_m = take_number(parameters);
    take_separator(parameters, ',');
    polygons.back().emplace_back(x_m, take_number(parameters));
  }
  return Contour::parts_in_place(std::move(polygons));
}

void read_shapes(Reading& reading, std::vector<LandmarkShape>& shapes) {
  reading.rows("shapes", "SELECT category, kind, parameters FROM shapes ORDER BY number", [&](Statement& row) {
    shapes.push_back({row.plain_text(0), contour_of(row.plain_text(1), row.plain_text(2))});
  });
}

}  // namespace

SavedMap read_content(Reading& reading) {
  SavedMap map = read_content_without_tiles(reading);
  read_tiles(reading, "", map.grid.bounds(), map.grid);
  return map;
}

OccupancyGrid read_lattice(Reading& reading) {
  OccupancyGrid grid(1.0);
  reading.in_table("grid", [&] {
    grid = read_grid(reading);
    reading.tile_m = {grid.origin_m(), OccupancyGrid::kTileSide * grid.cell_m()};
  });
  return grid;
}

void read_tiles_within(Reading& reading, const CellBox& box, OccupancyGrid& grid) {
  if (box.empty()) return;
  const auto between = [](const char* column, int min, int max) {
    return std::string(column) + " BETWEEN " + std::to_string(min >> 6) + " AND " + std::to_string((max - 1) >> 6);
  };
  const std::string where =
      " WHERE level = 0 AND " + between("ty", box.min.y, box.max.y) + " AND " + between("tx", box.min.x, box.max.x);
  read_tiles(reading, where, box, grid);
}

SavedMap read_content_without_tiles(Reading& reading) {
  SavedMap map;
  reading.rows("meta", "SELECT key, value FROM meta ORDER BY key",
               [&](Statement& row) { map.properties.emplace(row.plain_text(0), row.plain_text(1)); });
  map.grid = read_lattice(reading);
  read_all_landmarks(reading, map.graph);
  read_routes(reading, map.graph);
  read_progress(reading, map);
  reading.in_table("next_ids", [&] { read_next_ids(reading, map); });
  reading.in_table("clusters", [&] { read_clusters(reading.database, map); });
  reading.in_table("landmark_clusters", [&] { read_landmark_clusters(reading.database, map); });
  read_shapes(reading, map.shapes);
  reading.rows("driven_path", "SELECT x_m, y_m, theta_rad FROM driven_path ORDER BY number",
               [&](Statement& row) { map.driven_path.push_back(row.pose(0)); });
  read_submaps(reading, map.submaps);
  return map;
}

}  // namespace cairn::store

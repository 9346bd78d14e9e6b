#include <charconv>
#include <limits>
#include <map>

#include "maps/exchange/json_text.hpp"
#include "maps/map_store_codec.hpp"
#include "maps/map_store_tables.hpp"

namespace cairn::store {
namespace {

constexpr int kSide = OccupancyGrid::kTileSide;
constexpr std::size_t kTileBytes = 2 * kSide * kSide;
constexpr std::size_t kPoseBytes = 3 * sizeof(double);

// A grid beyond these would only exhaust the memory of whoever works with it.
constexpr std::int64_t kMaxCellIndex = OccupancyGrid::kLargestCellIndex;
constexpr std::int64_t kMaxCells = OccupancyGrid::kMostCells;
constexpr double kMaxCellM = 1000.0;
constexpr double kMaxClampNat = 127.0;
constexpr std::int64_t kMaxPoses = 10'000'000;
constexpr std::size_t kMaxCorners = 10'000;
constexpr std::int64_t kMaxLevel = 1'000'000;
constexpr std::int64_t kMaxInt = std::numeric_limits<int>::max();
constexpr std::int64_t kMaxId = std::numeric_limits<std::int64_t>::max();

// Runs a reader and puts the table in front of whatever it, the graph or a contour objects to.
template <typename Read>
void in_table(const std::string& table, Read read) {
  try {
    read();
  } catch (const StoreError& error) {
    throw StoreError("table " + table + ": " + error.what());
  } catch (const std::invalid_argument& error) {
    throw StoreError("table " + table + ": " + error.what());
  }
}

std::string numbered(const char* kind, std::int64_t id) {
  return std::string(kind) + " " + std::to_string(id);
}

// Grids and tiles of other floors are for later versions.
void require_level_zero(const Statement& row, int column) {
  static_cast<void>(row.integer_within(column, 0, 0));
}

// Unpacks a blob column with the checksum in the column behind it.
std::string unpacked(const Statement& row, int column, std::size_t raw_size, const std::string& what) {
  try {
    std::string raw = decompressed(row.blob(column), raw_size);
    if (crc32_of(raw) != row.integer(column + 1)) throw StoreError("its bytes do not match its checksum");
    return raw;
  } catch (const StoreError& error) {
    throw StoreError(what + " is damaged: " + error.what());
  }
}

OccupancyGrid read_grid(Database& database) {
  Statement row(database, "SELECT * FROM grid ORDER BY level");
  if (!row.step()) throw StoreError("has no row");
  require_level_zero(row, 0);
  const double cell_m = row.real(1);
  const double clamp_nat = row.real(4);
  if (!(cell_m > 0.0) || cell_m > kMaxCellM)
    throw StoreError("cell_m must be in (0, 1000], is " + std::to_string(cell_m));
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

void take_tile(OccupancyGrid& grid, Cell tile, const std::string& raw, const std::string& what) {
  const CellBox bounds = grid.bounds();
  const auto clamp = static_cast<int>(grid.clamp_nat() * kLogOddsPerNat);
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto value = little_endian_at<LogOdds>(raw, 2 * static_cast<std::size_t>(i));
    if (value == 0) continue;
    const Cell cell{tile.x * kSide + i % kSide, tile.y * kSide + i / kSide};
    if (!bounds.contains(cell)) throw StoreError(what + " has known cells outside the grid's bounds");
    if (value > clamp || value < -clamp) throw StoreError(what + " holds log-odds beyond the grid's clamp");
    grid.set_log_odds(cell, value);
  }
}

void read_tiles(Database& database, OccupancyGrid& grid) {
  Statement row(database, "SELECT level, tx, ty, log_odds, crc32 FROM tiles ORDER BY level, ty, tx");
  while (row.step()) {
    require_level_zero(row, 0);
    const Cell tile{static_cast<int>(row.integer_within(1, -kMaxCellIndex / kSide, kMaxCellIndex / kSide)),
                    static_cast<int>(row.integer_within(2, -kMaxCellIndex / kSide, kMaxCellIndex / kSide))};
    const std::string what = "tile (" + std::to_string(tile.x) + ", " + std::to_string(tile.y) + ")";
    take_tile(grid, tile, unpacked(row, 3, kTileBytes, what), what);
  }
}

// The text of a JSON object, or nothing.
std::string annotations_in(const Statement& row, int column) {
  std::string text = row.text(column);
  if (!text.empty() && !exchange::is_json_object(text)) throw StoreError("column annotations holds no JSON object");
  return text;
}

using Histories = std::map<LandmarkId, Landmark>;  // templates and evidence alone

// A row of landmarks with its history, which is taken from the others.
Landmark landmark_in(Statement& row, Histories& histories) {
  Landmark landmark;
  landmark.id = row.integer_within(0, 1, kMaxId);
  if (auto history = histories.extract(landmark.id)) {
    landmark.templates = std::move(history.mapped().templates);
    landmark.evidence = std::move(history.mapped().evidence);
  }
  landmark.level = static_cast<int>(row.integer_within(1, -kMaxLevel, kMaxLevel));
  landmark.name = row.text(2);
  landmark.category = row.text(3);
  landmark.T_map_landmark = {row.real(4), row.real(5), row.real(6)};
  landmark.degree = row.real(7);
  landmark.sightings = static_cast<int>(row.integer_within(8, 0, kMaxInt));
  if (row.optional_real(9) || row.optional_real(10) || row.optional_real(11))
    landmark.access = Pose2{row.real(9), row.real(10), row.real(11)};
  return landmark;
}

void read_landmarks(Database& database, LandmarkGraph& graph, Histories& histories, int version) {
  Statement row(database, "SELECT * FROM landmarks ORDER BY id");
  while (row.step()) {
    Landmark landmark = landmark_in(row, histories);
    if (version >= 3) landmark.annotations = annotations_in(row, 12);
    graph.add(std::move(landmark));
  }
}

void read_retired_landmarks(Database& database, LandmarkGraph& graph, Histories& histories, int version) {
  Statement row(database, "SELECT * FROM retired_landmarks ORDER BY id");
  while (row.step()) {
    Landmark landmark = landmark_in(row, histories);
    if (version >= 3) landmark.annotations = annotations_in(row, 13);
    graph.add_retired({std::move(landmark), row.text(12)});
  }
}

void read_landmark_templates(Database& database, Histories& histories) {
  Statement row(database, "SELECT * FROM landmark_templates ORDER BY landmark, rank");
  while (row.step()) histories[row.integer(0)].templates.push_back({row.text(2), row.real(3), row.real(4)});
}

void read_landmark_evidence(Database& database, Histories& histories) {
  Statement row(database, "SELECT * FROM landmark_evidence ORDER BY landmark, category");
  while (row.step()) {
    const int matchings = static_cast<int>(row.integer_within(2, 0, kMaxInt));
    histories[row.integer(0)].evidence.push_back({row.text(1), matchings, row.real(3), row.real(4), row.real(5)});
  }
}

void read_all_landmarks(Database& database, LandmarkGraph& graph, int version) {
  Histories histories;
  in_table("landmark_templates", [&] { read_landmark_templates(database, histories); });
  if (version >= 2) in_table("landmark_evidence", [&] { read_landmark_evidence(database, histories); });
  in_table("landmarks", [&] { read_landmarks(database, graph, histories, version); });
  if (version >= 2) in_table("retired_landmarks", [&] { read_retired_landmarks(database, graph, histories, version); });
  in_table("landmark_templates", [&] {
    if (!histories.empty()) throw StoreError("there is no " + numbered("landmark", histories.begin()->first));
  });
}

std::vector<Pose2> read_trajectory(const Statement& row, int poses_column, const std::string& what) {
  const auto poses = static_cast<std::size_t>(row.integer_within(poses_column, 0, kMaxPoses));
  if (poses == 0 && row.blob(poses_column + 1).empty() && row.integer(poses_column + 2) == 0) return {};
  const std::string raw = unpacked(row, poses_column + 1, poses * kPoseBytes, what);
  std::vector<Pose2> trajectory(poses);
  for (std::size_t i = 0; i < poses; ++i) {
    const auto value = [&](std::size_t part) { return little_endian_at<double>(raw, i * kPoseBytes + part * 8); };
    trajectory[i] = {value(0), value(1), value(2)};
  }
  return trajectory;
}

void read_routes(Database& database, LandmarkGraph& graph, int version) {
  Statement row(database, "SELECT * FROM routes ORDER BY id");
  while (row.step()) {
    Route route;
    route.id = row.integer_within(0, 1, kMaxId);
    route.level = static_cast<int>(row.integer_within(1, -kMaxLevel, kMaxLevel));
    route.from = row.integer(2);
    route.to = row.integer(3);
    route.cost_m = row.real(4);
    route.driven = row.integer_within(5, 0, 1) != 0;
    route.closed = row.integer_within(6, 0, 1) != 0;
    route.trajectory = read_trajectory(row, 7, "the trajectory of " + numbered("route", route.id));
    if (version >= 3) {
      route.speed_limit_mps = row.optional_real(10);
      route.annotations = annotations_in(row, 11);
    }
    graph.add_route(std::move(route));
  }
}

void read_next_ids(Database& database, SavedMap& map, int version) {
  Statement row(database, "SELECT kind, id FROM next_ids ORDER BY kind");
  const auto next = [&row](const std::string& kind) {
    if (!row.step() || row.text(0) != kind) throw StoreError("has no row for " + kind);
    return row.integer_within(1, 1, kMaxId);
  };
  if (version >= 3) map.clusters.next_id = next("cluster");
  const LandmarkId next_landmark = next("landmark");
  map.graph.reserve_ids(next_landmark, next("route"));
}

// Takes one number off the front of the text.
double take_number(std::string_view& text) {
  double value = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) throw StoreError("a number is expected at \"" + std::string(text.substr(0, 20)) + "\"");
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  return value;
}

void take_separator(std::string_view& text, char separator) {
  if (!text.starts_with(separator))
    throw StoreError(std::string("'") + separator + "' is expected at \"" + std::string(text.substr(0, 20)) + "\"");
  text.remove_prefix(1);
}

Contour contour_of(const std::string& kind, std::string_view parameters) {
  if (kind != "circle" && kind != "polygon" && kind != "polygons")
    throw StoreError("kind \"" + kind + "\" is not circle, polygon or polygons");
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

std::vector<LandmarkShape> read_shapes(Database& database) {
  std::vector<LandmarkShape> shapes;
  Statement row(database, "SELECT category, kind, parameters FROM shapes ORDER BY number");
  while (row.step()) {
    const std::string category = row.text(0);
    in_table("shapes", [&] { shapes.push_back({category, contour_of(row.text(1), row.text(2))}); });
  }
  return shapes;
}

}  // namespace

SavedMap read_content(Database& database, int version) {
  SavedMap map;
  in_table("meta", [&] {
    Statement row(database, "SELECT key, value FROM meta ORDER BY key");
    while (row.step()) map.properties.emplace(row.text(0), row.text(1));
  });
  in_table("grid", [&] { map.grid = read_grid(database); });
  in_table("tiles", [&] { read_tiles(database, map.grid); });
  read_all_landmarks(database, map.graph, version);
  in_table("routes", [&] { read_routes(database, map.graph, version); });
  in_table("next_ids", [&] { read_next_ids(database, map, version); });
  if (version >= 3) in_table("clusters", [&] { read_clusters(database, map); });
  if (version >= 3) in_table("landmark_clusters", [&] { read_landmark_clusters(database, map); });
  map.shapes = read_shapes(database);
  in_table("driven_path", [&] {
    Statement row(database, "SELECT x_m, y_m, theta_rad FROM driven_path ORDER BY number");
    while (row.step()) map.driven_path.push_back({row.real(0), row.real(1), row.real(2)});
  });
  return map;
}

}  // namespace cairn::store

#include "maps/pictures/map_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "maps/base/text.hpp"
#include "maps/landmarks/route_count.hpp"
#include "maps/pictures/drawing/colours.hpp"
#include "maps/pictures/graph_layer.hpp"
#include "maps/pictures/robot_layer.hpp"

namespace cairn {
namespace {

using namespace pictures;

constexpr int kMarginCells = 5;
constexpr double kSurelyFreeNat = 2.0;  // P < 0.12
constexpr double kLandmarkMarginM = 0.1;
constexpr Stroke kTruthStroke{kPlanned, 2.0, 0.9};
constexpr Fill kAreaFill{kGoal, 0.22};
constexpr Stroke kDrivenStroke{kDriven, 1.5, 0.9};
constexpr Stroke kPlannedStroke{kPlanned, 3.5, 0.95};
constexpr Stroke kDoorStroke{kClosed, 3.0, 0.9};
constexpr Stroke kNearMissStroke{kPlanned, 2.0, 0.9};
constexpr double kNearMissPx = 9.0;
constexpr Stroke kMoverStroke{kGoal, 1.5, 0.6, 6.0};

// The box of cells that are worth showing: occupied or surely free. Single stray readings leave faint
// traces far behind the walls, which would only make the map small. Of a map without such cells, all.
CellBox known_box(const OccupancyGrid& grid) {
  const double conservatively_free = -std::min(kSurelyFreeNat, grid.clamp_nat() / 2.0) * kLogOddsPerNat;
  const CellBox known = box_where(grid.bounds(), [&](Cell cell) {
    const LogOdds value = grid.log_odds(cell);
    return value < conservatively_free || OccupancyThresholds{}.state(value) == CellState::occupied;
  });
  return known.empty() ? grid.bounds() : known;
}

RobotShape shape_of(const MapPicture& picture) {
  return {picture.robot_polygon_m, picture.robot_radius_m};
}

// All that is drawn; the grid's part in whole cells.
Extent extent_of(const MapPicture& picture, const GraphLayer& graph) {
  Extent extent = graph.extent();
  if (!extent.is_empty) {
    extent.include(extent.min_m, kLandmarkMarginM);
    extent.include(extent.max_m, kLandmarkMarginM);
  }
  for (const auto* path : {&picture.driven, &picture.planned})
    for (const Point& p : *path) extent.include(p, kLandmarkMarginM);
  for (const auto* paths : {&picture.doors, &picture.mover_paths, &picture.truth})
    for (const std::vector<Point>& path : *paths)
      for (const Point& p : path) extent.include(p, kLandmarkMarginM);
  for (const MarkedArea& area : picture.areas)
    for (const Point& p : {area.min_m, area.max_m}) extent.include(p, kLandmarkMarginM);
  for (const Pose2& pose : picture.robot_path) extent.include(pose.position(), shape_of(picture).reach_m());
  for (const auto& place : {picture.start, picture.goal})
    if (place) extent.include(*place, 2.0 * kLandmarkMarginM);
  if (picture.robot) extent.include(picture.robot->position(), picture.robot_radius_m + kLandmarkMarginM);
  if (picture.grid == nullptr) return extent;

  const OccupancyGrid& grid = *picture.grid;
  CellBox cells = known_box(grid);
  if (!extent.is_empty) {
    const Cell max = grid.cell_at(extent.max_m);
    cells = united(cells, {grid.cell_at(extent.min_m), {max.x + 1, max.y + 1}});
  }
  if (cells.empty()) return extent;
  cells = cells.grown(kMarginCells);
  const Point half(grid.cell_m() / 2.0, grid.cell_m() / 2.0);
  Extent whole;
  whole.include(grid.centre_of(cells.min) - half);
  whole.include(grid.centre_of(cells.max) - half);
  return whole;
}

CellBox cells_of(const OccupancyGrid& grid, const MapFrame& frame) {
  const Point inside(grid.cell_m() / 2.0, grid.cell_m() / 2.0);
  const Cell min = grid.cell_at(frame.point_at({frame.box.min.x(), frame.box.max.y()}) + inside);
  const Cell max = grid.cell_at(frame.point_at({frame.box.max.x(), frame.box.min.y()}) + inside);
  return {min, max};
}

// Of blocks that the picture cannot show apart, occupied before free before unknown.
CellImage three_greys_of(const OccupancyGrid& grid, const CellBox& cells) {
  return image_of(cells, [&](const CellBox& block) {
    bool is_free = false;
    for (int y = block.min.y; y < block.max.y; ++y)
      for (int x = block.min.x; x < block.max.x; ++x) {
        const CellState state = grid.state({x, y});
        if (state == CellState::occupied) return colour_of_ol(255);
        is_free = is_free || state == CellState::free;
      }
    return colour_of_ol(is_free ? 0 : kUnknownOl);
  });
}

void draw_grid(Canvas& canvas, const MapFrame& frame, const MapPicture& picture) {
  const OccupancyGrid* grid = picture.grid;
  canvas.fill_box(frame.box, {grid == nullptr ? kWhite : colour_of_ol(kUnknownOl)});
  if (grid == nullptr) return;
  const CellBox cells = intersected(cells_of(*grid, frame), grid->bounds());
  if (!cells.empty())
    canvas.image(pixel_box_of(frame, *grid, cells),
                 picture.has_three_greys ? three_greys_of(*grid, cells) : image_of(*grid, cells));
}

PixelBox box_of(const MarkedArea& area, const MapFrame& frame) {
  const Pixel a = frame.pixel_of(area.min_m);
  const Pixel b = frame.pixel_of(area.max_m);
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

void draw_areas(Canvas& canvas, const MapPicture& picture, const MapFrame& frame) {
  constexpr TextStyle kText{kGoal, 14.0, Align::centre, true};
  for (const MarkedArea& area : picture.areas) {
    if (!is_drawable(area.min_m) || !is_drawable(area.max_m)) continue;
    const PixelBox box = box_of(area, frame);
    canvas.fill_box(box, kAreaFill);
    if (Canvas::text_width_px(area.words, kText) < box.width()) canvas.text(box.centre(), area.words, kText);
  }
}

void draw_start(Canvas& canvas, const Pixel& at) {
  canvas.fill_disc(at, 8.0, {kWhite});
  canvas.fill_disc(at, 6.5, {kStart});
  canvas.fill_polygon(
      std::array{Pixel(at + Pixel(-2.2, -3.5)), Pixel(at + Pixel(3.8, 0.0)), Pixel(at + Pixel(-2.2, 3.5))}, {kWhite});
}

void draw_goal(Canvas& canvas, const Pixel& at) {
  canvas.fill_disc(at, 8.5, {kWhite});
  canvas.ring(at, 6.5, {kGoal, 2.0});
  canvas.fill_disc(at, 3.0, {kGoal});
}

void draw_robot(Canvas& canvas, const Pixel& at, double radius_px, double theta_rad) {
  const Pixel nose = at + radius_px * Pixel(std::cos(theta_rad), -std::sin(theta_rad));
  canvas.fill_disc(at, radius_px, {kRobot, 0.35});
  canvas.ring(at, radius_px, {kRobot, 2.0});
  canvas.line(std::array{at, nose}, {kRobot, 2.0});
}

double robot_radius_px(const MapPicture& picture, const MapFrame& frame) {
  return std::max(5.0, picture.robot_radius_m * frame.px_per_m);
}

// Walls and other drawn things should stay visible under labels.
double darkness_of(const OccupancyGrid* grid, const MapFrame& frame, const PixelBox& box) {
  if (grid == nullptr) return 0.0;
  constexpr int kAcross = 12;
  constexpr int kDown = 4;
  int dark = 0;
  for (int i = 0; i <= kAcross; ++i)
    for (int k = 0; k <= kDown; ++k) {
      const Pixel at = box.min + Pixel(box.width() * i / kAcross, box.height() * k / kDown);
      if (grid->state(grid->cell_at(frame.point_at(at))) == CellState::occupied) ++dark;
    }
  return static_cast<double>(dark) / ((kAcross + 1) * (kDown + 1));
}

void draw_near_miss(Canvas& canvas, const Pixel& at) {
  canvas.ring(at, kNearMissPx, kNearMissStroke);
}

// Labels only of a few: many would hide the map.
void draw_near_misses(Canvas& canvas, const MapPicture& picture, const MapFrame& frame, LabelPlacer& placer) {
  constexpr std::size_t kMaxMissLabels = 12;
  constexpr TextStyle kText{kInk, 13.0};
  for (const MarkedPlace& place : picture.near_misses) draw_near_miss(canvas, frame.pixel_of(place.at_m));
  if (picture.near_misses.size() > kMaxMissLabels) return;
  for (const MarkedPlace& place : picture.near_misses) {
    const Pixel size(Canvas::text_width_px(place.words, kText) + 10.0, 20.0);
    const auto box = placer.place(frame.pixel_of(place.at_m), kNearMissPx, size);
    if (!box) continue;
    canvas.fill_box(*box, {kWhite, 0.85}, 4.0);
    canvas.text(box->centre(), place.words, {kText.colour, kText.size_px, Align::centre});
  }
}

void draw_marks(Canvas& canvas, const MapPicture& picture, const MapFrame& frame) {
  if (picture.robot)
    draw_robot(canvas, frame.pixel_of(picture.robot->position()), robot_radius_px(picture, frame),
               picture.robot->theta_rad);
  if (picture.start) draw_start(canvas, frame.pixel_of(*picture.start));
  if (picture.goal) draw_goal(canvas, frame.pixel_of(*picture.goal));
}

LabelPlacer placer_for(const MapPicture& picture, const MapFrame& frame) {
  LabelPlacer placer(frame.box, [&](const PixelBox& box) { return 1.5 * darkness_of(picture.grid, frame, box); });
  placer.keep_line_clear(frame.pixels_of(picture.planned));
  placer.avoid_line(frame.pixels_of(picture.driven), 0.15);
  for (const auto& place : {picture.start, picture.goal})
    if (place) {
      const Pixel at = frame.pixel_of(*place);
      placer.keep_clear({at - Pixel(9.0, 9.0), at + Pixel(9.0, 9.0)});
    }
  if (picture.robot) {
    const Pixel at = frame.pixel_of(picture.robot->position());
    const double r = robot_radius_px(picture, frame);
    placer.avoid({at - Pixel(r, r), at + Pixel(r, r)}, 3.0);
  }
  return placer;
}

std::vector<LegendEntry> legend_of(const MapPicture& picture, const GraphLayer& graph) {
  std::vector<LegendEntry> entries;
  if (picture.grid != nullptr) {
    entries.push_back(swatch_entry("free", colour_of_ol(0)));
    entries.push_back(swatch_entry("unknown", colour_of_ol(kUnknownOl)));
    entries.push_back(swatch_entry("occupied", colour_of_ol(255)));
  }
  for (LegendEntry& entry : graph.legend()) entries.push_back(std::move(entry));
  if (!picture.truth.empty()) entries.push_back(line_entry("truth", kTruthStroke));
  if (!picture.driven.empty()) entries.push_back(line_entry("driven", kDrivenStroke));
  if (!picture.planned.empty()) entries.push_back(line_entry("planned", kPlannedStroke));
  if (!picture.doors.empty()) entries.push_back(line_entry("door", kDoorStroke));
  if (!picture.mover_paths.empty()) entries.push_back(line_entry("where others go", kMoverStroke));
  if (!picture.near_misses.empty()) entries.push_back({"nearly a landmark", draw_near_miss});
  if (picture.start) entries.push_back({"start", draw_start});
  if (picture.goal) entries.push_back({"goal", draw_goal});
  if (!picture.robot_path.empty() && shape_of(picture).reach_m() > 0.0)
    entries.push_back(robot_entry(shape_of(picture)));
  if (picture.robot)
    entries.push_back({"robot", [](Canvas& canvas, const Pixel& at) { draw_robot(canvas, at, 8.0, 0.0); }});
  return entries;
}

std::string subtitle_of(const MapPicture& picture) {
  std::string words;
  const auto add = [&words](const std::string& part) { words += (words.empty() ? "" : ",  ") + part; };
  if (picture.grid != nullptr) {
    const CellBox box = known_box(*picture.grid);
    const double cell_m = picture.grid->cell_m();
    add(short_text(box.width() * cell_m, 1) + " x " + short_text(box.height() * cell_m, 1) + " m");
    add("cells of " + trimmed_text(cell_m * 100.0, 2) + " cm");
  }
  if (picture.graph != nullptr) {
    add(counted(picture.graph->landmarks().size(), "landmark"));
    add(counted_routes(*picture.graph));
  }
  return words;
}

}  // namespace

void write_map_picture(const std::filesystem::path& file, const MapPicture& wanted) {
  MapPicture picture = wanted;
  if (picture.grid != nullptr && picture.grid->bounds().empty()) picture.grid = nullptr;
  const LandmarkGraph no_graph;
  const GraphLayer graph(picture.graph == nullptr ? no_graph : *picture.graph, picture.shapes, picture.clusters);
  const double cell_m = picture.grid == nullptr ? 1.0 : picture.grid->cell_m();
  const MapFrame frame = frame_of(extent_of(picture, graph), cell_m, picture.longer_side_px);
  const int width_px = page_width_px(frame);
  const Legend legend(legend_of(picture, graph), width_px - frame.box.min.x() - kPageMarginPx - kScaleBarRoomPx);
  const double legend_top_px = below_frame_px(frame) + 10.0;
  const double legend_px = std::max(24.0, legend.height_px());
  Canvas canvas(width_px, static_cast<int>(std::ceil(legend_top_px + legend_px + 12.0)), kPaper);

  draw_grid(canvas, frame, picture);
  for (const std::vector<Point>& outline : picture.truth) canvas.line(frame.pixels_of(outline), kTruthStroke);
  draw_areas(canvas, picture, frame);
  for (const std::vector<Point>& path : picture.mover_paths) canvas.line(frame.pixels_of(path), kMoverStroke);
  for (const std::vector<Point>& leaf : picture.doors) canvas.line(frame.pixels_of(leaf), kDoorStroke);
  canvas.line(frame.pixels_of(picture.driven), kDrivenStroke);
  graph.draw_routes(canvas, frame);
  graph.draw_landmarks(canvas, frame);
  LabelPlacer placer = placer_for(picture, frame);
  graph.draw_labels(canvas, frame, placer, picture.planned_landmarks);
  draw_near_misses(canvas, picture, frame, placer);
  draw_robot_along(canvas, frame, shape_of(picture), picture.robot_path);
  canvas.line(frame.pixels_of(picture.planned), kPlannedStroke);
  draw_marks(canvas, picture, frame);
  draw_border(canvas, frame);
  draw_title(canvas, picture.title, subtitle_of(picture));
  legend.draw(canvas, {frame.box.min.x(), legend_top_px});
  draw_scale_bar(canvas, frame, {width_px - kPageMarginPx, legend_top_px + 12.0});
  canvas.write_png(file);
}

}  // namespace cairn

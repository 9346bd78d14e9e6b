// Draws routes of the module `ompl`: route_pictures FOLDER [OFFICE.cairn]
// On two maps of the Moving AI benchmarks (CAIRN_DATA) beside Lazy Theta*'s, and on a saved map for a disc and a car.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>

#include "maps/pictures/drawing/canvas.hpp"
#include "maps/pictures/drawing/colours.hpp"
#include "maps/pictures/drawing/map_frame.hpp"
#include "maps/store/map_store.hpp"
#include "planners/common/disc_space/disc_space.hpp"
#include "tests/bench/graph/unpacked.hpp"
#include "tests/bench/routes/grid_router.hpp"
#include "tests/bench/routes/lazy_theta_star.hpp"
#include "tests/bench/routes/moving_ai_set.hpp"
#include "tests/bench/routes/path_check.hpp"

namespace cairn {
namespace {

using namespace pictures;

constexpr int kWidth_px = 900;
constexpr double kTop_px = 64.0;
constexpr double kMargin_px = 10.0;
constexpr Colour kTheirs{30, 110, 200};
constexpr std::size_t kTried = 60;  // instances, of which the one that shows most is drawn
constexpr double kLong_cells = 200.0;
constexpr double kTooLong_cells = 650.0;  // to show where the two part

// A page with one map on it, as wide as the page.
class Page {
 public:
  Page(const OccupancyGrid& grid, const Extent& extent, const std::string& title)
      : frame_(frame_for(extent)),
        canvas_(kWidth_px, static_cast<int>(std::ceil(frame_.box.max.y() + kMargin_px)), kPaper) {
    canvas_.text({kMargin_px, 18.0}, title, {kInk, 17.0, Align::left, true});
    const CellBox cells =
        intersected({grid.cell_at(extent.min_m), grid.cell_at(extent.max_m) + Cell{1, 1}}, grid.bounds());
    canvas_.fill_box(frame_.box, {colour_of_ol(kUnknownOl)});
    canvas_.image(pixel_box_of(frame_, grid, cells), image_of(grid, cells));
  }

  [[nodiscard]] Canvas& canvas() { return canvas_; }
  [[nodiscard]] const MapFrame& frame() const { return frame_; }

  // With a line of the legend.
  void draw_path(const std::vector<Point>& path, Colour colour, double width_px, const std::string& words) {
    canvas_.line(frame_.pixels_of(path), {colour, width_px, 0.95, 0.0});
    const double y = 46.0;
    canvas_.line(std::array{Pixel(legend_px_, y), Pixel(legend_px_ + 26.0, y)}, {colour, 4.0, 1.0, 0.0});
    canvas_.text({legend_px_ + 33.0, y}, words, {kInk, 14.0, Align::left, false});
    legend_px_ += 60.0 + Canvas::text_width_px(words, {kInk, 14.0, Align::left, false});
  }
  void draw_ends(const Point& from, const Point& to) {
    for (const auto& [p, colour] : {std::pair(from, kStart), std::pair(to, kGoal)}) {
      canvas_.fill_disc(frame_.pixel_of(p), 8.0, {kWhite});
      canvas_.fill_disc(frame_.pixel_of(p), 6.0, {colour});
    }
  }

 private:
  static MapFrame frame_for(const Extent& extent) {
    MapFrame frame;
    const Point size_m = extent.max_m - extent.min_m;
    frame.min_m = extent.min_m;
    frame.px_per_m = (kWidth_px - 2.0 * kMargin_px) / size_m.x();
    frame.box.min = {kMargin_px, kTop_px};
    frame.box.max = frame.box.min + Pixel(frame.px_per_m * size_m);
    return frame;
  }

  MapFrame frame_;
  Canvas canvas_;
  double legend_px_ = kMargin_px;
};

struct Comparison {
  MovingAiInstance instance;
  std::vector<Point> ours;
  std::vector<Point> lazy;
  double eight = 0.0;
};

std::vector<Point> points_of(const PlainCells& cells, const PlainPath& path) {
  std::vector<Point> points;
  for (const Cell cell : path.cells) points.push_back(cells.centre_m(cell));
  return points;
}

// The instance on which the two differ most, of those tried.
Comparison max_telling(const PlainCells& cells, const GridRouter& router, const std::filesystem::path& map) {
  PlainSearches plain(cells);
  Comparison best;
  double max_m = -1.0;
  for (const MovingAiInstance& instance : moving_ai_instances(scenario_of(map), cells.height, kTried, 1)) {
    if (instance.optimum < kLong_cells || instance.optimum > kTooLong_cells) continue;
    const PlanResult result = router.plan(cells.centre_m(instance.from), cells.centre_m(instance.to));
    if (result.outcome != PlanOutcome::solved) continue;
    const std::vector<Point> lazy = points_of(cells, plain.lazy_theta_star(instance.from, instance.to));
    const double gain_m = length_of_m(lazy) - result.length_m;
    if (gain_m <= max_m) continue;
    max_m = gain_m;
    best = {instance, cairn::points_of(result), lazy, plain.a_star(instance.from, instance.to).length};
  }
  return best;
}

void draw_moving_ai(const std::string& set, const std::string& name, const std::filesystem::path& file) {
  const auto map = data_folder() / "movingai" / set / (name + ".map.gz");
  const PlainCells cells = moving_ai_cells(map);
  const GridRouter router(grid_of(cells), 0.0);
  const Comparison shown = max_telling(cells, router, map);
  Extent extent;
  for (const auto* path : {&shown.ours, &shown.lazy})
    for (const Point& p : *path) extent.include(p, 12.0);
  extent.min_m = extent.min_m.cwiseMax(Point(0.0, 0.0)).array().floor();
  extent.max_m = extent.max_m.cwiseMin(Point(cells.width, cells.height)).array().ceil();
  const double more_m = 0.5 * ((extent.max_m - extent.min_m).y() - (extent.max_m - extent.min_m).x());
  if (more_m > 0.0) {  // no page is much higher than wide
    extent.min_m.x() = std::max(0.0, std::floor(extent.min_m.x() - more_m));
    extent.max_m.x() = std::min<double>(cells.width, std::ceil(extent.max_m.x() + more_m));
  }
  Page page(router.grid(), extent,
            set + "/" + name + ": a point from cell to cell, over eight neighbours " + short_text(shown.eight, 2));
  page.draw_path(shown.lazy, kTheirs, 3.0, "Lazy Theta* " + short_text(length_of_m(shown.lazy), 2));
  page.draw_path(shown.ours, kPlanned, 3.0, "ompl " + short_text(length_of_m(shown.ours), 2));
  page.draw_ends(cells.centre_m(shown.instance.from), cells.centre_m(shown.instance.to));
  page.canvas().write_png(file);
  std::printf("%s: (%d, %d) to (%d, %d)\n", file.c_str(), shown.instance.from.x, shown.instance.from.y,
              shown.instance.to.x, shown.instance.to.y);
}

Extent extent_of(const OccupancyGrid& grid) {
  Extent extent;
  const CellBox box = grid.bounds();
  const Point half(0.5 * grid.cell_m(), 0.5 * grid.cell_m());
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (grid.state({x, y}) == CellState::occupied) {
        extent.include(grid.centre_of({x, y}) - half, 0.3);
        extent.include(grid.centre_of({x, y}) + half, 0.3);
      }
  return extent;
}

// The place where the disc fits that is farthest from a point, of those it can get to.
PlanResult to_the_farthest_place(const GridRouter& router, const Point& from, double radius_m) {
  const OccupancyGrid& grid = router.grid();
  const DiscSpace space(grid, {});
  std::vector<Point> places;
  const CellBox box = grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (space.fits(grid.centre_of({x, y}), radius_m)) places.push_back(grid.centre_of({x, y}));
  std::sort(places.begin(), places.end(),
            [&](const Point& a, const Point& b) { return (a - from).norm() > (b - from).norm(); });
  for (const Point& place : places)
    if (PlanResult result = router.plan(from, place); result.outcome == PlanOutcome::solved) return result;
  throw std::runtime_error("the office: no place can be reached");
}

// From where the robot set out.
void draw_office(const std::filesystem::path& saved, const std::filesystem::path& file) {
  const SavedMap map = load_map(saved);
  if (map.driven_path.empty()) throw std::runtime_error(saved.string() + ": has no driven path");
  constexpr double kRadius_m = 0.22;
  const GridRouter router(map.grid, kRadius_m);
  const PlanResult result = to_the_farthest_place(router, map.driven_path.front().position(), kRadius_m);
  Page page(router.grid(), extent_of(map.grid), "The office as the sonars saw it: a disc of 0.22 m");
  const std::vector<Point> path = cairn::points_of(result);
  page.canvas().line(page.frame().pixels_of(path), {kPlanned, 2.0 * kRadius_m * page.frame().px_per_m, 0.3, 0.0});
  page.draw_path(path, kPlanned, 3.0,
                 short_text(result.length_m, 2) + " m, " + short_text(result.clearance_m, 2) +
                     " m from its edge to what is not free");
  page.draw_ends(path.front(), path.back());
  page.canvas().write_png(file);
}

// The same places for a car of 0.40 x 0.24 m that turns in 0.40 m and arrives facing the way it came from.
void draw_office_car(const std::filesystem::path& saved, const std::filesystem::path& file) {
  const SavedMap map = load_map(saved);
  RobotModel car;
  car.polygon_m = {{0.30, 0.12}, {-0.10, 0.12}, {-0.10, -0.12}, {0.30, -0.12}};  // about its rear axle
  car.radius_m = std::hypot(0.30, 0.12);
  const GridRouter router(map.grid, car, "{kinematics: reeds_shepp, footprint: robot, turning_radius_m: 0.4}");
  PlanRequest request;
  request.from.pose = map.driven_path.front();
  request.from.heading_matters = request.to.heading_matters = true;
  request.radius_m = car.radius_m;
  const GridRouter disc(map.grid, 0.35);
  const PlanResult there = to_the_farthest_place(disc, request.from.pose->position(), 0.35);
  const Point back = request.from.pose->position() - there.path.back().position();
  request.to.pose = Pose2{there.path.back().x_m, there.path.back().y_m, std::atan2(back.y(), back.x())};
  const PlanResult result = router.plan(request);
  if (result.outcome != PlanOutcome::solved) throw std::runtime_error("the car: " + result.reason);
  Page page(router.grid(), extent_of(map.grid), "The office as the sonars saw it: a car of 0.40 x 0.24 m, Reeds-Shepp");
  for (const Pose2& pose : result.path) {
    std::vector<Point> corners;
    for (const Point& p : car.polygon_m) corners.push_back(pose * p);
    page.canvas().fill_polygon(page.frame().pixels_of(corners), {kPlanned, 0.10});
    corners.push_back(corners.front());
    page.canvas().line(page.frame().pixels_of(corners), {kPlanned, 1.0, 0.5, 0.0});
  }
  page.draw_path(cairn::points_of(result), kRobot, 3.0,
                 "its rear axle, " + short_text(result.length_m, 2) + " m; turning radius 0.40 m");
  page.draw_ends(result.path.front().position(), result.path.back().position());
  page.canvas().write_png(file);
}

}  // namespace
}  // namespace cairn

int main(int count, char** arguments) {
  if (count != 2 && count != 3) {
    std::fprintf(stderr, "usage: route_pictures FOLDER [OFFICE.cairn]\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = arguments[1];
    cairn::draw_moving_ai("mazes", "maze512-8-0", folder / "routes_maze.png");
    cairn::draw_moving_ai("cities", "Boston_0_512", folder / "routes_city.png");
    if (count == 3) {
      cairn::draw_office(arguments[2], folder / "routes_office_disc.png");
      cairn::draw_office_car(arguments[2], folder / "routes_office_car.png");
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "route_pictures: %s\n", error.what());
    return 2;
  }
}

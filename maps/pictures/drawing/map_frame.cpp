#include "maps/pictures/drawing/map_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "maps/pictures/drawing/colours.hpp"

namespace cairn::pictures {
namespace {

constexpr int kMinPageWidthPx = 560;
constexpr double kFrameTopPx = 62.0;
constexpr double kFrameLeftPx = 48.0;
constexpr double kTickRoomPx = 22.0;
constexpr double kMinTickDistancePx = 70.0;
constexpr int kMaxImageSide = 2000;

// Mean OL of a block of cells.
double mean_ol(const OccupancyGrid& grid, const CellBox& block) {
  int sum = 0;
  for (int y = block.min.y; y < block.max.y; ++y)
    for (int x = block.min.x; x < block.max.x; ++x) sum += grid.ol({x, y});
  return static_cast<double>(sum) / (block.width() * block.height());
}

void draw_ticks(Canvas& canvas, const MapFrame& frame, bool along_x) {
  const double step_m = round_at_least(kMinTickDistancePx / frame.px_per_m);
  const Point max_m = frame.point_at({frame.box.max.x(), frame.box.min.y()});
  const int axis = along_x ? 0 : 1;
  const TextStyle style{kFaintInk, 11.0, along_x ? Align::centre : Align::right};
  const double slack_m = 0.5 / frame.px_per_m;
  for (double k = std::ceil((frame.min_m[axis] - slack_m) / step_m); k * step_m <= max_m[axis] + slack_m; ++k) {
    Point at_m = frame.min_m;
    at_m[axis] = k * step_m;
    const Pixel on_border = frame.pixel_of(at_m);
    const Pixel outwards = along_x ? Pixel(0.0, 1.0) : Pixel(-1.0, 0.0);
    canvas.line(std::array{on_border, Pixel(on_border + 5.0 * outwards)}, {kFrame, 1.0});
    canvas.text(on_border + (along_x ? 14.0 : 9.0) * outwards, short_text(k * step_m, decimals_for(step_m)), style);
  }
}

}  // namespace

double round_at_least(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= value * (1.0 - 1e-9)) return step * decade;
  return 10.0 * decade;
}

int decimals_for(double step) {
  return std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
}

bool is_drawable(const Point& p_map) {
  return p_map.allFinite() && p_map.cwiseAbs().maxCoeff() < 1e6;
}

void Extent::include(const Point& p, double margin_m) {
  if (!is_drawable(p)) return;
  const Point margin(margin_m, margin_m);
  min_m = is_empty ? p - margin : Point(min_m.cwiseMin(p - margin));
  max_m = is_empty ? p + margin : Point(max_m.cwiseMax(p + margin));
  is_empty = false;
}

std::vector<Pixel> MapFrame::pixels_of(std::span<const Point> points_map) const {
  std::vector<Pixel> pixels;
  for (const Point& p : points_map)
    if (is_drawable(p)) pixels.push_back(pixel_of(p));
  return pixels;
}

MapFrame frame_of(const Extent& extent, double cell_m, double longer_side_px) {
  const Point size_m = (extent.max_m - extent.min_m).cwiseMax(Point(cell_m, cell_m));
  double px_per_cell = longer_side_px / size_m.maxCoeff() * cell_m;
  if (px_per_cell >= 2.5) px_per_cell = std::floor(2.0 * px_per_cell) / 2.0;
  MapFrame frame;
  frame.min_m = extent.min_m;
  frame.px_per_m = px_per_cell / cell_m;
  frame.box.min = {kFrameLeftPx, kFrameTopPx};
  frame.box.max = frame.box.min + (size_m * frame.px_per_m).array().round().matrix();
  return frame;
}

void draw_border(Canvas& canvas, const MapFrame& frame) {
  const PixelBox& box = frame.box;
  canvas.outline(box, {kFrame, 1.0});
  draw_ticks(canvas, frame, true);
  draw_ticks(canvas, frame, false);
  constexpr double kBesideSubtitlePx = 480.0;  // a narrower map has no room for both
  if (box.max.x() - box.min.x() > kBesideSubtitlePx)
    canvas.text({box.max.x(), box.min.y() - 11.0}, "x, y in metres", {kFaintInk, 11.0, Align::right});
}

void draw_title(Canvas& canvas, const std::string& title, const std::string& subtitle) {
  canvas.text({kFrameLeftPx, 24.0}, title, {kInk, 20.0, Align::left, true});
  canvas.text({kFrameLeftPx, 46.0}, subtitle, {kFaintInk, 12.0});
}

void draw_scale_bar(Canvas& canvas, const MapFrame& frame, const Pixel& right_end) {
  const double length_m = round_at_least(80.0 / frame.px_per_m);
  const Pixel left_end = right_end - Pixel(length_m * frame.px_per_m, 0.0);
  canvas.line(std::array{left_end, right_end}, {kInk, 2.0});
  for (const Pixel& end : {left_end, right_end})
    canvas.line(std::array{Pixel(end - Pixel(0.0, 4.0)), Pixel(end + Pixel(0.0, 4.0))}, {kInk, 2.0});
  canvas.text(left_end - Pixel(8.0, 0.0), short_text(length_m, decimals_for(length_m)) + " m",
              {kInk, 12.0, Align::right});
}

int page_width_px(const MapFrame& frame) {
  return std::max(kMinPageWidthPx, static_cast<int>(std::ceil(frame.box.max.x() + kPageMarginPx)));
}

double below_frame_px(const MapFrame& frame) {
  return frame.box.max.y() + kTickRoomPx;
}

CellImage image_of(const CellBox& box, const std::function<Colour(const CellBox&)>& colour_of_block) {
  const int block = 1 + (std::max(box.width(), box.height()) - 1) / kMaxImageSide;
  CellImage image{(box.width() + block - 1) / block, (box.height() + block - 1) / block, {}};
  for (int row = image.height - 1; row >= 0; --row)
    for (int column = 0; column < image.width; ++column) {
      const Cell min{box.min.x + column * block, box.min.y + row * block};
      const CellBox cells = intersected({min, {min.x + block, min.y + block}}, box);
      image.colours.push_back(colour_of_block(cells));
    }
  return image;
}

CellImage image_of(const OccupancyGrid& grid, const CellBox& box) {
  return image_of(box, [&](const CellBox& block) { return colour_of_ol(mean_ol(grid, block)); });
}

PixelBox pixel_box_of(const MapFrame& frame, const OccupancyGrid& grid, const CellBox& box) {
  const Point half(grid.cell_m() / 2.0, grid.cell_m() / 2.0);
  const Pixel a = frame.pixel_of(grid.centre_of(box.min) - half);
  const Pixel b = frame.pixel_of(grid.centre_of(box.max) - half);
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

std::string short_text(double value, int decimals) {
  return fmt::format("{:.{}f}", value == 0.0 ? 0.0 : value, decimals);
}

std::string trimmed_text(double value, int decimals) {
  std::string text = short_text(value, decimals);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

}  // namespace cairn::pictures

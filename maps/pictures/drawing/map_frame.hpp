// The part of a picture that shows the plane: where a point of the map is drawn, its border with metres
// along it, its scale bar; and the page about it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"
#include "maps/pictures/drawing/canvas.hpp"

namespace cairn::pictures {

// Finite, and not beyond any place on earth: grids are looked up with whole numbers.
[[nodiscard]] bool is_drawable(const Point& p_map);

struct Extent {
  Point min_m{0.0, 0.0};
  Point max_m{0.0, 0.0};
  bool is_empty = true;

  void include(const Point& p, double margin_m = 0.0);  // what is not drawable is passed over
};

struct MapFrame {
  PixelBox box;
  Point min_m{0.0, 0.0};
  double px_per_m = 1.0;

  [[nodiscard]] Pixel pixel_of(const Point& p_map) const {
    return {box.min.x() + (p_map.x() - min_m.x()) * px_per_m, box.max.y() - (p_map.y() - min_m.y()) * px_per_m};
  }
  // Points that are not drawable are left out.
  [[nodiscard]] std::vector<Pixel> pixels_of(std::span<const Point> points_map) const;
  [[nodiscard]] Point point_at(const Pixel& pixel) const {
    return {min_m.x() + (pixel.x() - box.min.x()) / px_per_m, min_m.y() + (box.max.y() - pixel.y()) / px_per_m};
  }
};

inline constexpr double kPageMarginPx = 20.0;

inline constexpr double kLongerSidePx = 930.0;
// Its longer side is about that many pixels, and cells of cell_m a whole or half number of pixels where possible.
[[nodiscard]] MapFrame frame_of(const Extent& extent, double cell_m, double longer_side_px = kLongerSidePx);
// Border, ticks and metres.
void draw_border(Canvas& canvas, const MapFrame& frame);
void draw_title(Canvas& canvas, const std::string& title, const std::string& subtitle);
// Right-aligned at the point, as long as a round number of metres.
void draw_scale_bar(Canvas& canvas, const MapFrame& frame, const Pixel& right_end);
inline constexpr double kScaleBarRoomPx = 230.0;

[[nodiscard]] int page_width_px(const MapFrame& frame);
// Upper edge of what follows below the map.
[[nodiscard]] double below_frame_px(const MapFrame& frame);

// The smallest box that holds all cells of another of which is_shown(Cell) is true.
template <class IsShown>
[[nodiscard]] CellBox box_where(const CellBox& bounds, IsShown is_shown) {
  CellBox shown;
  for (int y = bounds.min.y; y < bounds.max.y; ++y)
    for (int x = bounds.min.x; x < bounds.max.x; ++x)
      if (!shown.contains({x, y}) && is_shown(Cell{x, y})) shown = united(shown, {{x, y}, {x + 1, y + 1}});
  return shown;
}

// The box as colours, with y up: one a cell, or one a block of cells when the box is far larger than a picture.
[[nodiscard]] CellImage image_of(const CellBox& box, const std::function<Colour(const CellBox&)>& colour_of_block);
// By the mean of the cells.
[[nodiscard]] CellImage image_of(const OccupancyGrid& grid, const CellBox& box);
[[nodiscard]] PixelBox pixel_box_of(const MapFrame& frame, const OccupancyGrid& grid, const CellBox& box);

// 1, 2 or 5 times a power of ten, at least this large; and the decimals to write it with.
[[nodiscard]] double round_at_least(double value);
[[nodiscard]] int decimals_for(double step);
// A number with this many decimals, and with at most this many.
[[nodiscard]] std::string short_text(double value, int decimals);
[[nodiscard]] std::string trimmed_text(double value, int decimals);

}  // namespace cairn::pictures

#include "maps/pictures/coarse_picture.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "maps/pictures/drawing/colours.hpp"
#include "maps/pictures/drawing/legend.hpp"
#include "maps/pictures/drawing/map_frame.hpp"

namespace cairn {
namespace {

using namespace pictures;

constexpr double kMinPxForValues = 26.0;
constexpr Colour kTrigger{211, 60, 75};
constexpr Colour kRegion{239, 140, 0};
constexpr double kScaleBarPx = 300.0;
constexpr double kBarRoomPx = 52.0;

PixelBox block_of(const MapFrame& frame, const CoarsePicture& picture, Cell coarse) {
  return pixel_box_of(frame, *picture.grid, picture.coarse->fine_box(coarse));
}

// As on the map picture: what is occupied or surely free, not the faint traces behind the walls.
CellBox shown_box(const CoarsePicture& picture) {
  constexpr double kSurelyFreeOl = 30.0;
  constexpr double kOccupiedOl = 165.0;
  const CellBox bounds = picture.coarse->bounds();
  CellBox shown = box_where(bounds, [&](Cell cell) {
    const double ol = picture.coarse->ol(cell);
    return ol < kSurelyFreeOl || ol > kOccupiedOl;
  });
  for (const Cell coarse : picture.region) shown = united(shown, {coarse, {coarse.x + 1, coarse.y + 1}});
  return shown.empty() ? bounds : intersected(shown.grown(1), bounds);
}

Extent extent_of(const CoarsePicture& picture) {
  Extent extent;
  const CellBox bounds = shown_box(picture);
  if (bounds.empty()) return extent;
  const OccupancyGrid& grid = *picture.grid;
  const Point half(grid.cell_m() / 2.0, grid.cell_m() / 2.0);
  extent.include(grid.centre_of(picture.coarse->fine_box(bounds.min).min) - half);
  extent.include(grid.centre_of(picture.coarse->fine_box(bounds.max).min) - half);
  return extent;
}

void draw_block(Canvas& canvas, const MapFrame& frame, const CoarsePicture& picture, Cell coarse) {
  const double ol = picture.coarse->ol(coarse);
  const PixelBox box = block_of(frame, picture, coarse);
  canvas.fill_box(box, {colour_of_ol(ol)});
  if (box.width() < kMinPxForValues) return;
  const Colour ink = ol > 170.0 ? kWhite : ol > 60.0 ? kInk : kFaintInk;
  canvas.text(box.centre(), std::to_string(std::lround(ol)), {ink, 10.5, Align::centre});
}

void draw_trigger(Canvas& canvas, const PixelBox& box) {
  const Pixel rim(1.0, 1.0);
  canvas.outline(PixelBox{box.min + rim, box.max - rim}, {kTrigger, 2.0});
}

void draw_blocks(Canvas& canvas, const MapFrame& frame, const CoarsePicture& picture) {
  const CellBox bounds = shown_box(picture);
  for (int y = bounds.min.y; y < bounds.max.y; ++y)
    for (int x = bounds.min.x; x < bounds.max.x; ++x) draw_block(canvas, frame, picture, {x, y});
  for (const Cell coarse : picture.region) canvas.fill_box(block_of(frame, picture, coarse), {kRegion, 0.35});
  if (!picture.trigger_ol) return;
  for (int y = bounds.min.y; y < bounds.max.y; ++y)
    for (int x = bounds.min.x; x < bounds.max.x; ++x)
      if (picture.coarse->ol({x, y}) > *picture.trigger_ol) draw_trigger(canvas, block_of(frame, picture, {x, y}));
}

// All greys from left to right, with the three values that have a name.
void draw_value_bar(Canvas& canvas, const Pixel& upper_left) {
  CellImage ramp{256, 1, {}};
  for (int ol = 0; ol < 256; ++ol) ramp.colours.push_back(colour_of_ol(ol));
  const PixelBox bar{upper_left, upper_left + Pixel(kScaleBarPx, 16.0)};
  canvas.image(bar, ramp);
  canvas.outline(bar, {kFrame, 1.0});
  const auto mark = [&](double ol, const char* words, Align align) {
    const Pixel at(bar.min.x() + kScaleBarPx * ol / 255.0, bar.max.y());
    canvas.line(std::array{at, Pixel(at + Pixel(0.0, 4.0))}, {kFaintInk, 1.0});
    canvas.text(at + Pixel(0.0, 13.0), words, {kInk, 11.0, align});
  };
  mark(0.0, "0 free", Align::left);
  mark(127.0, "127 unknown", Align::centre);
  mark(255.0, "255 occupied", Align::right);
}

std::vector<LegendEntry> legend_of(const CoarsePicture& picture) {
  std::vector<LegendEntry> entries;
  if (picture.trigger_ol)
    entries.push_back(
        {"above the trigger threshold " + trimmed_text(*picture.trigger_ol, 1), [](Canvas& canvas, const Pixel& at) {
           draw_trigger(canvas, {at - Pixel(8.0, 8.0), at + Pixel(8.0, 8.0)});
         }});
  if (!picture.region.empty()) entries.push_back(swatch_entry("region to match", {242, 178, 90}));
  return entries;
}

std::string subtitle_of(const CoarsePicture& picture) {
  const int n = picture.coarse->n();
  return fmt::format("weighted means of {0} x {0} cells,  blocks of {1} m,  weight of occupied cells {2}", n,
                     trimmed_text(n * picture.grid->cell_m(), 3), trimmed_text(picture.coarse->alpha(), 2));
}

}  // namespace

void write_coarse_picture(const std::filesystem::path& file, const CoarsePicture& picture) {
  if (picture.coarse == nullptr || picture.grid == nullptr)
    throw std::invalid_argument("write_coarse_picture: both grids are needed");
  const MapFrame frame = frame_of(extent_of(picture), picture.grid->cell_m());
  const int width_px = page_width_px(frame);
  const Legend legend(legend_of(picture), width_px - frame.box.min.x() - kPageMarginPx);
  const double bar_top_px = below_frame_px(frame) + 14.0;
  Canvas canvas(width_px, static_cast<int>(std::ceil(bar_top_px + kBarRoomPx + legend.height_px())), kPaper);
  draw_blocks(canvas, frame, picture);
  draw_border(canvas, frame);
  draw_title(canvas, picture.title, subtitle_of(picture));
  draw_value_bar(canvas, {frame.box.min.x(), bar_top_px});
  draw_scale_bar(canvas, frame, {width_px - kPageMarginPx, bar_top_px + 8.0});
  legend.draw(canvas, {frame.box.min.x(), bar_top_px + 40.0});
  canvas.write_png(file);
}

}  // namespace cairn

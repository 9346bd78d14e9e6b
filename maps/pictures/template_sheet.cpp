#include "maps/pictures/template_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "maps/pictures/drawing/colours.hpp"
#include "maps/pictures/drawing/map_frame.hpp"

namespace cairn {
namespace {

using namespace pictures;

constexpr int kColumns = 8;
constexpr double kTilePx = 108.0;
constexpr double kSheetGapPx = 10.0;
constexpr double kCaptionPx = 24.0;
constexpr double kNamePx = 20.0;
constexpr double kSheetTopPx = 66.0;
constexpr double kSheetLeftPx = 48.0;
constexpr double kLegendPx = 84.0;
constexpr Colour kTileGround{24, 28, 34};

double magnitude_of(const TemplateCell& cell) {
  return std::hypot(cell.gradient_x, cell.gradient_y);
}

Colour colour_of(double direction_rad, double steepness) {
  const double turn = direction_rad / (2.0 * std::numbers::pi);
  const Colour hue = colour_of_hue(turn - std::floor(turn), 1.0);
  // Even weak gradients stand out from the ground.
  const double share = 0.15 + 0.85 * steepness;
  const auto mix = [share](int ground, int full) {
    return static_cast<std::uint8_t>(ground + (full - ground) * share);
  };
  return {mix(kTileGround.red, hue.red), mix(kTileGround.green, hue.green), mix(kTileGround.blue, hue.blue)};
}

struct Scale {
  int reach_cells = 1;    // the farthest edge cell from the centre, in x or y
  double steepest = 1.0;  // the greatest gradient magnitude
};

Scale scale_of(const TemplateSet& set) {
  Scale scale;
  for (const LandmarkTemplate& one : set.templates)
    for (const TemplateCell& cell : one.cells) {
      scale.reach_cells = std::max({scale.reach_cells, std::abs(cell.offset.x), std::abs(cell.offset.y)});
      scale.steepest = std::max(scale.steepest, magnitude_of(cell));
    }
  return scale;
}

void draw_tile(Canvas& canvas, const Pixel& upper_left, const LandmarkTemplate& one, const Scale& scale) {
  canvas.fill_box({upper_left, upper_left + Pixel(kTilePx, kTilePx)}, {kTileGround}, 5.0);
  const double cell_px = std::max(0.5, std::floor(2.0 * kTilePx / (2.0 * scale.reach_cells + 3.0)) / 2.0);
  const Pixel centre = upper_left + Pixel(kTilePx / 2.0, kTilePx / 2.0);
  const Pixel half(cell_px / 2.0, cell_px / 2.0);
  for (const TemplateCell& cell : one.cells) {
    const Pixel at = centre + cell_px * Pixel(cell.offset.x, -cell.offset.y);
    canvas.fill_box({at - half, at + half},
                    {colour_of(std::atan2(cell.gradient_y, cell.gradient_x), magnitude_of(cell) / scale.steepest)});
  }
  canvas.fill_disc(centre, 1.5, {kFaintInk});
  canvas.text(centre + Pixel(0.0, kTilePx / 2.0 + kCaptionPx / 2.0),
              trimmed_text(degrees(one.orientation_rad), 1) + " deg", {kInk, 11.0, Align::centre});
}

// Where each template goes; a new category starts a new row, under its name.
struct SheetLayout {
  std::vector<Pixel> tiles;
  double bottom_px = kSheetTopPx;
};

bool begins_category(const TemplateSet& set, std::size_t i) {
  return i == 0 || set.templates[i].category != set.templates[i - 1].category;
}

SheetLayout lay_out(const TemplateSet& set) {
  SheetLayout layout;
  int column = kColumns;
  for (std::size_t i = 0; i < set.templates.size(); ++i) {
    if (begins_category(set, i)) layout.bottom_px += kNamePx;
    if (column == kColumns || begins_category(set, i)) {
      layout.bottom_px += kTilePx + kCaptionPx;
      column = 0;
    }
    layout.tiles.emplace_back(kSheetLeftPx + column * (kTilePx + kSheetGapPx), layout.bottom_px - kTilePx - kCaptionPx);
    ++column;
  }
  return layout;
}

// A ring of all directions beside the words that explain it.
void draw_legend(Canvas& canvas, const Pixel& left) {
  constexpr double kRadiusPx = 22.0;
  const Pixel centre = left + Pixel(kRadiusPx, 0.0);
  constexpr int kSteps = 72;
  for (int i = 0; i < kSteps; ++i) {
    const double angle_rad = i * 2.0 * std::numbers::pi / kSteps;
    const Pixel direction(std::cos(angle_rad), -std::sin(angle_rad));
    canvas.line(std::array{Pixel(centre + 11.0 * direction), Pixel(centre + kRadiusPx * direction)},
                {colour_of(angle_rad, 1.0), 2.5});
  }
  canvas.text(left + Pixel(2.0 * kRadiusPx + 14.0, -8.0), "hue: where the gradient points, towards what is occupied",
              {kInk, 12.0});
  canvas.text(left + Pixel(2.0 * kRadiusPx + 14.0, 10.0), "brightness: how steep it is", {kInk, 12.0});
}

}  // namespace

void write_template_sheet(const std::filesystem::path& file, const TemplateSet& templates, const std::string& title) {
  const SheetLayout layout = lay_out(templates);
  const Scale scale = scale_of(templates);
  const double width_px = kSheetLeftPx + kColumns * (kTilePx + kSheetGapPx) - kSheetGapPx + kPageMarginPx;
  Canvas canvas(static_cast<int>(std::ceil(width_px)), static_cast<int>(std::ceil(layout.bottom_px + kLegendPx)),
                kPaper);
  draw_title(canvas, title,
             fmt::format("{} templates,  steps of {} deg,  cells of {} cm", templates.templates.size(),
                         trimmed_text(degrees(templates.step_rad), 2), trimmed_text(templates.cell_m * 100.0, 2)));
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    if (begins_category(templates, i))
      canvas.text(layout.tiles[i] - Pixel(0.0, kNamePx / 2.0), templates.templates[i].category, {kInk, 12.0});
    draw_tile(canvas, layout.tiles[i], templates.templates[i], scale);
  }
  draw_legend(canvas, {kSheetLeftPx, layout.bottom_px + kLegendPx / 2.0});
  canvas.write_png(file);
}

}  // namespace cairn

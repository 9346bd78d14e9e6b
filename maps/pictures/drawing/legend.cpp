#include "maps/pictures/drawing/legend.hpp"

#include <array>

#include "maps/pictures/drawing/colours.hpp"

namespace cairn::pictures {
namespace {

constexpr double kLegendRowPx = 24.0;
constexpr double kSignPx = 26.0;
constexpr double kLegendGapPx = 8.0;
constexpr double kBetweenPx = 22.0;
constexpr TextStyle kWords{kInk, 12.0};

}  // namespace

Legend::Legend(std::vector<LegendEntry> entries, double width_px) {
  double x_px = 0.0;
  for (LegendEntry& entry : entries) {
    const double entry_px = kSignPx + kLegendGapPx + Canvas::text_width_px(entry.meaning, kWords);
    if (rows_ == 0 || x_px + entry_px > width_px) {
      ++rows_;
      x_px = 0.0;
    }
    placed_.push_back({std::move(entry), {x_px, (rows_ - 0.5) * kLegendRowPx}});
    x_px += entry_px + kBetweenPx;
  }
}

double Legend::height_px() const {
  return rows_ * kLegendRowPx;
}

void Legend::draw(Canvas& canvas, const Pixel& upper_left) const {
  for (const Placed& placed : placed_) {
    const Pixel left = upper_left + placed.at;
    placed.entry.draw_sign(canvas, left + Pixel(kSignPx / 2.0, 0.0));
    canvas.text(left + Pixel(kSignPx + kLegendGapPx, 0.0), placed.entry.meaning, kWords);
  }
}

LegendEntry line_entry(const std::string& meaning, const Stroke& stroke) {
  return {meaning, [stroke](Canvas& canvas, const Pixel& centre) {
            canvas.line(std::array{Pixel(centre - Pixel(12.0, 0.0)), Pixel(centre + Pixel(12.0, 0.0))}, stroke);
          }};
}

LegendEntry swatch_entry(const std::string& meaning, Colour colour) {
  return {meaning, [colour](Canvas& canvas, const Pixel& centre) {
            const Pixel half(10.0, 7.0);
            canvas.fill_box({centre - half, centre + half}, {kFrame});
            canvas.fill_box({centre - half + Pixel(1.0, 1.0), centre + half - Pixel(1.0, 1.0)}, {colour});
          }};
}

}  // namespace cairn::pictures

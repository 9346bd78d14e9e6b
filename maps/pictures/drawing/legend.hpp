// What the signs of a picture mean: rows of small drawings with a word each.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "maps/pictures/drawing/canvas.hpp"

namespace cairn::pictures {

struct LegendEntry {
  std::string meaning;
  std::function<void(Canvas&, const Pixel& centre)> draw_sign;  // within 24 x 14 pixels
};

class Legend {
 public:
  // Breaks the entries into rows that fit the width.
  Legend(std::vector<LegendEntry> entries, double width_px);

  [[nodiscard]] double height_px() const;
  void draw(Canvas& canvas, const Pixel& upper_left) const;

 private:
  struct Placed {
    LegendEntry entry;
    Pixel at;  // left end, half way up, from the legend's upper left
  };
  std::vector<Placed> placed_;
  int rows_ = 0;
};

[[nodiscard]] LegendEntry line_entry(const std::string& meaning, const Stroke& stroke);
[[nodiscard]] LegendEntry swatch_entry(const std::string& meaning, Colour colour);

}  // namespace cairn::pictures

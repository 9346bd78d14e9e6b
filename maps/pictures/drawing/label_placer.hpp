// Where labels go: beside what they name, off everything that should stay visible.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "maps/pictures/drawing/canvas.hpp"

namespace cairn::pictures {

class LabelPlacer {
 public:
  static constexpr int kRings = 4;

  // background_cost: how bad it is to cover this box of the picture, per square pixel.
  LabelPlacer(const PixelBox& area, std::function<double(const PixelBox&)> background_cost);

  // Covering the box costs this much per square pixel from now on.
  void avoid(const PixelBox& box, double cost);
  void avoid_line(std::span<const Pixel> points, double cost);
  // No later label may overlap the box.
  void keep_clear(const PixelBox& box) { taken_.push_back(box); }
  void keep_line_clear(std::span<const Pixel> points);
  // The cheapest box of this size about the point, outside the radius, that lies in the area and overlaps no label and
  // nothing that is kept clear; later labels do not overlap it. None: there is no room, so the label is left out.
  // rings: how many steps away from the point it is looked for.
  [[nodiscard]] std::optional<PixelBox> place(const Pixel& about, double radius_px, const Pixel& size_px,
                                              int rings = kRings);

 private:
  struct Obstacle {
    PixelBox box;
    double cost;
  };
  [[nodiscard]] double cost_of(const PixelBox& box) const;
  [[nodiscard]] bool is_clear(const PixelBox& box) const;

  PixelBox area_;
  std::function<double(const PixelBox&)> background_cost_;
  std::vector<Obstacle> obstacles_;
  std::vector<PixelBox> taken_;  // labels, and what is kept clear
};

}  // namespace cairn::pictures

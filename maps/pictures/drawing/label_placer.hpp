// Where labels go: beside what they name, off everything that should stay visible.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "maps/pictures/drawing/canvas.hpp"

namespace cairn::pictures {

class LabelPlacer {
 public:
  // background_cost: how bad it is to cover this box of the picture, per square pixel.
  LabelPlacer(const PixelBox& area, std::function<double(const PixelBox&)> background_cost);

  // Covering the box costs this much per square pixel from now on.
  void avoid(const PixelBox& box, double cost);
  void avoid_line(std::span<const Pixel> points, double cost);
  // The cheapest box of this size about the point, outside the radius; avoided by later labels.
  [[nodiscard]] PixelBox place(const Pixel& about, double radius_px, const Pixel& size_px);

 private:
  struct Obstacle {
    PixelBox box;
    double cost;
  };
  [[nodiscard]] double cost_of(const PixelBox& box) const;

  PixelBox area_;
  std::function<double(const PixelBox&)> background_cost_;
  std::vector<Obstacle> obstacles_;
};

}  // namespace cairn::pictures

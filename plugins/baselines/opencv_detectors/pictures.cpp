#include "plugins/baselines/opencv_detectors/pictures.hpp"

#include <opencv2/imgproc.hpp>

namespace cairn::opencv_detectors {

cv::Mat picture_of(const OccupancyGrid& grid, const CellBox& box) {
  cv::Mat picture(box.height(), box.width(), CV_8U);
  grid.copy_ol(box, {picture.data, picture.total()});
  return picture;
}

Gradients gradients_of(const OccupancyGrid& grid, const CellBox& box) {
  const cv::Mat wide = picture_of(grid, box.grown(1));
  // Sobel reads beyond a part of a picture into the whole of it.
  const cv::Mat ol = wide(cv::Rect(1, 1, box.width(), box.height()));
  Gradients gradients;
  cv::Sobel(ol, gradients.x, CV_16S, 1, 0);
  cv::Sobel(ol, gradients.y, CV_16S, 0, 1);
  return gradients;
}

Gradients gradients_of(const LandmarkTemplate& shape, int reach) {
  const int side = 2 * reach + 1;
  Gradients gradients{cv::Mat::zeros(side, side, CV_16S), cv::Mat::zeros(side, side, CV_16S)};
  for (const TemplateCell& cell : shape.cells) {
    gradients.x.at<std::int16_t>(cell.offset.y + reach, cell.offset.x + reach) = cell.gradient_x;
    gradients.y.at<std::int16_t>(cell.offset.y + reach, cell.offset.x + reach) = cell.gradient_y;
  }
  return gradients;
}

cv::Mat cells_of(const LandmarkTemplate& shape, int reach) {
  cv::Mat cells = cv::Mat::zeros(2 * reach + 1, 2 * reach + 1, CV_8U);
  for (const TemplateCell& cell : shape.cells)
    cells.at<std::uint8_t>(cell.offset.y + reach, cell.offset.x + reach) = 255;
  return cells;
}

cv::Mat drawn(const Contour& contour, double orientation_rad, double cell_m, int reach) {
  constexpr double kRingInside = -1.5;  // cells
  constexpr double kRingOutside = 1.0;
  constexpr double kTie = 1e-6;  // many outlines pass exactly through cell centres
  cv::Mat picture(2 * reach + 1, 2 * reach + 1, CV_8U, cv::Scalar(0));
  const Pose2 T_shape_picture{0.0, 0.0, -orientation_rad};
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      const double cells = contour.signed_distance(T_shape_picture * Point{x * cell_m, y * cell_m}) / cell_m;
      if (cells >= kRingOutside - kTie) continue;
      picture.at<std::uint8_t>(y + reach, x + reach) = cells > kRingInside + kTie ? 255 : kUnknownOl;
    }
  return picture;
}

cv::Mat edges_of(const Gradients& gradients, double low, double high) {
  cv::Mat edges;
  cv::Canny(gradients.x, gradients.y, edges, low, high, true);
  return edges;
}

}  // namespace cairn::opencv_detectors

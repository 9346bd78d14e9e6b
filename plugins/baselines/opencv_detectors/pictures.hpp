// Grids and templates as OpenCV pictures, a pixel a cell. Row 0 is the lowest row of cells: angles keep their
// sense, and a picture looks upside down only to who views it.
#pragma once

#include <opencv2/core.hpp>

#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cairn::opencv_detectors {

// Sobel responses of OL, CV_16S, within +-1020.
struct Gradients {
  cv::Mat x;
  cv::Mat y;
};

// OL, CV_8U.
[[nodiscard]] cv::Mat picture_of(const OccupancyGrid& grid, const CellBox& box);
// Of OL in the box; what lies beyond it is taken into account.
[[nodiscard]] Gradients gradients_of(const OccupancyGrid& grid, const CellBox& box);

// A square about the template's centre cell that reaches so far; 0 where the template has no cell.
[[nodiscard]] Gradients gradients_of(const LandmarkTemplate& shape, int reach);
// 255 on the template's cells, CV_8U.
[[nodiscard]] cv::Mat cells_of(const LandmarkTemplate& shape, int reach);
// OL about a landmark of this shape: free outside, a ring of occupied cells, unknown inside (docs/method.md 6.1).
// CV_8U.
[[nodiscard]] cv::Mat drawn(const Contour& contour, double orientation_rad, double cell_m, int reach);

// Canny's edges, 255 on them, CV_8U. Thresholds on the magnitude of the gradient.
[[nodiscard]] cv::Mat edges_of(const Gradients& gradients, double low, double high);

}  // namespace cairn::opencv_detectors

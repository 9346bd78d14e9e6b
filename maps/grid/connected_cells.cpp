#include "maps/grid/connected_cells.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cairn {

std::vector<std::int32_t> connected_cells(const DistanceField& field) {
  const CellBox box = field.box();
  if (box.empty()) return {};
  cv::Mat free(box.height(), box.width(), CV_8U);
  for (int y = 0; y < box.height(); ++y)
    for (int x = 0; x < box.width(); ++x) free.at<std::uint8_t>(y, x) = field.is_blocked(box.min + Cell{x, y}) ? 0 : 1;
  cv::Mat numbers;
  cv::connectedComponents(free, numbers, 4, CV_32S);
  return {numbers.begin<std::int32_t>(), numbers.end<std::int32_t>()};
}

}  // namespace cairn

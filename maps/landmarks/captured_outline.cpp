#include "maps/landmarks/captured_outline.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace cairn {
namespace {

constexpr int kFine = 4;  // pixels a cell, for smooth sides
constexpr int kMinCells = 4;
constexpr int kSpikeCells = 3;  // what is no wider than this is no part of an outline
constexpr int kGapCells = 2;    // closed from both sides
constexpr double kSmoothing_cells = 0.35;

// One pixel a cell, row 0 the lowest.
cv::Mat1b occupied_in(const OccupancyGrid& grid, const CellBox& box) {
  cv::Mat1b occupied(box.height(), box.width());
  for (int y = 0; y < box.height(); ++y) {
    for (int x = 0; x < box.width(); ++x)
      occupied(y, x) = grid.state(box.min + Cell{x, y}) == CellState::occupied ? 255 : 0;
  }
  return occupied;
}

using Trace = std::vector<cv::Point>;

// The outer edges of what hangs together, in pixels of kFine a cell.
std::vector<Trace> traces_in(const cv::Mat1b& occupied) {
  cv::Mat1b closed;
  const int side = 2 * kGapCells + 1;
  cv::morphologyEx(occupied, closed, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}));
  cv::Mat1b fine;
  cv::resize(closed, fine, {}, kFine, kFine, cv::INTER_NEAREST);
  std::vector<Trace> traces;
  cv::findContours(fine, traces, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::Mat1b filled(fine.size(), 0);
  cv::drawContours(filled, traces, -1, 255, cv::FILLED);
  // One cell inward, and without the spikes where beams have slipped past a corner.
  cv::Mat1b inner;
  cv::erode(filled, inner, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kFine + 1, 2 * kFine + 1}));
  cv::morphologyEx(inner, inner, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {kSpikeCells * kFine + 1, kSpikeCells * kFine + 1}));
  cv::findContours(inner, traces, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  return traces;
}

std::string metres(double value) {
  std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 3);
}

}  // namespace

CapturedOutline captured_outline(const OccupancyGrid& grid, const Point& at_m, double radius_m) {
  const double cell_m = grid.cell_m();
  const int reach = static_cast<int>(std::ceil(radius_m / cell_m)) + 2 * kGapCells + 2;
  const Cell centre = grid.cell_at(at_m);
  const CellBox box = CellBox{centre, centre + Cell{1, 1}}.grown(reach);
  const Point corner_m = grid.centre_of(box.min) - 0.5 * cell_m * Point(1.0, 1.0);
  std::vector<std::vector<Point>> polygons;
  int cut = 0;
  const cv::Mat1b occupied = occupied_in(grid, box);
  for (const Trace& trace : traces_in(occupied)) {
    if (cv::contourArea(trace) < kMinCells * kFine * kFine) continue;
    Trace corners;
    cv::approxPolyDP(trace, corners, kSmoothing_cells * kFine, true);
    std::vector<Point> polygon;
    // Pixels as points are their middles.
    for (const cv::Point& p : corners) polygon.push_back(corner_m + cell_m / kFine * Point(p.x + 0.5, p.y + 0.5));
    const auto is_near = [&](const Point& p) { return (p - at_m).norm() <= radius_m; };
    if (std::ranges::none_of(polygon, is_near)) continue;
    if (polygon.size() >= 3 && std::ranges::all_of(polygon, is_near))
      polygons.push_back(std::move(polygon));
    else
      ++cut;
  }
  if (polygons.empty())
    throw std::invalid_argument("nothing lies wholly within " + metres(radius_m) + " m of (" + metres(at_m.x()) + ", " +
                                metres(at_m.y()) + "): " +
                                (cut > 0 ? "what is there goes on farther, choose a greater radius"
                                 : cv::countNonZero(occupied) > 0
                                     ? "what is there is too thin or too small to have an outline"
                                     : "no occupied cells are there"));
  const Point centroid_m = Contour::parts_in_place(polygons).centroid_m();
  return {Contour::parts(std::move(polygons)), centroid_m};
}

}  // namespace cairn

// Draws the clusters of a small building complex: graph_pictures FILE.png

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>

#include "maps/hierarchy/hierarchy.hpp"
#include "maps/pictures/drawing/canvas.hpp"
#include "maps/pictures/drawing/colours.hpp"
#include "tests/bench/graph/building_complex.hpp"

namespace cairn {
namespace {

using pictures::Canvas;
using pictures::Colour;
using pictures::Pixel;

constexpr std::size_t kLandmarks = 840;  // seven buildings of one floor
constexpr double kPixels_m = 4.0;        // of a metre
constexpr double kMargin_px = 40.0;

// One level of clusters, with its lower left corner at `corner`.
class Panel {
 public:
  Panel(Canvas& canvas, const LandmarkGraph& graph, const Hierarchy& hierarchy, int level, const Pixel& corner)
      : canvas_(canvas), graph_(graph), hierarchy_(hierarchy), level_(level), corner_(corner) {}

  void draw() {
    const Network& network = hierarchy_.network();
    for (VertexIndex v = 0; v < network.end(); ++v)
      for (const Arc& arc : network.out(v)) draw_route(v, arc.other);
    for (VertexIndex v = 0; v < network.end(); ++v) {
      const bool outer = is_boundary(v);
      canvas_.fill_disc(pixel_of(v), outer ? 5.0 : 4.0, {colour_of(cluster_of(v)), 1.0});
      if (outer) canvas_.ring(pixel_of(v), 5.5, {pictures::kInk, 2.0, 1.0, 0.0});
    }
  }

 private:
  [[nodiscard]] ClusterIndex cluster_of(VertexIndex v) const { return hierarchy_.clustering().cluster_of(v, level_); }
  [[nodiscard]] bool is_boundary(VertexIndex v) const {
    const auto& boundary = hierarchy_.clustering().node(cluster_of(v)).boundary;
    return std::binary_search(boundary.begin(), boundary.end(), v);
  }
  [[nodiscard]] Pixel pixel_of(VertexIndex v) const {
    const Point at = graph_.find(hierarchy_.network().landmark_of(v))->T_map_landmark.position();
    return corner_ + Pixel(kPixels_m * at.x(), -kPixels_m * at.y());
  }
  // Neighbours in number lie far apart on the wheel.
  static Colour colour_of(ClusterIndex cluster) {
    const double turns = 0.618034 * cluster;
    return pictures::colour_of_hue(turns - std::floor(turns), cluster % 2 == 0 ? 0.85 : 0.6);
  }
  void draw_route(VertexIndex from, VertexIndex to) {
    const std::array<Pixel, 2> ends{pixel_of(from), pixel_of(to)};
    if (cluster_of(from) == cluster_of(to))
      canvas_.line(ends, {colour_of(cluster_of(from)), 2.5, 1.0, 0.0});
    else
      canvas_.line(ends, {pictures::kInk, 1.0, 1.0, 3.0});
  }

  Canvas& canvas_;
  const LandmarkGraph& graph_;
  const Hierarchy& hierarchy_;
  int level_;
  Pixel corner_;
};

void draw(const char* file) {
  const LandmarkGraph graph = building_complex(kLandmarks, 2);
  const Hierarchy hierarchy(graph);
  Point least = Point::Constant(std::numeric_limits<double>::max());
  Point most = -least;
  for (const auto& [id, landmark] : graph.landmarks()) {
    least = least.cwiseMin(landmark.T_map_landmark.position());
    most = most.cwiseMax(landmark.T_map_landmark.position());
  }
  const Pixel size = kPixels_m * (most - least);
  const double panel_px = size.x() + 2.0 * kMargin_px;
  Canvas canvas(static_cast<int>(panel_px * hierarchy.levels()), static_cast<int>(size.y() + 3.0 * kMargin_px),
                pictures::kPaper);
  for (int level = 1; level <= hierarchy.levels(); ++level) {
    const double left = panel_px * (level - 1) + kMargin_px;
    const Pixel corner(left - kPixels_m * least.x(), 2.0 * kMargin_px + size.y() + kPixels_m * least.y());
    const std::size_t clusters = hierarchy.clustering().of_level(level).size();
    canvas.text({left, kMargin_px}, "level " + std::to_string(level) + ": " + std::to_string(clusters) + " clusters",
                {pictures::kInk, 20.0, pictures::Align::left, true});
    Panel(canvas, graph, hierarchy, level, corner).draw();
  }
  canvas.write_png(file);
}

}  // namespace
}  // namespace cairn

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: graph_pictures FILE.png\n");
    return 2;
  }
  try {
    cairn::draw(arguments[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "graph_pictures: %s\n", error.what());
    return 2;
  }
}

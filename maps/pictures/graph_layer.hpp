// Landmarks and routes as drawn on a map picture.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "maps/clustering/cluster_tree.hpp"
#include "maps/geometry/contour.hpp"
#include "maps/landmarks/landmark_graph.hpp"
#include "maps/pictures/drawing/label_placer.hpp"
#include "maps/pictures/drawing/legend.hpp"
#include "maps/pictures/drawing/map_frame.hpp"

namespace cairn::pictures {

class GraphLayer {
 public:
  // clusters: may be null.
  GraphLayer(const LandmarkGraph& graph, std::span<const LandmarkShape> shapes, const ClusterTree* clusters);

  void draw_routes(Canvas& canvas, const MapFrame& frame) const;
  void draw_landmarks(Canvas& canvas, const MapFrame& frame) const;
  // "L3 square 0.74" beside each landmark; of many landmarks the label only, of very many nothing but those of first.
  // Where there is no room a label is left out: those of first are placed first, then those of landmarks with a name.
  void draw_labels(Canvas& canvas, const MapFrame& frame, LabelPlacer& placer,
                   std::span<const LandmarkId> first = {}) const;
  [[nodiscard]] std::vector<LegendEntry> legend() const;
  [[nodiscard]] Extent extent() const;

 private:
  [[nodiscard]] const Contour* contour_of(const std::string& category) const;
  [[nodiscard]] Colour colour_of(const std::string& category) const;
  [[nodiscard]] Colour colour_of(const Landmark& landmark) const;
  [[nodiscard]] double dot_px() const;  // smaller when there are many
  void colour_clusters(const ClusterTree& tree);
  [[nodiscard]] double radius_px(const Landmark& landmark, const MapFrame& frame) const;
  [[nodiscard]] std::vector<Point> course_of(const Route& route) const;
  [[nodiscard]] std::string words_about(const Landmark& landmark) const;
  [[nodiscard]] std::vector<const Landmark*> labelled(std::span<const LandmarkId> first) const;

  const LandmarkGraph& graph_;
  std::span<const LandmarkShape> shapes_;
  std::vector<std::string> categories_;  // of shapes_, then of the graph's others by name
  int cluster_level_ = 0;                // by whose clusters dots are coloured; 0: by category
  std::map<LandmarkId, Colour> cluster_colours_;
};

}  // namespace cairn::pictures

#include "maps/pictures/graph_layer.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "maps/landmarks/close_categories.hpp"
#include "maps/pictures/drawing/colours.hpp"

namespace cairn::pictures {
namespace {

constexpr double kDotPx = 5.0;
constexpr std::size_t kMaxFullLabels = 60;
constexpr std::size_t kMaxLabels = 250;
constexpr TextStyle kLabelText{kInk, 12.5};
constexpr double kLabelHeightPx = 18.0;

constexpr int kCircleCorners = 64;

double outer_radius_m(const Contour& contour) {
  return 0.5 * contour.outer_diameter_m();
}

// place: where a point of the contour's frame is drawn.
template <class Place>
void draw_contour(Canvas& canvas, const Contour& contour, Colour colour, double line_px, Place place) {
  for (const std::vector<Point>& outline : contour.outlines_m(kCircleCorners)) {
    std::vector<Pixel> corners;
    corners.reserve(outline.size());
    for (const Point& p : outline) corners.push_back(place(p));
    canvas.fill_polygon(corners, {colour, 0.2});
    canvas.outline(corners, {colour, line_px});
  }
}

Point end_of(const Landmark& landmark) {
  return landmark.approach_pose().position();
}

Stroke stroke_of(const Route& route, double width_px) {
  const bool dashed = route.closed || (route.trajectory.empty() && width_px > 1.0);
  return {route.closed ? kClosed : kRoute, width_px, 0.75, dashed ? 7.0 : 0.0};
}

LegendEntry category_entry(const std::string& category, const Contour* contour, Colour colour) {
  if (contour == nullptr)
    return {category, [colour](Canvas& canvas, const Pixel& at) { canvas.fill_disc(at, kDotPx, {colour}); }};
  return {category, [contour = *contour, colour](Canvas& canvas, const Pixel& at) {
            const double scale = 8.0 / outer_radius_m(contour);
            draw_contour(canvas, contour, colour, 2.0,
                         [&](const Point& p) { return Pixel(at + Pixel(p.x() * scale, -p.y() * scale)); });
          }};
}

}  // namespace

GraphLayer::GraphLayer(const LandmarkGraph& graph, std::span<const LandmarkShape> shapes, const ClusterTree* clusters)
    : graph_(graph), shapes_(shapes) {
  for (const LandmarkShape& shape : shapes) categories_.push_back(shape.category);
  std::set<std::string> others;
  for (const auto& [id, landmark] : graph.landmarks()) others.insert(landmark.category);
  for (const std::string& category : categories_) others.erase(category);
  categories_.insert(categories_.end(), others.begin(), others.end());
  if (clusters != nullptr && !clusters->cluster_of.empty()) colour_clusters(*clusters);
}

// The highest level that divides the graph at least in this many parts, or the lowest.
void GraphLayer::colour_clusters(const ClusterTree& tree) {
  constexpr std::size_t kParts = 5;
  std::map<int, std::size_t> parts;
  for (const auto& [id, cluster] : tree.clusters) ++parts[cluster.level];
  cluster_level_ = 1;
  for (const auto& [level, count] : parts)
    if (count >= kParts) cluster_level_ = level;
  std::map<ClusterId, std::size_t> number;
  for (const auto& [landmark, leaf] : tree.cluster_of) {
    ClusterId id = leaf;
    while (tree.clusters.at(id).level < cluster_level_) id = tree.clusters.at(id).parent;
    const std::size_t n = number.emplace(id, number.size()).first->second;
    // Neighbours in number are far apart on the colour wheel.
    cluster_colours_.emplace(landmark, colour_of_hue(std::fmod(0.618034 * static_cast<double>(n), 1.0), 0.75));
  }
}

Colour GraphLayer::colour_of(const Landmark& landmark) const {
  const auto found = cluster_colours_.find(landmark.id);
  return found == cluster_colours_.end() ? colour_of(landmark.category) : found->second;
}

double GraphLayer::dot_px() const {
  const double crowd = static_cast<double>(graph_.landmarks().size()) / static_cast<double>(kMaxLabels);
  return std::max(1.2, kDotPx / std::max(1.0, std::sqrt(crowd)));
}

const Contour* GraphLayer::contour_of(const std::string& category) const {
  for (const LandmarkShape& shape : shapes_)
    if (shape.category == category) return &shape.contour;
  return nullptr;
}

Colour GraphLayer::colour_of(const std::string& category) const {
  const auto found = std::ranges::find(categories_, category);
  return category.empty() ? kInk : category_colour(static_cast<std::size_t>(found - categories_.begin()));
}

double GraphLayer::radius_px(const Landmark& landmark, const MapFrame& frame) const {
  const Contour* contour = contour_of(landmark.category);
  return contour == nullptr ? dot_px() : std::max(kDotPx, outer_radius_m(*contour) * frame.px_per_m);
}

std::vector<Point> GraphLayer::course_of(const Route& route) const {
  if (route.trajectory.empty()) return {end_of(*graph_.find(route.from)), end_of(*graph_.find(route.to))};
  std::vector<Point> course;
  for (const Pose2& pose : route.trajectory) course.push_back(pose.position());
  return course;
}

void GraphLayer::draw_routes(Canvas& canvas, const MapFrame& frame) const {
  const double width_px = std::max(0.6, 2.0 * dot_px() / kDotPx);
  for (const auto& [id, route] : graph_.routes()) {
    // There and back again is one line when both are straight.
    const Route* back = graph_.route_between(route.to, route.from);
    if (!route.closed && route.trajectory.empty() && back != nullptr && back->trajectory.empty() && back->id < id)
      continue;
    canvas.line(frame.pixels_of(course_of(route)), stroke_of(route, width_px));
  }
}

void GraphLayer::draw_landmarks(Canvas& canvas, const MapFrame& frame) const {
  for (const auto& [id, landmark] : graph_.landmarks()) {
    const Colour colour = colour_of(landmark);
    const Pixel centre = frame.pixel_of(landmark.T_map_landmark.position());
    if (const Contour* contour = contour_of(landmark.category)) {
      draw_contour(canvas, *contour, colour, 2.5, [&frame, &T_map_landmark = landmark.T_map_landmark](const Point& p) {
        return frame.pixel_of(T_map_landmark * p);
      });
      canvas.fill_disc(centre, 2.5, {colour});
    } else {
      canvas.fill_disc(centre, 1.3 * dot_px(), {kWhite});
      canvas.fill_disc(centre, dot_px(), {colour});
    }
  }
}

std::string GraphLayer::words_about(const Landmark& landmark) const {
  std::string words = label_of(landmark);
  if (graph_.landmarks().size() > kMaxFullLabels) return words;
  if (!landmark.category.empty()) words += " " + landmark.category;
  const std::optional<CloseCategories> close = close_categories(landmark);
  if (close)
    words += " " + short_text(close->degree, 2) + ", " + close->other + " " + short_text(close->other_degree, 2);
  else if (landmark.degree > 0.0)
    words += " " + short_text(landmark.degree, 2);
  return words;
}

// In the order in which labels are placed.
std::vector<const Landmark*> GraphLayer::labelled(std::span<const LandmarkId> first) const {
  std::vector<const Landmark*> order;
  const auto add_if = [&](auto is_wanted) {
    for (const auto& [id, landmark] : graph_.landmarks())
      if (std::ranges::find(first, id) == first.end() && is_wanted(landmark)) order.push_back(&landmark);
  };
  for (const LandmarkId id : first)
    if (const Landmark* const landmark = graph_.find(id);
        landmark != nullptr && std::ranges::find(order, landmark) == order.end())
      order.push_back(landmark);
  if (graph_.landmarks().size() > kMaxLabels) return order;
  add_if([](const Landmark& landmark) { return !landmark.name.empty(); });
  add_if([](const Landmark& landmark) { return landmark.name.empty(); });
  return order;
}

void GraphLayer::draw_labels(Canvas& canvas, const MapFrame& frame, LabelPlacer& placer,
                             std::span<const LandmarkId> first) const {
  const std::vector<const Landmark*> order = labelled(first);
  if (order.empty()) return;
  // Among many landmarks a label says nothing unless it stands right beside its own, and hides none.
  const bool is_crowded = graph_.landmarks().size() > kMaxFullLabels;
  for (const auto& [id, landmark] : graph_.landmarks()) {
    const Pixel centre = frame.pixel_of(landmark.T_map_landmark.position());
    const double radius = radius_px(landmark, frame);
    if (is_crowded) placer.keep_clear({centre - Pixel(radius, radius), centre + Pixel(radius, radius)});
    placer.avoid({centre - Pixel(radius, radius), centre + Pixel(radius, radius)}, 20.0);
  }
  for (const auto& [id, route] : graph_.routes()) placer.avoid_line(frame.pixels_of(course_of(route)), 0.25);
  for (const Landmark* const landmark : order) {
    const std::string words = words_about(*landmark);
    const Pixel size(Canvas::text_width_px(words, kLabelText) + 12.0, kLabelHeightPx);
    const std::optional<PixelBox> box =
        placer.place(frame.pixel_of(landmark->T_map_landmark.position()), radius_px(*landmark, frame), size,
                     is_crowded ? 1 : LabelPlacer::kRings);
    if (!box) continue;
    const Pixel rim(1.0, 1.0);
    canvas.fill_box({box->min - rim, box->max + rim}, {colour_of(landmark->category), 0.9}, 5.0);
    canvas.fill_box(*box, {kWhite, 0.95}, 4.0);
    canvas.text(box->centre(), words, {kLabelText.colour, kLabelText.size_px, Align::centre});
  }
}

std::vector<LegendEntry> GraphLayer::legend() const {
  std::vector<LegendEntry> entries;
  if (cluster_level_ > 0)
    entries.push_back(
        {"landmarks, by cluster of level " + std::to_string(cluster_level_),
         [](Canvas& canvas, const Pixel& at) { canvas.fill_disc(at, kDotPx, {colour_of_hue(0.0, 0.75)}); }});
  for (const std::string& category : categories_)
    if (!graph_.of_category(category).empty() && (cluster_level_ == 0 || contour_of(category) != nullptr))
      entries.push_back(
          category_entry(category.empty() ? "place" : category, contour_of(category), colour_of(category)));
  bool open = false;
  bool closed = false;
  bool cost_only = false;
  for (const auto& [id, route] : graph_.routes()) {
    closed = closed || route.closed;
    open = open || (!route.closed && !route.trajectory.empty());
    cost_only = cost_only || (!route.closed && route.trajectory.empty());
  }
  if (open) entries.push_back(line_entry("route", {kRoute, 2.0, 0.75}));
  if (cost_only) entries.push_back(line_entry("route, course not known", {kRoute, 2.0, 0.75, 5.0}));
  if (closed) entries.push_back(line_entry("closed route", {kClosed, 2.0, 0.75, 5.0}));
  return entries;
}

Extent GraphLayer::extent() const {
  Extent extent;
  for (const auto& [id, landmark] : graph_.landmarks()) {
    const Contour* contour = contour_of(landmark.category);
    extent.include(landmark.T_map_landmark.position(), contour == nullptr ? 0.0 : outer_radius_m(*contour));
  }
  for (const auto& [id, route] : graph_.routes())
    for (const Pose2& pose : route.trajectory) extent.include(pose.position());
  return extent;
}

}  // namespace cairn::pictures

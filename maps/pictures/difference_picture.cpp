#include "maps/pictures/difference_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "maps/grid/grid_overlay.hpp"
#include "maps/pictures/drawing/colours.hpp"
#include "maps/pictures/drawing/label_placer.hpp"
#include "maps/pictures/drawing/legend.hpp"
#include "maps/pictures/drawing/map_frame.hpp"

namespace cairn {
namespace {

using namespace pictures;

constexpr Colour kNew{0, 130, 60};
constexpr Colour kGone{214, 40, 57};
constexpr Colour kSameWall{70, 78, 86};
constexpr Colour kSameFree{255, 255, 255};
constexpr Colour kUnknown{214, 218, 221};
constexpr Colour kNewFree{196, 232, 205};
constexpr Colour kGoneFree{250, 212, 206};
constexpr Colour kMoved{25, 118, 210};
constexpr int kDifferenceMarginCells = 3;
constexpr double kDotPx = 5.0;
constexpr std::size_t kMaxLabels = 60;

// What a cell of the picture says, the less notable first.
enum class Sign { unknown, free, wall, free_gone, free_new, wall_gone, wall_new };

Sign sign_of(CellState a, CellState b) {
  if (b == CellState::occupied) return a == CellState::occupied ? Sign::wall : Sign::wall_new;
  if (a == CellState::occupied) return Sign::wall_gone;
  if (b == CellState::free) return a == CellState::free ? Sign::free : Sign::free_new;
  return a == CellState::free ? Sign::free_gone : Sign::unknown;
}

Colour colour_of(Sign sign) {
  static constexpr std::array<Colour, 7> kColours{kUnknown, kSameFree, kSameWall, kGoneFree, kNewFree, kGone, kNew};
  return kColours[static_cast<std::size_t>(sign)];
}

// Both grids on one lattice; without any, nothing.
class Cells {
 public:
  Cells(const OccupancyGrid& a, const OccupancyGrid& b)
      : a_(a), b_(b), lattice_(a.bounds().empty() ? b : a), box_(united(a.bounds(), box_over(lattice_, b, {}))) {
    box_ = shown_part();
  }

  [[nodiscard]] const OccupancyGrid& lattice() const { return lattice_; }
  [[nodiscard]] CellBox box() const { return box_; }
  [[nodiscard]] CellImage image() const {
    return image_of(box_, [&](const CellBox& block) {
      Sign most = Sign::unknown;
      for (int y = block.min.y; y < block.max.y; ++y)
        for (int x = block.min.x; x < block.max.x; ++x) most = std::max(most, sign_at({x, y}));
      return colour_of(most);
    });
  }

 private:
  [[nodiscard]] Sign sign_at(Cell cell) const {
    const OccupancyThresholds thresholds;
    const LogOdds in_a = a_.bounds().empty() ? LogOdds{0} : a_.log_odds(cell);
    return sign_of(thresholds.state(in_a), b_.state(cell_under(lattice_, cell, b_, {}), thresholds));
  }
  [[nodiscard]] CellBox shown_part() const {
    const CellBox part = box_where(box_, [&](Cell cell) { return sign_at(cell) != Sign::unknown; });
    return part.empty() ? box_ : part.grown(kDifferenceMarginCells);
  }

  const OccupancyGrid& a_;
  const OccupancyGrid& b_;
  const OccupancyGrid& lattice_;
  CellBox box_;
};

Point at(const LandmarkGraph& graph, LandmarkId id) {
  return graph.find(id)->T_map_landmark.position();
}

class Drawing {
 public:
  explicit Drawing(const DifferencePicture& picture)
      : picture_(picture),
        a_(picture.a->graph),
        b_(picture.b->graph),
        difference_(*picture.difference),
        cells_(picture.a->grid, picture.b->grid),
        frame_(frame_of(extent(), cells_.box().empty() ? 1.0 : cells_.lattice().cell_m())) {}

  void write(const std::filesystem::path& file) const {
    const int width_px = page_width_px(frame_);
    const Legend legend(legend_entries(), width_px - frame_.box.min.x() - kPageMarginPx - kScaleBarRoomPx);
    const double legend_top_px = below_frame_px(frame_) + 10.0;
    Canvas canvas(width_px, static_cast<int>(std::ceil(legend_top_px + std::max(24.0, legend.height_px()) + 12.0)),
                  kPaper);
    canvas.fill_box(frame_.box, {cells_.box().empty() ? kWhite : kUnknown});
    if (!cells_.box().empty()) canvas.image(pixel_box_of(frame_, cells_.lattice(), cells_.box()), cells_.image());
    draw_routes(canvas);
    draw_landmarks(canvas);
    draw_border(canvas, frame_);
    draw_title(canvas, picture_.title, subtitle());
    legend.draw(canvas, {frame_.box.min.x(), legend_top_px});
    draw_scale_bar(canvas, frame_, {width_px - kPageMarginPx, legend_top_px + 12.0});
    canvas.write_png(file);
  }

 private:
  [[nodiscard]] Extent extent() const {
    constexpr double kMargin_m = 0.3;
    Extent extent;
    const Point origin_m = cells_.lattice().origin_m();
    if (!cells_.box().empty())
      for (const Cell corner : {cells_.box().min, cells_.box().max})
        extent.include(origin_m + cells_.lattice().cell_m() * Point(corner.x, corner.y));
    for (const LandmarkGraph* graph : {&a_, &b_})
      for (const auto& [id, landmark] : graph->landmarks())
        extent.include(landmark.T_map_landmark.position(), kMargin_m);
    return extent;
  }

  void draw_routes(Canvas& canvas) const {
    const auto draw = [&](const LandmarkGraph& graph, RouteId id, Colour colour, double width_px) {
      const Route& route = *graph.find_route(id);
      std::vector<Point> points{at(graph, route.from), at(graph, route.to)};
      if (!route.trajectory.empty()) {
        points.clear();
        for (const Pose2& pose : route.trajectory) points.push_back(pose.position());
      }
      canvas.line(frame_.pixels_of(points), {colour, width_px, 0.7});
    };
    for (const auto& [in_a, in_b] : difference_.routes_same) draw(b_, in_b, kFrame, 1.0);
    for (const auto& [in_a, in_b] : difference_.routes_changed) draw(b_, in_b, kMoved, 1.5);
    for (const RouteId id : difference_.routes_only_in_a) draw(a_, id, kGone, 1.5);
    for (const RouteId id : difference_.routes_only_in_b) draw(b_, id, kNew, 1.5);
  }

  void draw_landmarks(Canvas& canvas) const {
    LabelPlacer placer(frame_.box, [](const PixelBox&) { return 0.0; });
    std::size_t labels = 0;
    const auto draw = [&](const LandmarkGraph& graph, LandmarkId id, Colour colour, bool is_labelled) {
      const Pixel centre = frame_.pixel_of(at(graph, id));
      canvas.fill_disc(centre, kDotPx + 1.5, {kWhite});
      canvas.fill_disc(centre, kDotPx, {colour});
      if (!is_labelled || ++labels > kMaxLabels) return;
      const std::string label = label_of(*graph.find(id));
      const TextStyle style{colour, 12.5, Align::left, true};
      const auto box = placer.place(centre, kDotPx + 2.0, {Canvas::text_width_px(label, style) + 6.0, 16.0});
      if (!box) return;
      canvas.fill_box(*box, {kWhite, 0.8}, 3.0);
      canvas.text({box->min.x() + 3.0, box->centre().y()}, label, style);
    };
    for (const LandmarkPair& pair : difference_.same) draw(b_, pair.b, kFaintInk, false);
    for (const LandmarkPair& pair : difference_.moved) {
      const std::array ends{frame_.pixel_of(at(a_, pair.a)), frame_.pixel_of(at(b_, pair.b))};
      canvas.line(ends, {kMoved, 2.0});
      canvas.ring(ends[0], kDotPx, {kMoved, 1.5});
      draw(b_, pair.b, kMoved, true);
    }
    for (const LandmarkId id : difference_.only_in_a) draw(a_, id, kGone, true);
    for (const LandmarkId id : difference_.only_in_b) draw(b_, id, kNew, true);
  }

  [[nodiscard]] std::vector<LegendEntry> legend_entries() const {
    std::vector<LegendEntry> entries;
    if (!cells_.box().empty())
      for (const auto& [name, sign] : {std::pair{"new obstacle", Sign::wall_new},
                                       {"obstacle gone", Sign::wall_gone},
                                       {"same obstacle", Sign::wall},
                                       {"newly known free", Sign::free_new},
                                       {"no longer known", Sign::free_gone},
                                       {"same free", Sign::free}})
        entries.push_back(swatch_entry(name, colour_of(sign)));
    const auto dot = [&](const char* name, Colour colour, bool is_there) {
      if (is_there)
        entries.push_back({name, [colour](Canvas& canvas, const Pixel& p) { canvas.fill_disc(p, kDotPx, {colour}); }});
    };
    dot("same landmark", kFaintInk, !difference_.same.empty());
    dot("moved from the ring", kMoved, !difference_.moved.empty());
    dot("landmark gone", kGone, !difference_.only_in_a.empty());
    dot("new landmark", kNew, !difference_.only_in_b.empty());
    return entries;
  }

  [[nodiscard]] std::string subtitle() const {
    return fmt::format("{} cells of another state,  {} landmarks new,  {} gone,  {} moved",
                       difference_.cells_of_other_state(), difference_.only_in_b.size(), difference_.only_in_a.size(),
                       difference_.moved.size());
  }

  const DifferencePicture& picture_;
  const LandmarkGraph& a_;
  const LandmarkGraph& b_;
  const MapDifference& difference_;
  Cells cells_;
  MapFrame frame_;
};

}  // namespace

void write_difference_picture(const std::filesystem::path& file, const DifferencePicture& picture) {
  Drawing(picture).write(file);
}

}  // namespace cairn

#include "maps/pictures/timeline_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "maps/pictures/drawing/colours.hpp"
#include "maps/pictures/drawing/legend.hpp"
#include "maps/pictures/drawing/map_frame.hpp"

namespace cairn {
namespace {

using namespace pictures;

constexpr double kPlotPx = 860.0;
constexpr double kTimelineRowPx = 22.0;
constexpr double kTimelineBarPx = 13.0;
constexpr double kTimelineTopPx = 76.0;
constexpr double kIndentPx = 12.0;
constexpr double kTimelineGapPx = 14.0;  // between labels and plot
constexpr double kApartPx = 8.0;         // between marks and rows
constexpr double kMinBarPx = 2.0;
constexpr double kAxisPx = 34.0;
constexpr double kMaxLabelPx = 380.0;
constexpr double kTicksApartPx = 90.0;
const TextStyle kLabel{kInk, 12.0};
const TextStyle kSmall{kFaintInk, 11.0};
const TextStyle kTime{kFaintInk, 11.0, Align::centre};

Colour colour_of(BarKind kind) {
  constexpr std::array kColours{kStart, kClosed, kPlanned};
  return kColours[static_cast<std::size_t>(kind)];
}

Colour colour_of(MarkKind kind) {
  constexpr std::array kColours{kRoute, kPlanned, kClosed, kRobot};
  return kColours[static_cast<std::size_t>(kind)];
}

std::string cut_to(std::string text, double width_px) {
  if (Canvas::text_width_px(text, kLabel) <= width_px) return text;
  while (!text.empty() && Canvas::text_width_px(text + "...", kLabel) > width_px) text.pop_back();
  return text + "...";
}

class Page {
 public:
  explicit Page(const Timeline& timeline) : timeline_(timeline) {
    for (const TimelineMarks& marks : timeline.marks)
      label_px_ = std::max(label_px_, Canvas::text_width_px(marks.label, kLabel));
    for (const TimelineRow& row : timeline.rows)
      label_px_ = std::max(label_px_, indent_px(row) + Canvas::text_width_px(row.label, kLabel));
    label_px_ = std::ceil(std::min(label_px_, kMaxLabelPx));
    left_px_ = kPageMarginPx + label_px_ + kTimelineGapPx;
    rows_top_px_ = kTimelineTopPx + (timeline.marks.empty() ? 0.0 : marks_px() + kApartPx);
    bottom_px_ = rows_top_px_ + kTimelineRowPx * static_cast<double>(timeline.rows.size());
    span_s_ = std::max(timeline.end_s - timeline.begin_s, 1e-3);
  }

  void draw(const std::filesystem::path& file) const {
    const Legend legend(signs(), kPlotPx + label_px_);
    const double height_px = bottom_px_ + kAxisPx + legend.height_px() + kPageMarginPx;
    Canvas canvas(static_cast<int>(std::ceil(left_px_ + kPlotPx + kPageMarginPx + 10.0)),
                  static_cast<int>(std::ceil(height_px)), kPaper);
    draw_title(canvas, timeline_.title, timeline_.subtitle);
    draw_ground(canvas);
    draw_axis(canvas);
    for (std::size_t i = 0; i < timeline_.marks.size(); ++i) draw_marks(canvas, timeline_.marks[i], i);
    for (std::size_t i = 0; i < timeline_.rows.size(); ++i) draw_row(canvas, timeline_.rows[i], i);
    legend.draw(canvas, {kPageMarginPx, bottom_px_ + kAxisPx});
    canvas.write_png(file);
  }

 private:
  static double indent_px(const TimelineRow& row) { return kIndentPx * static_cast<double>(row.depth); }
  [[nodiscard]] double marks_px() const { return kTimelineRowPx * static_cast<double>(timeline_.marks.size()); }
  [[nodiscard]] double x_px(double time_s) const {
    return left_px_ + kPlotPx * std::clamp((time_s - timeline_.begin_s) / span_s_, 0.0, 1.0);
  }

  void draw_ground(Canvas& canvas) const {
    const auto box = [&](double top_px, double height_px) {
      return PixelBox{{left_px_, top_px}, {left_px_ + kPlotPx, top_px + height_px}};
    };
    if (!timeline_.marks.empty()) canvas.fill_box(box(kTimelineTopPx, marks_px()), {kWhite});
    canvas.fill_box(box(rows_top_px_, bottom_px_ - rows_top_px_), {kWhite});
    for (std::size_t i = 1; i < timeline_.rows.size(); i += 2)
      canvas.fill_box(box(rows_top_px_ + kTimelineRowPx * static_cast<double>(i), kTimelineRowPx), {kPaper});
  }

  void draw_axis(Canvas& canvas) const {
    const double step_s = round_at_least(span_s_ * kTicksApartPx / kPlotPx);
    const double first = std::ceil(timeline_.begin_s / step_s - 1e-9);
    for (int i = 0;; ++i) {
      const double time_s = (first + i) * step_s;
      if (time_s > timeline_.begin_s + span_s_ + 1e-9) break;
      const double x = x_px(time_s);
      canvas.line(std::array{Pixel(x, kTimelineTopPx), Pixel(x, bottom_px_ + 4.0)}, {kFrame, 1.0, 0.5});
      canvas.text({x, bottom_px_ + 15.0}, short_text(time_s, decimals_for(step_s)), kTime);
    }
    canvas.text({left_px_ - kTimelineGapPx, bottom_px_ + 15.0}, "time, s", {kFaintInk, 11.0, Align::right});
    canvas.line(std::array{Pixel(left_px_, bottom_px_), Pixel(left_px_ + kPlotPx, bottom_px_)}, {kFrame, 1.0});
  }

  void draw_marks(Canvas& canvas, const TimelineMarks& marks, std::size_t row) const {
    const double y = kTimelineTopPx + kTimelineRowPx * (static_cast<double>(row) + 0.5);
    canvas.text({kPageMarginPx, y}, marks.label, kLabel);
    const Colour colour = colour_of(marks.kind);
    for (std::size_t i = 0; i < marks.marks.size(); ++i) {
      const TimelineMark& mark = marks.marks[i];
      const PixelBox box = bar_box(mark.begin_s, mark.end_s, y);
      canvas.fill_box(box, {colour});
      if (marks.kind == MarkKind::pause)
        canvas.line(std::array{Pixel(box.min.x(), y), Pixel(box.min.x(), bottom_px_)}, {colour, 1.0, 0.8, 3.0});
      const double next_px = i + 1 < marks.marks.size() ? x_px(marks.marks[i + 1].begin_s) : left_px_ + kPlotPx;
      const Pixel beside(box.max.x() + 4.0, y);
      if (!mark.text.empty() && beside.x() + Canvas::text_width_px(mark.text, kSmall) < next_px)
        canvas.text(beside, mark.text, kSmall);
    }
  }

  void draw_row(Canvas& canvas, const TimelineRow& row, std::size_t at) const {
    const double y = rows_top_px_ + kTimelineRowPx * (static_cast<double>(at) + 0.5);
    const double indent = std::min(indent_px(row), label_px_ / 2.0);
    canvas.text({kPageMarginPx + indent, y}, cut_to(row.label, label_px_ - indent), kLabel);
    for (const TimelineBar& bar : row.bars) {
      const PixelBox box = bar_box(bar.begin_s, bar.end_s, y);
      canvas.fill_box(box, {colour_of(bar.kind)});
      // A white edge keeps one round apart from the next.
      if (box.width() > 2.0 * kMinBarPx)
        canvas.line(std::array{Pixel(box.max.x() - 0.5, box.min.y()), Pixel(box.max.x() - 0.5, box.max.y())},
                    {kWhite, 1.0});
    }
  }

  [[nodiscard]] PixelBox bar_box(double begin_s, double end_s, double y_px) const {
    const double begin_px = std::min(x_px(begin_s), left_px_ + kPlotPx - kMinBarPx);
    const double end_px = std::max(x_px(end_s), begin_px + kMinBarPx);
    return {{begin_px, y_px - kTimelineBarPx / 2.0}, {end_px, y_px + kTimelineBarPx / 2.0}};
  }

  [[nodiscard]] static std::vector<LegendEntry> signs() {
    return {swatch_entry("success", colour_of(BarKind::success)), swatch_entry("failure", colour_of(BarKind::failure)),
            swatch_entry("halted", colour_of(BarKind::halted))};
  }

  const Timeline& timeline_;
  double label_px_ = 0.0;
  double left_px_ = 0.0;
  double rows_top_px_ = 0.0;
  double bottom_px_ = 0.0;
  double span_s_ = 1.0;
};

}  // namespace

void write_timeline_picture(const std::filesystem::path& file, const Timeline& timeline) {
  if (timeline.rows.size() > kMaxTimelineRows)
    throw std::runtime_error(fmt::format("{}: the timeline has {} rows; a picture holds at most {}", file.string(),
                                         timeline.rows.size(), kMaxTimelineRows));
  Page(timeline).draw(file);
}

}  // namespace cairn

#include "maps/pictures/tree_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "maps/pictures/drawing/colours.hpp"
#include "maps/pictures/drawing/map_frame.hpp"

namespace cairn {
namespace {

using namespace pictures;

constexpr double kBoxPx = 40.0;
constexpr double kTreeRowPx = 52.0;
constexpr double kTreeGapPx = 46.0;  // between columns
constexpr double kInsidePx = 12.0;
constexpr double kTreeTopPx = 76.0;
constexpr double kTreeBarPx = 5.0;
constexpr std::size_t kMaxLetters = 44;
const TextStyle kTitle{kInk, 13.0, Align::left, true};
const TextStyle kDetail{kFaintInk, 11.0};

Colour colour_of(BoxKind kind) {
  constexpr std::array kColours{kRoute, kPlanned, kDriven, kStart};
  return kColours[static_cast<std::size_t>(kind)];
}

std::string cut(const std::string& text) {
  return text.size() <= kMaxLetters ? text : text.substr(0, kMaxLetters - 3) + "...";
}

struct Placed {
  std::string title;
  std::string detail;
  BoxKind kind = BoxKind::action;
  std::size_t column = 0;
  double y_px = 0.0;  // of its middle
  std::vector<std::size_t> children{};
};

struct TreeLayout {
  std::vector<Placed> boxes{};
  std::vector<double> widths_px{};  // of the columns
  std::size_t rows = 0;

  // A parent stands half way between its first and its last child.
  std::size_t place(const TreeBox& box, std::size_t column) {
    const std::size_t at = boxes.size();
    boxes.push_back({cut(box.title), cut(box.detail), box.kind, column});
    widths_px.resize(std::max(widths_px.size(), column + 1));
    const double width_px =
        std::max(Canvas::text_width_px(boxes[at].title, kTitle), Canvas::text_width_px(boxes[at].detail, kDetail));
    widths_px[column] = std::max(widths_px[column], std::ceil(width_px) + 2.0 * kInsidePx + kTreeBarPx);
    for (const TreeBox& child : box.children) {
      const std::size_t index = place(child, column + 1);
      boxes[at].children.push_back(index);
    }
    if (box.children.empty())
      boxes[at].y_px = kTreeTopPx + kTreeRowPx * (static_cast<double>(rows++) + 0.5);
    else
      boxes[at].y_px = (boxes[boxes[at].children.front()].y_px + boxes[boxes[at].children.back()].y_px) / 2.0;
    return at;
  }

  [[nodiscard]] double left_px(std::size_t column) const {
    double left_px = kPageMarginPx;
    for (std::size_t i = 0; i < column; ++i) left_px += widths_px[i] + kTreeGapPx;
    return left_px;
  }
  [[nodiscard]] PixelBox box_of(const Placed& box) const {
    const Pixel upper_left(left_px(box.column), box.y_px - kBoxPx / 2.0);
    return {upper_left, upper_left + Pixel(widths_px[box.column], kBoxPx)};
  }
};

void draw_edge(Canvas& canvas, const PixelBox& parent, const PixelBox& child) {
  const Pixel from(parent.max.x(), parent.centre().y());
  const Pixel to(child.min.x(), child.centre().y());
  const double middle_px = to.x() - kTreeGapPx / 2.0;
  canvas.line(std::array{from, Pixel(middle_px, from.y()), Pixel(middle_px, to.y()), to}, {kFrame, 1.5});
}

void draw_box(Canvas& canvas, const PixelBox& box, const Placed& placed) {
  canvas.fill_box(box, {kWhite}, 5.0);
  canvas.outline(box, {kFrame, 1.0});
  canvas.fill_box({box.min, {box.min.x() + kTreeBarPx, box.max.y()}}, {colour_of(placed.kind)});
  const double left_px = box.min.x() + kTreeBarPx + kInsidePx;
  const double apart_px = placed.detail.empty() ? 0.0 : 8.0;
  canvas.text({left_px, placed.y_px - apart_px}, placed.title, kTitle);
  if (!placed.detail.empty()) canvas.text({left_px, placed.y_px + apart_px + 1.0}, placed.detail, kDetail);
}

std::size_t rows_of(const TreeBox& box) {
  std::size_t rows = box.children.empty() ? 1 : 0;
  for (const TreeBox& child : box.children) rows += rows_of(child);
  return rows;
}

}  // namespace

void write_tree_picture(const std::filesystem::path& file, const TreeBox& root, const std::string& title,
                        const std::string& subtitle) {
  if (const std::size_t rows = rows_of(root); rows > kMaxPictureRows)
    throw std::runtime_error(
        fmt::format("{}: the tree has {} rows; a picture holds at most {}", file.string(), rows, kMaxPictureRows));
  TreeLayout layout;
  layout.place(root, 0);
  const double words_px = kPageMarginPx + std::max(Canvas::text_width_px(title, {kInk, 20.0, Align::left, true}),
                                                   Canvas::text_width_px(subtitle, {kInk, 13.0}));
  const double width_px = std::max(words_px, layout.left_px(layout.widths_px.size()) - kTreeGapPx) + kPageMarginPx;
  const double height_px = kTreeTopPx + kTreeRowPx * static_cast<double>(layout.rows) + kPageMarginPx;
  Canvas canvas(static_cast<int>(std::ceil(width_px)), static_cast<int>(std::ceil(height_px)), kPaper);
  draw_title(canvas, title, subtitle);
  for (const Placed& box : layout.boxes)
    for (const std::size_t child : box.children)
      draw_edge(canvas, layout.box_of(box), layout.box_of(layout.boxes[child]));
  for (const Placed& box : layout.boxes) draw_box(canvas, layout.box_of(box), box);
  canvas.write_png(file);
}

}  // namespace cairn

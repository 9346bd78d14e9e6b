#include "maps/pictures/drawing/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "maps/pictures/drawing/png_file.hpp"

namespace cairn::pictures {
namespace {

constexpr int kSamplesPerPixel = 2;
constexpr int kShift = 4;  // OpenCV takes points in 1/16 of a sample
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontUnitsPerCapital = 21.0;
constexpr double kCapitalPerSize = 0.70;

cv::Mat view_of(std::vector<std::uint8_t>& samples, int width_px, int height_px) {
  return {height_px * kSamplesPerPixel, width_px * kSamplesPerPixel, CV_8UC3, samples.data()};
}

// What is drawn far outside, or nowhere at all, must not overflow whole numbers.
double within_reach(double samples) {
  constexpr double kReach = 1e7;
  return std::max(-kReach, std::min(kReach, samples));  // in this order NaN becomes kReach
}

cv::Rect clipped(const cv::Mat& target, const PixelBox& box, double margin_px) {
  const auto low = [&](double value) {
    return static_cast<int>(std::floor(within_reach((value - margin_px) * kSamplesPerPixel)));
  };
  const auto high = [&](double value) {
    return static_cast<int>(std::ceil(within_reach((value + margin_px) * kSamplesPerPixel)));
  };
  const cv::Rect wanted(cv::Point(low(box.min.x()), low(box.min.y())), cv::Point(high(box.max.x()), high(box.max.y())));
  return wanted & cv::Rect(0, 0, target.cols, target.rows);
}

cv::Point fixed_point(const Pixel& p, const cv::Rect& part) {
  // A sample's centre is a whole number to OpenCV.
  const auto fixed = [](double sample) {
    return static_cast<int>(std::lround(within_reach(sample - 0.5) * (1 << kShift)));
  };
  return {fixed(p.x() * kSamplesPerPixel - part.x), fixed(p.y() * kSamplesPerPixel - part.y)};
}

int fixed_length(double length_px) {
  return static_cast<int>(std::lround(length_px * kSamplesPerPixel * (1 << kShift)));
}

int thickness_of(double width_px) {
  return std::max(1, static_cast<int>(std::lround(width_px * kSamplesPerPixel)));
}

PixelBox box_of(std::span<const Pixel> points) {
  PixelBox box{points.front(), points.front()};
  for (const Pixel& p : points) {
    box.min = box.min.cwiseMin(p);
    box.max = box.max.cwiseMax(p);
  }
  return box;
}

void blend(cv::Mat& target, const cv::Rect& part, const cv::Mat& mask, Colour colour, double opacity) {
  const std::array<int, 3> paint{colour.red, colour.green, colour.blue};
  const int weight = static_cast<int>(std::lround(opacity * 256.0));
  for (int y = 0; y < part.height; ++y) {
    const std::uint8_t* covered = mask.ptr(y);
    std::uint8_t* rgb = target.ptr(part.y + y) + 3 * part.x;
    for (int x = 0; x < part.width; ++x, rgb += 3) {
      if (covered[x] == 0) continue;
      const int alpha = covered[x] * weight;  // of 255 * 256
      for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = static_cast<std::uint8_t>(rgb[c] + ((paint[c] - rgb[c]) * alpha) / (255 * 256));
    }
  }
}

// Draws with one colour through a mask, so that a shape which covers itself stays evenly see-through.
template <typename Draw>
void paint(cv::Mat target, const PixelBox& box, double margin_px, const Fill& fill, Draw draw) {
  const cv::Rect part = clipped(target, box, margin_px + 1.0);
  if (part.empty()) return;
  cv::Mat mask(part.size(), CV_8U, cv::Scalar(0));
  draw(mask, part);
  blend(target, part, mask, fill.colour, fill.opacity);
}

std::vector<cv::Point> fixed_points(std::span<const Pixel> points, const cv::Rect& part) {
  std::vector<cv::Point> fixed;
  for (const Pixel& p : points) fixed.push_back(fixed_point(p, part));
  return fixed;
}

// Cuts a line into the dashes to draw.
std::vector<std::vector<Pixel>> dashes_of(std::span<const Pixel> points, double dash_px) {
  std::vector<std::vector<Pixel>> dashes{{points.front()}};
  bool drawing = true;
  double left_px = dash_px;
  for (std::size_t i = 1; i < points.size(); ++i) {
    Pixel from = points[i - 1];
    double length_px = (points[i] - from).norm();
    while (length_px > left_px) {
      from += (points[i] - from) * (left_px / length_px);
      length_px -= left_px;
      left_px = dash_px;
      if (drawing) dashes.back().push_back(from);
      if (!drawing) dashes.push_back({from});
      drawing = !drawing;
    }
    left_px -= length_px;
    if (drawing) dashes.back().push_back(points[i]);
  }
  return dashes;
}

struct Lettering {
  double scale = 1.0;
  int thickness = 1;
};

Lettering lettering_of(const TextStyle& style) {
  const double size = style.size_px * kSamplesPerPixel;
  return {size * kCapitalPerSize / kFontUnitsPerCapital,
          std::max(1, static_cast<int>(std::lround(size / (style.bold ? 9.0 : 13.0))))};
}

cv::Mat shrunk(const CellImage& cells, const cv::Size& size) {
  const cv::Mat whole(cells.height, cells.width, CV_8UC3, const_cast<Colour*>(cells.colours.data()));
  cv::Mat result;
  const bool shrinks = size.width < cells.width || size.height < cells.height;
  cv::resize(whole, result, size, 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_NEAREST);
  return result;
}

}  // namespace

static_assert(sizeof(Colour) == 3);  // CellImage is read as rows of RGB

Canvas::Canvas(int width_px, int height_px, Colour background) : width_px_(width_px), height_px_(height_px) {
  samples_.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 3 * kSamplesPerPixel *
                  kSamplesPerPixel);
  view_of(samples_, width_px, height_px) = cv::Scalar(background.red, background.green, background.blue);
}

void Canvas::fill_box(const PixelBox& box, const Fill& fill, double corner_radius_px) {
  const double r = corner_radius_px;
  std::vector<Pixel> corners;
  const std::array<Pixel, 4> centres{Pixel{box.max.x() - r, box.max.y() - r}, Pixel{box.min.x() + r, box.max.y() - r},
                                     Pixel{box.min.x() + r, box.min.y() + r}, Pixel{box.max.x() - r, box.min.y() + r}};
  const int steps = r > 0.0 ? 8 : 0;
  for (std::size_t corner = 0; corner < 4; ++corner)
    for (int i = 0; i <= steps; ++i) {
      const double angle_rad = (static_cast<double>(corner) + (steps > 0 ? i / 8.0 : 0.0)) * CV_PI / 2.0;
      corners.push_back(centres[corner] + r * Pixel(std::cos(angle_rad), std::sin(angle_rad)));
    }
  if (r > 0.0) return fill_polygon(corners, fill);
  paint(view_of(samples_, width_px_, height_px_), box, -1.0, fill, [](cv::Mat& mask, const cv::Rect&) { mask = 255; });
}

void Canvas::fill_polygon(std::span<const Pixel> corners, const Fill& fill) {
  if (corners.size() < 3) return;
  paint(view_of(samples_, width_px_, height_px_), box_of(corners), 1.0, fill, [&](cv::Mat& mask, const cv::Rect& part) {
    cv::fillPoly(mask, std::vector{fixed_points(corners, part)}, cv::Scalar(255), cv::LINE_AA, kShift);
  });
}

void Canvas::fill_disc(const Pixel& centre, double radius_px, const Fill& fill) {
  paint(view_of(samples_, width_px_, height_px_), {centre, centre}, radius_px, fill,
        [&](cv::Mat& mask, const cv::Rect& part) {
          cv::circle(mask, fixed_point(centre, part), fixed_length(radius_px), cv::Scalar(255), cv::FILLED, cv::LINE_AA,
                     kShift);
        });
}

void Canvas::line(std::span<const Pixel> points, const Stroke& stroke) {
  if (points.size() < 2) return;
  paint(view_of(samples_, width_px_, height_px_), box_of(points), stroke.width_px, {stroke.colour, stroke.opacity},
        [&](cv::Mat& mask, const cv::Rect& part) {
          std::vector<std::vector<cv::Point>> segments;
          if (stroke.dash_px <= 0.0) segments.push_back(fixed_points(points, part));
          if (stroke.dash_px > 0.0)
            for (const auto& dash : dashes_of(points, stroke.dash_px)) segments.push_back(fixed_points(dash, part));
          cv::polylines(mask, segments, false, cv::Scalar(255), thickness_of(stroke.width_px), cv::LINE_AA, kShift);
        });
}

void Canvas::outline(std::span<const Pixel> corners, const Stroke& stroke) {
  std::vector<Pixel> closed(corners.begin(), corners.end());
  if (!closed.empty()) closed.push_back(closed.front());
  line(closed, stroke);
}

void Canvas::outline(const PixelBox& box, const Stroke& stroke) {
  outline(std::array{box.min, Pixel(box.max.x(), box.min.y()), box.max, Pixel(box.min.x(), box.max.y())}, stroke);
}

void Canvas::ring(const Pixel& centre, double radius_px, const Stroke& stroke) {
  paint(view_of(samples_, width_px_, height_px_), {centre, centre}, radius_px + stroke.width_px,
        {stroke.colour, stroke.opacity}, [&](cv::Mat& mask, const cv::Rect& part) {
          cv::circle(mask, fixed_point(centre, part), fixed_length(radius_px), cv::Scalar(255),
                     thickness_of(stroke.width_px), cv::LINE_AA, kShift);
        });
}

void Canvas::image(const PixelBox& box, const CellImage& cells) {
  cv::Mat target = view_of(samples_, width_px_, height_px_);
  const cv::Rect part = clipped(target, box, 0.0);
  if (part.empty() || cells.colours.empty()) return;
  shrunk(cells, part.size()).copyTo(target(part));
}

void Canvas::text(const Pixel& at, const std::string& words, const TextStyle& style) {
  const Lettering lettering = lettering_of(style);
  const double width_px = text_width_px(words, style);
  const double shift = style.align == Align::left ? 0.0 : style.align == Align::centre ? 0.5 : 1.0;
  const Pixel left = at - Pixel(shift * width_px, 0.0);
  const Pixel baseline = left + Pixel(0.0, style.size_px * kCapitalPerSize / 2.0);
  paint(view_of(samples_, width_px_, height_px_), {left, left + Pixel(width_px, 0.0)}, style.size_px,
        {style.colour, 1.0}, [&](cv::Mat& mask, const cv::Rect& part) {
          const cv::Point origin(static_cast<int>(std::lround(baseline.x() * kSamplesPerPixel)) - part.x,
                                 static_cast<int>(std::lround(baseline.y() * kSamplesPerPixel)) - part.y);
          cv::putText(mask, words, origin, kFont, lettering.scale, cv::Scalar(255), lettering.thickness, cv::LINE_AA);
        });
}

double Canvas::text_width_px(const std::string& words, const TextStyle& style) {
  const Lettering lettering = lettering_of(style);
  int below = 0;
  return cv::getTextSize(words, kFont, lettering.scale, lettering.thickness, &below).width /
         static_cast<double>(kSamplesPerPixel);
}

void Canvas::write_png(const std::filesystem::path& file) const {
  std::vector<std::uint8_t> rgb(samples_.size() / (kSamplesPerPixel * kSamplesPerPixel));
  cv::Mat picture(height_px_, width_px_, CV_8UC3, rgb.data());
  cv::resize(view_of(const_cast<std::vector<std::uint8_t>&>(samples_), width_px_, height_px_), picture, picture.size(),
             0, 0, cv::INTER_AREA);
  write_png_file(file, width_px_, height_px_, rgb);
}

}  // namespace cairn::pictures

// A picture being drawn: anti-aliased shapes and text over a background, written as a PNG.
//
// Coordinates are picture pixels, x right, y down; (0, 0) is the upper left corner of the upper left
// pixel. Everything is drawn finer than shown and averaged down when written. The same calls give the
// same bytes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace cairn::pictures {

using Pixel = Eigen::Vector2d;

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  bool operator==(const Colour&) const = default;
};

struct Fill {
  Colour colour;
  double opacity = 1.0;
};

struct Stroke {
  Colour colour;
  double width_px = 1.0;
  double opacity = 1.0;
  double dash_px = 0.0;  // length of dashes and gaps; 0 draws through
};

enum class Align : std::uint8_t { left, centre, right };

struct TextStyle {
  Colour colour;
  double size_px = 13.0;
  Align align = Align::left;
  bool bold = false;
};

struct PixelBox {
  Pixel min{0.0, 0.0};
  Pixel max{0.0, 0.0};

  [[nodiscard]] Pixel centre() const { return (min + max) / 2.0; }
  [[nodiscard]] double width() const { return max.x() - min.x(); }
  [[nodiscard]] double height() const { return max.y() - min.y(); }
};

// A picture of colours, one a cell, row by row from above.
struct CellImage {
  int width = 0;
  int height = 0;
  std::vector<Colour> colours;
};

class Canvas {
 public:
  Canvas(int width_px, int height_px, Colour background);

  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int height_px() const { return height_px_; }

  void fill_box(const PixelBox& box, const Fill& fill, double corner_radius_px = 0.0);
  void fill_polygon(std::span<const Pixel> corners, const Fill& fill);
  void fill_disc(const Pixel& centre, double radius_px, const Fill& fill);
  void line(std::span<const Pixel> points, const Stroke& stroke);
  void outline(std::span<const Pixel> corners, const Stroke& stroke);
  void outline(const PixelBox& box, const Stroke& stroke);
  void ring(const Pixel& centre, double radius_px, const Stroke& stroke);
  // The image stretched over the box: cells stay sharp when they grow, average when they shrink.
  void image(const PixelBox& box, const CellImage& cells);
  // One line of ASCII text; the point is at its left end, centre or right end, half way up a capital.
  void text(const Pixel& at, const std::string& words, const TextStyle& style);
  [[nodiscard]] static double text_width_px(const std::string& words, const TextStyle& style);

  // Throws std::runtime_error with the file and the reason.
  void write_png(const std::filesystem::path& file) const;

 private:
  int width_px_;
  int height_px_;
  std::vector<std::uint8_t> samples_;  // RGB, kSamplesPerPixel times finer both ways
};

}  // namespace cairn::pictures

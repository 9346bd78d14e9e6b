// Reads by libpng itself, as pictures are written: OpenCV's reader would load a hundred libraries.
#include <fmt/format.h>
#include <png.h>

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "maps/landmarks/outline.hpp"

namespace cairn {
namespace {

constexpr double kSmoothing_px = 0.75;
constexpr double kFineSmoothing_px = 0.25;

struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(this); }
};

cv::Mat1b grey_picture(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw std::invalid_argument("no such picture: " + file.string());
  // A pipe would be waited for without end.
  if (!std::filesystem::is_regular_file(file, error))
    throw std::invalid_argument(file.string() + " is not a plain file");
  PngImage image;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0)
    throw std::invalid_argument(file.string() + " is not a PNG picture: " + image.message);
  if (image.width > kMaxPictureSide_px || image.height > kMaxPictureSide_px)
    throw std::invalid_argument(fmt::format("{} has {} x {} pixels, at most {} x {} are read", file.string(),
                                            image.width, image.height, kMaxPictureSide_px, kMaxPictureSide_px));
  image.format = PNG_FORMAT_GRAY;
  cv::Mat1b grey(static_cast<int>(image.height), static_cast<int>(image.width));
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&image, &white, grey.data, static_cast<png_int_32>(grey.step), nullptr) == 0)
    throw std::invalid_argument(file.string() + " cannot be read: " + image.message);
  return grey;
}

// 255 where the thing is, with a rim of ground all round.
cv::Mat1b thing_in(const cv::Mat1b& grey, const std::filesystem::path& file) {
  cv::Mat1b bright;
  cv::threshold(grey, bright, 127.0, 255.0, cv::THRESH_BINARY);
  const int rim = 2 * (bright.rows + bright.cols);
  const int bright_rim = cv::countNonZero(bright.row(0)) + cv::countNonZero(bright.row(bright.rows - 1)) +
                         cv::countNonZero(bright.col(0)) + cv::countNonZero(bright.col(bright.cols - 1));
  cv::Mat1b thing = bright;
  if (2 * bright_rim >= rim) cv::bitwise_not(bright, thing);
  if (cv::countNonZero(thing) == 0) throw std::invalid_argument(file.string() + " is of one colour, it shows nothing");
  cv::Mat1b padded;
  cv::copyMakeBorder(thing, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  return padded;
}

// Fills one of two pixels between pieces that touch only with a corner: an outline must not touch itself.
void join_corners(cv::Mat1b& thing) {
  for (bool changed = true; changed;) {
    changed = false;
    for (int y = 0; y + 1 < thing.rows; ++y) {
      for (int x = 0; x + 1 < thing.cols; ++x) {
        const bool falling = thing(y, x) != 0 && thing(y + 1, x + 1) != 0;
        const bool rising = thing(y + 1, x) != 0 && thing(y, x + 1) != 0;
        const int set = (thing(y, x) + thing(y + 1, x + 1) + thing(y + 1, x) + thing(y, x + 1)) / 255;
        if (set != 2 || falling == rising) continue;
        (falling ? thing(y, x + 1) : thing(y, x)) = 255;
        changed = true;
      }
    }
  }
}

using Traces = std::vector<std::vector<cv::Point>>;

// Along the edges of the pixels, in half pixels. OpenCV follows the middles of pixels. In a picture of twice
// the size, each thing one pixel wider, these are the edges of the pixels here.
Traces pixel_edges_in(const cv::Mat1b& thing) {
  cv::Mat1b lattice;
  cv::resize(thing, lattice, {}, 2.0, 2.0, cv::INTER_NEAREST);
  cv::dilate(lattice, lattice, cv::Mat1b::ones(2, 2), {1, 1});
  Traces traces;
  cv::findContours(lattice, traces, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  return traces;
}

std::vector<std::vector<Point>> smoothed(const Traces& traces, double smoothing_px, double pixel_m) {
  std::vector<std::vector<Point>> outlines;
  std::size_t count = 0;
  for (const std::vector<cv::Point>& trace : traces) {
    std::vector<cv::Point> corners;
    cv::approxPolyDP(trace, corners, 2.0 * smoothing_px, true);
    if (corners.size() < 3) cv::approxPolyDP(trace, corners, 0.0, true);
    std::vector<Point>& outline = outlines.emplace_back();
    for (const cv::Point& c : corners) outline.push_back(0.5 * pixel_m * Point(c.x, -c.y));
    count += corners.size();
  }
  if (count > kMaxPictureCorners)
    throw std::invalid_argument(fmt::format(
        "the picture's outline is too ragged: it has {} corners, at most {} are taken", count, kMaxPictureCorners));
  return outlines;
}

}  // namespace

Contour contour_in_picture(const std::filesystem::path& file, double pixel_m) {
  cv::Mat1b thing = thing_in(grey_picture(file), file);
  join_corners(thing);
  const Traces traces = pixel_edges_in(thing);
  try {
    return Contour::parts(smoothed(traces, kSmoothing_px, pixel_m));
  } catch (const std::invalid_argument&) {
    // Smoothing has closed a narrow gap.
    return Contour::parts(smoothed(traces, kFineSmoothing_px, pixel_m));
  }
}

}  // namespace cairn

// OpenCV's reader would load a hundred libraries.
#include "plugins/common/pictures/grey_picture.hpp"

#include <fmt/format.h>
#include <jpeglib.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

namespace cairn::pictures {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Grey = std::vector<std::uint8_t>;

constexpr std::array<std::uint8_t, 4> kPngBegin{0x89, 'P', 'N', 'G'};
constexpr std::array<std::uint8_t, 3> kJpegBegin{0xff, 0xd8, 0xff};

bool begins_with(Bytes bytes, Bytes begin) {
  return bytes.size() >= begin.size() && std::ranges::equal(bytes.first(begin.size()), begin);
}

void check_limits(std::uint64_t width_px, std::uint64_t height_px) {
  if (width_px == 0 || height_px == 0 || width_px > kMaxSide_px || height_px > kMaxSide_px)
    throw std::runtime_error(fmt::format("a picture of {} x {} pixels; 1 x 1 to {} x {} are read", width_px, height_px,
                                         kMaxSide_px, kMaxSide_px));
}

CameraImage image_of(std::uint32_t width_px, std::uint32_t height_px, Grey grey) {
  CameraImage image;
  image.width_px = static_cast<int>(width_px);
  image.height_px = static_cast<int>(height_px);
  image.grey = std::make_shared<const Grey>(std::move(grey));
  return image;
}

struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(this); }
};

CameraImage from_png(Bytes bytes) {
  PngImage png;
  const auto check = [&](int is_good) {
    if (is_good == 0 || PNG_IMAGE_FAILED(png))
      throw std::runtime_error(fmt::format("the PNG cannot be read: {}", png.message));
  };
  check(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()));
  check_limits(png.width, png.height);
  png.format = PNG_FORMAT_GRAY;
  Grey grey(std::size_t{png.width} * png.height);
  const png_color white{255, 255, 255};
  check(png_image_finish_read(&png, &white, grey.data(), static_cast<png_int_32>(png.width), nullptr));
  return image_of(png.width, png.height, std::move(grey));
}

struct JpegErrors : jpeg_error_mgr {
  std::jmp_buf way_out;
  char what[JMSG_LENGTH_MAX];
};

[[noreturn]] void leave(j_common_ptr jpeg) {
  auto* const errors = static_cast<JpegErrors*>(jpeg->err);
  errors->format_message(jpeg, errors->what);
  std::longjmp(errors->way_out, 1);
}

// Damaged data are a warning to the library, which would go on with a made-up picture.
void leave_at_warning(j_common_ptr jpeg, int level) {
  if (level < 0) leave(jpeg);
}

struct JpegReader : jpeg_decompress_struct {
  JpegReader() : jpeg_decompress_struct{} {
    err = jpeg_std_error(&errors);
    errors.error_exit = leave;
    errors.emit_message = leave_at_warning;
    jpeg_create_decompress(this);
  }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;
  ~JpegReader() { jpeg_destroy_decompress(this); }

  JpegErrors errors{};
};

// Both are left by a jump at an error: nothing in them may need a destructor.
bool read_head(JpegReader& jpeg, Bytes bytes) {
  if (setjmp(jpeg.errors.way_out) != 0) return false;
  jpeg_mem_src(&jpeg, bytes.data(), bytes.size());
  (void)jpeg_read_header(&jpeg, TRUE);
  return true;
}

bool read_rows(JpegReader& jpeg, std::uint8_t* grey) {
  if (setjmp(jpeg.errors.way_out) != 0) return false;
  jpeg.out_color_space = JCS_GRAYSCALE;
  (void)jpeg_start_decompress(&jpeg);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = grey + std::size_t{jpeg.output_scanline} * jpeg.output_width;
    (void)jpeg_read_scanlines(&jpeg, &row, 1);
  }
  (void)jpeg_finish_decompress(&jpeg);
  return true;
}

CameraImage from_jpeg(Bytes bytes) {
  JpegReader jpeg;
  const auto check = [&](bool is_good) {
    if (!is_good) throw std::runtime_error(fmt::format("the JPEG cannot be read: {}", jpeg.errors.what));
  };
  check(read_head(jpeg, bytes));
  check_limits(jpeg.image_width, jpeg.image_height);
  Grey grey(std::size_t{jpeg.image_width} * jpeg.image_height);
  check(read_rows(jpeg, grey.data()));
  return image_of(jpeg.image_width, jpeg.image_height, std::move(grey));
}

struct Encoding {
  std::string_view name;
  int type;     // of OpenCV
  int to_grey;  // likewise; kGrey: it is grey already
};

constexpr int kGrey = -1;
// Bayer patterns are named after their second row and column in OpenCV.
constexpr std::array kEncodings{Encoding{"mono8", CV_8UC1, kGrey},
                                Encoding{"8UC1", CV_8UC1, kGrey},
                                Encoding{"mono16", CV_16UC1, kGrey},
                                Encoding{"rgb8", CV_8UC3, cv::COLOR_RGB2GRAY},
                                Encoding{"bgr8", CV_8UC3, cv::COLOR_BGR2GRAY},
                                Encoding{"8UC3", CV_8UC3, cv::COLOR_BGR2GRAY},
                                Encoding{"rgba8", CV_8UC4, cv::COLOR_RGBA2GRAY},
                                Encoding{"bgra8", CV_8UC4, cv::COLOR_BGRA2GRAY},
                                Encoding{"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2GRAY},
                                Encoding{"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2GRAY},
                                Encoding{"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2GRAY},
                                Encoding{"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2GRAY},
                                Encoding{"yuv422", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY},
                                Encoding{"uyvy", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY},
                                Encoding{"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2GRAY_YUY2},
                                Encoding{"yuyv", CV_8UC2, cv::COLOR_YUV2GRAY_YUY2}};

const Encoding& encoding_of(const RawPicture& raw) {
  const auto found = std::ranges::find(kEncodings, raw.encoding, &Encoding::name);
  if (found != kEncodings.end()) return *found;
  std::string known;
  for (const Encoding& encoding : kEncodings) known.append(known.empty() ? "" : ", ").append(encoding.name);
  throw std::runtime_error(fmt::format("a picture in the encoding \"{}\"; read are {}", raw.encoding, known));
}

}  // namespace

CameraImage unpacked(std::span<const std::uint8_t> bytes) {
  if (begins_with(bytes, kPngBegin)) return from_png(bytes);
  if (begins_with(bytes, kJpegBegin)) return from_jpeg(bytes);
  throw std::runtime_error("it is neither a PNG nor a JPEG picture");
}

CameraImage grey_of(const RawPicture& raw) {
  check_limits(raw.width_px, raw.height_px);
  const Encoding& encoding = encoding_of(raw);
  const std::size_t row = raw.width_px * static_cast<std::size_t>(CV_ELEM_SIZE(encoding.type));
  if (raw.step < row || raw.data.size() / raw.step < raw.height_px)
    throw std::runtime_error(fmt::format("its {} bytes in rows of {} are too few for {} x {} pixels in {}",
                                         raw.data.size(), raw.step, raw.width_px, raw.height_px, raw.encoding));
  Grey grey(std::size_t{raw.width_px} * raw.height_px);
  if (encoding.type == CV_16UC1) {  // the upper bytes
    for (std::size_t i = 0; i < grey.size(); ++i)
      grey[i] = raw.data[i / raw.width_px * raw.step + 2 * (i % raw.width_px) + (raw.is_bigendian ? 0 : 1)];
    return image_of(raw.width_px, raw.height_px, std::move(grey));
  }
  const cv::Size size(static_cast<int>(raw.width_px), static_cast<int>(raw.height_px));
  // Only read from.
  const cv::Mat picture(size, encoding.type, const_cast<std::uint8_t*>(raw.data.data()), raw.step);
  cv::Mat1b to(size.height, size.width, grey.data());
  try {
    if (encoding.to_grey == kGrey)
      picture.copyTo(to);
    else
      cv::cvtColor(picture, to, encoding.to_grey);
  } catch (const cv::Exception& error) {  // a size that a pattern cannot have
    throw std::runtime_error(
        fmt::format("{} x {} pixels in {}: {}", raw.width_px, raw.height_px, raw.encoding, error.err));
  }
  return image_of(raw.width_px, raw.height_px, std::move(grey));
}

const CameraModel& camera_of(int number, std::span<const CameraModel> cameras) {
  if (number < 0 || static_cast<std::size_t>(number) >= cameras.size())
    throw std::runtime_error(
        fmt::format("pictures of camera {}, and the robot's file has {} (from 0)", number, cameras.size()));
  return cameras[static_cast<std::size_t>(number)];
}

void check_size(int width_px, int height_px, const CameraModel& camera) {
  if (width_px != camera.width_px || height_px != camera.height_px)
    throw std::runtime_error(fmt::format("a picture of {} x {} pixels, and its camera in the robot's file has {} x {}",
                                         width_px, height_px, camera.width_px, camera.height_px));
}

}  // namespace cairn::pictures

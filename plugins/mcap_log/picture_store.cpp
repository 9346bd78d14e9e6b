#include "plugins/mcap_log/picture_store.hpp"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "plugins/common/pictures/grey_picture.hpp"

namespace cairn::mcap_log {
namespace {

using exchange::ros2::MessageError;

[[noreturn]] void refuse_file() {
  throw std::runtime_error(std::string("the temporary file for the log's pictures: ") + std::strerror(errno));
}

}  // namespace

PictureStore::PictureStore() : file_(std::tmpfile(), &std::fclose) {
  if (!file_) refuse_file();
}

StoredPicture PictureStore::write(std::span<const std::uint8_t> bytes, bool is_packed, const CameraImage& image) {
  if (::fseeko(file_.get(), end_, SEEK_SET) != 0 ||
      std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
    refuse_file();
  const StoredPicture stored{end_, bytes.size(), is_packed, image.width_px, image.height_px};
  end_ += static_cast<std::int64_t>(bytes.size());
  return stored;
}

StoredPicture PictureStore::add(const exchange::ros2::ImageMessage& message) {
  CameraImage image;
  try {
    image = pictures::grey_of(
        {message.width_px, message.height_px, message.encoding, message.step, message.is_bigendian, message.data});
  } catch (const std::runtime_error& error) {
    throw MessageError(error.what());
  }
  return write(*image.grey, false, image);
}

StoredPicture PictureStore::add(const exchange::ros2::CompressedImageMessage& message) {
  CameraImage image;
  try {
    image = pictures::unpacked(message.data);
  } catch (const std::runtime_error& error) {
    throw MessageError(error.what());
  }
  return write(message.data, true, image);
}

CameraImage PictureStore::read(const StoredPicture& picture) const {
  std::vector<std::uint8_t> bytes(picture.size);
  if (::fseeko(file_.get(), picture.begin, SEEK_SET) != 0 ||
      std::fread(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
    refuse_file();
  if (picture.is_packed) return pictures::unpacked(bytes);
  CameraImage image;
  image.width_px = picture.width_px;
  image.height_px = picture.height_px;
  image.grey = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
  return image;
}

void check_size(const StoredPicture& picture, const CameraModel& camera) {
  try {
    pictures::check_size(picture.width_px, picture.height_px, camera);
  } catch (const std::runtime_error& error) {
    throw MessageError(error.what());
  }
}

std::function<CameraImage()> reader_of(std::shared_ptr<const PictureStore> store, const StoredPicture& picture,
                                       int camera) {
  return [store = std::move(store), picture, camera] {
    CameraImage read = store->read(picture);
    read.camera = camera;
    return read;
  };
}

}  // namespace cairn::mcap_log

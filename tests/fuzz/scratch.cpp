#include "tests/fuzz/scratch.hpp"

#include <stdlib.h>

#include <fstream>

namespace cairn::fuzz {
namespace {

class Folder {
 public:
  Folder() {
    std::string name = "/dev/shm/cairn_fuzz_XXXXXX";
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder can be made in /dev/shm");
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

const std::filesystem::path& scratch() {
  static const Folder folder;
  return folder.path();
}

std::filesystem::path scratch_file(const std::string& name, std::string_view bytes) {
  std::filesystem::path file = scratch() / name;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) throw std::runtime_error(file.string() + " cannot be written");
  return file;
}

}  // namespace cairn::fuzz

#include "framework/program/common/output_files.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace cairn {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": the output folder cannot be made: " + error.message());
}

void hold_folder(const std::filesystem::path& folder) {
  // Never closed: the lock goes with the process. Where a folder cannot be locked, runs are not distinguished.
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened >= 0 && ::flock(opened, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw std::runtime_error(folder.string() + ": another run is writing into this folder; name another with --out");
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (out) return;
  const std::string why = errno != 0 ? ": " + std::generic_category().message(errno) : std::string();
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) std::filesystem::remove(file, error);  // half of it is of no use
  throw std::runtime_error(file.string() + ": cannot be written" + why);
}

}  // namespace cairn

#include "framework/program/common/output_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include "maps/base/printable.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

constexpr std::chrono::milliseconds kAskAgainAfter(50);
constexpr std::size_t kMaxHolderBytes = 1024;

[[noreturn]] void fail_lock(const std::filesystem::path& lock, const std::string& what) {
  throw std::runtime_error(lock.string() + ": the lock of the output folder " + what);
}

// A plain file, or an error: a link there may lead anywhere, and opening a pipe would wait. None where nothing can be
// written: whoever runs there goes without a lock.
std::optional<int> open_lock(const std::filesystem::path& lock) {
  const int opened = ::open(lock.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, S_IRUSR | S_IWUSR);
  struct stat found {};
  if (opened < 0) {
    const int error = errno;
    if (error == ELOOP) fail_lock(lock, "is a symbolic link, which is not followed; remove it");
    if (::lstat(lock.c_str(), &found) == 0) fail_lock(lock, std::string("cannot be opened: ") + std::strerror(error));
    return std::nullopt;
  }
  if (::fstat(opened, &found) == 0 && S_ISREG(found.st_mode) && found.st_nlink == 1) return opened;
  ::close(opened);
  fail_lock(lock, "is not a plain file; remove it");
}

// Empty when the holder has not said. Its first line is the process, its second the command.
std::string holder_of(int lock) {
  std::array<char, kMaxHolderBytes> bytes{};
  const ssize_t size = ::pread(lock, bytes.data(), bytes.size(), 0);
  const std::string_view text(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  const std::size_t line_end = std::min(text.find('\n'), text.size());
  const auto pid = number_from<int>(trimmed(text.substr(0, line_end), " "));
  if (!pid || *pid <= 0) return "";
  const std::string_view command = trimmed(text.substr(line_end), " \n");
  return fmt::format(" (process {}{}{})", *pid, command.empty() ? "" : ": ", printable_excerpt(command));
}

// Of this process, as it was typed but for quotes; empty where the system does not say.
std::string own_command() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string command{std::istreambuf_iterator<char>(file), {}};
  std::ranges::replace(command, '\0', ' ');
  std::ranges::replace(command, '\n', ' ');
  return command;
}

void name_holder(int lock) {
  const std::string holder = fmt::format("{}\n{}\n", ::getpid(), own_command());
  // Only for the error of others: a full disk keeps no mission from running.
  if (::ftruncate(lock, 0) == 0) (void)!::pwrite(lock, holder.data(), holder.size(), 0);
}

}  // namespace

std::filesystem::path file_to_write(const std::filesystem::path& named, const std::string& usual) {
  if (!named.empty()) return named;
  std::error_code error;
  if (std::filesystem::exists(std::filesystem::symlink_status(usual, error)))
    throw std::runtime_error(usual +
                             " exists already; name a file by -o FILE, which is written in place of an older one");
  return usual;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": the output folder cannot be made: " + error.message());
}

void hold_folder(const std::filesystem::path& folder, std::chrono::milliseconds within) {
  const auto until = std::chrono::steady_clock::now() + within;
  const std::optional<int> opened = open_lock(folder / kFolderLock);
  if (!opened) return;
  const int lock = *opened;
  // Never closed: the lock goes with the process. Where files cannot be locked, runs are not distinguished.
  while (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno != EWOULDBLOCK) return;
    if (std::chrono::steady_clock::now() >= until) {
      const std::string holder = holder_of(lock);
      ::close(lock);
      throw std::runtime_error(folder.string() + ": another run" + holder +
                               " is writing into this folder; name another with --out");
    }
    std::this_thread::sleep_for(kAskAgainAfter);
  }
  name_holder(lock);
}

bool is_folder_held(const std::filesystem::path& folder) {
  const int lock = ::open((folder / kFolderLock).c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (lock < 0) return false;
  const bool is_held = ::flock(lock, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(lock);
  return is_held;
}

}  // namespace cairn

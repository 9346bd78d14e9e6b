#include "maps/base/output_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

namespace cairn {
namespace {

constexpr std::chrono::seconds kTurnWithin(30);  // another writer of the same file
constexpr std::chrono::milliseconds kAskAgainAfter(5);
constexpr int kMaxAttempts = 1000;
constexpr std::size_t kWriteAtOnce = std::size_t{1} << 14U;
constexpr mode_t kNewFile = 0666;  // less what the user's mask takes away

[[noreturn]] void fail_output(const char* what, int error) {
  throw OutputError(what + std::string(": ") + std::strerror(error));
}

class OutputDescriptor {
 public:
  explicit OutputDescriptor(int fd) : fd_(fd) {}
  OutputDescriptor(OutputDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  OutputDescriptor& operator=(OutputDescriptor&& other) = delete;
  ~OutputDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] int release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

void write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_output("cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

// Devices and some file systems cannot, and say so.
void sync_file(int fd) {
  if (::fsync(fd) != 0 && errno != EINVAL && errno != ENOTSUP) fail_output("cannot be written", errno);
}

void close_file(int fd) {
  if (::close(fd) != 0 && errno != EINTR) fail_output("cannot be written", errno);
}

// Nobody else's, under no other name, and nothing that waits for a reader.
bool is_our_plain_file(int fd) {
  struct stat found {};
  return ::fstat(fd, &found) == 0 && S_ISREG(found.st_mode) && found.st_uid == ::geteuid() && found.st_nlink == 1;
}

bool is_still_named(int fd, const std::filesystem::path& name) {
  struct stat held {};
  struct stat found {};
  return ::fstat(fd, &held) == 0 && ::lstat(name.c_str(), &found) == 0 && held.st_ino == found.st_ino &&
         held.st_dev == found.st_dev;
}

// A new file, or the one that another writer of ours is at or has left behind. -1: there was something else, which has
// been taken away, or the name has just become free.
int open_new_or_ours(const std::filesystem::path& name) {
  const int made = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kNewFile);
  if (made >= 0) return made;
  if (errno != EEXIST) fail_output("cannot be written", errno);
  OutputDescriptor found(::open(name.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (found.get() < 0 && errno == ENOENT) return -1;
  if (found.get() >= 0 && is_our_plain_file(found.get())) return found.release();
  // What has been renamed meanwhile is no longer here, and what is here now is the next writer's.
  if (found.get() >= 0 && !is_still_named(found.get(), name)) return -1;
  if (::unlink(name.c_str()) != 0 && errno != ENOENT) fail_output("cannot be written", errno);
  return -1;
}

void take_turn(int fd, std::chrono::steady_clock::time_point until) {
  while (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno != EWOULDBLOCK) fail_output("cannot be locked against other writers", errno);
    if (std::chrono::steady_clock::now() >= until)
      throw OutputError("cannot be written: another program is writing it");
    std::this_thread::sleep_for(kAskAgainAfter);
  }
}

// A writer that had to wait holds a file that has been renamed meanwhile, and tries again.
OutputDescriptor open_beside(const std::filesystem::path& name) {
  const auto until = std::chrono::steady_clock::now() + kTurnWithin;
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    OutputDescriptor opened(open_new_or_ours(name));
    if (opened.get() < 0) continue;
    take_turn(opened.get(), until);
    if (!is_still_named(opened.get(), name)) continue;
    if (::ftruncate(opened.get(), 0) != 0) fail_output("cannot be written", errno);
    return opened;
  }
  throw OutputError("cannot be written: other programs keep taking its place");
}

// A new file is nobody else's than the one that it replaces.
void take_over_mode(int fd, const std::filesystem::path& replaced) {
  struct stat found {};
  if (::lstat(replaced.c_str(), &found) == 0 && S_ISREG(found.st_mode) && ::fchmod(fd, found.st_mode & 0777) != 0)
    fail_output("cannot be written", errno);
}

// The rename itself must reach the disk too; file systems that cannot sync a folder need no asking.
void sync_folder_of(const std::filesystem::path& target) {
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  const OutputDescriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.get() >= 0) ::fsync(opened.get());
}

// A file beside the target, locked; removed unless it is put in the target's place.
class FileBeside {
 public:
  explicit FileBeside(std::filesystem::path target)
      : target_(std::move(target)),
        beside_(target_.parent_path() / ("." + target_.filename().string() + ".saving")),
        opened_(open_beside(beside_)) {}
  FileBeside(const FileBeside&) = delete;
  FileBeside& operator=(const FileBeside&) = delete;
  ~FileBeside() {
    if (!is_in_place_) ::unlink(beside_.c_str());
  }

  [[nodiscard]] int get() const { return opened_.get(); }
  void put_in_place() {
    take_over_mode(opened_.get(), target_);
    if (::rename(beside_.c_str(), target_.c_str()) != 0) fail_output("cannot be written", errno);
    is_in_place_ = true;
  }
  [[nodiscard]] int release() { return opened_.release(); }

 private:
  std::filesystem::path target_;
  std::filesystem::path beside_;
  OutputDescriptor opened_;
  bool is_in_place_ = false;
};

bool is_handed_over(const std::filesystem::path& file) {
  const std::string name = file.string();
  return name == "/dev/stdout" || name == "/dev/stderr" || name.starts_with("/dev/fd/") ||
         name.starts_with("/proc/self/fd/");
}

bool is_written_into(const std::filesystem::path& file) {
  struct stat found {};
  if (is_handed_over(file)) return true;
  if (::lstat(file.c_str(), &found) != 0) return false;
  return S_ISCHR(found.st_mode) || S_ISFIFO(found.st_mode) || S_ISSOCK(found.st_mode);
}

// A pipe without a reader is an error, not a wait without end.
void write_into(const std::filesystem::path& file, std::string_view bytes) {
  const int no_link = is_handed_over(file) ? 0 : O_NOFOLLOW;
  OutputDescriptor opened(::open(file.c_str(), O_WRONLY | O_TRUNC | O_NONBLOCK | O_CLOEXEC | no_link));
  if (opened.get() < 0) fail_output("cannot be written", errno);
  ::fcntl(opened.get(), F_SETFL, ::fcntl(opened.get(), F_GETFL) & ~O_NONBLOCK);
  write_all(opened.get(), bytes);
  close_file(opened.release());
}

// Links that lead round in a circle fail like those to nowhere.
std::filesystem::path target_of(const std::filesystem::path& file, Links links) {
  std::error_code error;
  if (links == Links::replace || !std::filesystem::is_symlink(file, error)) return file;
  std::filesystem::path target = std::filesystem::canonical(file, error);
  if (error) fail_output("cannot be written", error.value());
  return target;
}

}  // namespace

void replace_file(const std::filesystem::path& file, std::string_view bytes, const WritingRules& rules) {
  if (is_written_into(file)) return write_into(file, bytes);
  const std::filesystem::path target = target_of(file, rules.links);
  FileBeside beside(target);
  write_all(beside.get(), bytes);
  if (rules.sync) sync_file(beside.get());
  beside.put_in_place();
  close_file(beside.release());
  if (rules.sync) sync_folder_of(target);
}

void write_file(const std::filesystem::path& file, std::string_view bytes) {
  try {
    replace_file(file, bytes);
  } catch (const OutputError& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

bool exchange_files(const std::filesystem::path& file, const std::filesystem::path& other) {
  struct stat found {};
  struct stat found_other {};
  const bool has_modes = ::stat(file.c_str(), &found) == 0 && ::stat(other.c_str(), &found_other) == 0;
  if (has_modes && found.st_mode != found_other.st_mode) ::chmod(other.c_str(), found.st_mode & 0777);
  if (::renameat2(AT_FDCWD, file.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) != 0) return false;
  sync_folder_of(file);
  return true;
}

void append_to_file(const std::filesystem::path& file, std::string_view bytes) {
  OutputDescriptor opened(
      ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, kNewFile));
  if (opened.get() < 0) fail_output("cannot be written", errno);
  if (!is_our_plain_file(opened.get())) throw OutputError("cannot be written: is not a plain file of this user's own");
  write_all(opened.get(), bytes);
  close_file(opened.release());
}

GrowingFile::GrowingFile(const std::filesystem::path& file) {
  FileBeside beside(file);
  beside.put_in_place();
  fd_ = beside.release();
}

GrowingFile::~GrowingFile() {
  try {
    close();
  } catch (const OutputError&) {
    if (fd_ >= 0) ::close(fd_);  // who wants to know calls close()
  }
}

void GrowingFile::append(std::string_view bytes) {
  waiting_ += bytes;
  if (waiting_.size() >= kWriteAtOnce) flush();
}

void GrowingFile::flush() {
  if (fd_ < 0) throw OutputError("cannot be written: it is closed");
  write_all(fd_, std::exchange(waiting_, {}));
}

void GrowingFile::close() {
  if (fd_ < 0) return;
  flush();
  sync_file(fd_);
  close_file(std::exchange(fd_, -1));
}

}  // namespace cairn

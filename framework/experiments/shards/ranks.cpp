#include "framework/experiments/shards/ranks.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include "maps/base/text.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxRanks = 100'000;

std::string text_of_variable(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? "" : text;
}

bool lock_whole(int file) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return ::fcntl(file, F_OFD_SETLK, &whole) == 0;
}

// Whether a process holds it.
bool is_locked(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return true;  // not begun yet
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  const bool is_held = ::fcntl(file, F_OFD_GETLK, &whole) == 0 && whole.l_type != F_UNLCK;
  ::close(file);
  return is_held;
}

}  // namespace

std::optional<Rank> rank_of_launcher() {
  const auto number = number_from<std::size_t>(text_of_variable("OMPI_COMM_WORLD_RANK"));
  const auto of = number_from<std::size_t>(text_of_variable("OMPI_COMM_WORLD_SIZE"));
  if (!number || !of || *of < 2 || *of > kMaxRanks || *number >= *of) return std::nullopt;
  std::string job = text_of_variable("PMIX_NAMESPACE");
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
  std::ranges::replace_if(
      job, [&](char c) { return !is_plain(static_cast<unsigned char>(c)); }, '_');
  return Rank{*number, *of, job.empty() ? "job" : job};
}

RankedRuns::RankedRuns(const std::filesystem::path& out, const Rank& rank)
    : rank_(rank), folder_(out / (".ranks_" + rank.job)) {
  std::filesystem::create_directories(folder_ / "taken");
  lock_ = ::open(alive(rank.number).c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (lock_ < 0 || !lock_whole(lock_)) {
    const int error = errno;
    if (lock_ >= 0) ::close(lock_);
    throw std::runtime_error(alive(rank.number).string() +
                             ": cannot be locked: " + std::generic_category().message(error));
  }
}

RankedRuns::~RankedRuns() {
  if (lock_ >= 0) ::close(lock_);
}

std::filesystem::path RankedRuns::alive(std::size_t rank) const {
  return folder_ / ("rank_" + std::to_string(rank));
}

bool RankedRuns::take(std::size_t run) const {
  const std::filesystem::path path = folder_ / "taken" / std::to_string(run);
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file < 0 && errno != EEXIST)
    throw std::runtime_error(path.string() + ": cannot be made: " + std::generic_category().message(errno));
  if (file >= 0) ::close(file);
  return file >= 0;
}

// Its own lock goes first: of two that end at a time one sees the other as ended.
bool RankedRuns::end() {
  ::close(lock_);
  lock_ = -1;
  for (std::size_t rank = 0; rank < rank_.of; ++rank)
    if (rank != rank_.number && is_locked(alive(rank))) return false;
  return true;
}

void RankedRuns::clear() const {
  std::error_code error;
  std::filesystem::remove_all(folder_, error);
}

}  // namespace cairn

// The processes that Open MPI's mpirun has started for one experiment, in one output folder that all of them see. Each
// takes the next run that no other has taken; the last to end finds all rows there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace cairn {

struct Rank {
  std::size_t number = 0;  // from 0
  std::size_t of = 1;
  std::string job;  // of this start of mpirun: a word that may be part of a file's name
};
// By the environment; none: it was not started so, or alone.
[[nodiscard]] std::optional<Rank> rank_of_launcher();

// One process's part in it. Its files lie in a hidden folder of the output folder; a file that is locked (fcntl) means
// that the process lives, so one that is killed is known to have ended. Throws std::runtime_error.
class RankedRuns {
 public:
  RankedRuns(const std::filesystem::path& out, const Rank& rank);
  RankedRuns(const RankedRuns&) = delete;
  RankedRuns& operator=(const RankedRuns&) = delete;
  ~RankedRuns();

  // Whether the run is this process's: nobody has taken it before. From any thread.
  [[nodiscard]] bool take(std::size_t run) const;
  // Once, at the end: whether all others have begun and ended, as well or badly as it may be. True for one at least.
  [[nodiscard]] bool end();
  // The last one removes the files.
  void clear() const;

 private:
  [[nodiscard]] std::filesystem::path alive(std::size_t rank) const;

  Rank rank_;
  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace cairn

#include "framework/mission/autosave.hpp"

#include <algorithm>
#include <vector>

#include "maps/hierarchy/hierarchy.hpp"

namespace cairn {

void AutosaveConfig::describe(Fields<AutosaveConfig>& fields) {
  using C = AutosaveConfig;
  fields.number("every_s", &C::every_s, {0.0, 1e6}, "s",
                "wall clock between two autosaves while the mission runs; 0: none");
  fields.text("file", &C::file,
              "name of the autosaved map in the output folder, MISSION.autosave.cairn without it; it is taken away "
              "once the mission has saved its map");
}

Autosaver::Autosaver(std::filesystem::path file, double every_s, std::shared_ptr<const WallClock> wall_clock,
                     const ClusterSizes& sizes)
    : every_(every_s), wall_clock_(std::move(wall_clock)), sizes_(sizes), updater_(std::move(file)) {}

Autosaver::~Autosaver() {
  finish();
}

double Autosaver::seconds_since(WallClock::Time begin) const {
  return std::chrono::duration<double>(wall_clock_->now() - begin).count();
}

bool Autosaver::is_due() {
  if (every_.count() <= 0.0) return false;
  const WallClock::Time now = wall_clock_->now();
  if (asked_) longest_tick_ = std::max<std::chrono::duration<double>>(longest_tick_, now - *asked_);
  asked_ = now;
  const std::scoped_lock lock(mutex_);
  if (writing_ || copy_) return false;
  // Twice, since the next copy may be larger and the disk slower.
  const auto ahead = std::min(every_ / 2, longest_tick_ + 2 * longest_write_);
  return !last_ || now - *last_ >= every_ - ahead;
}

void Autosaver::save(SavedMap copy, WallClock::Time taken) {
  last_ = taken;
  const std::scoped_lock lock(mutex_);
  copy_ = std::move(copy);
  taken_ = taken;
  try {
    if (!thread_.joinable()) thread_ = std::thread([this] { write_copies(); });
    changed_.notify_all();
  } catch (const std::system_error& error) {
    copy_.reset();
    note({.reason = std::string("no thread can be started: ") + error.what()});
  }
  figures_.in_loop_s += seconds_since(taken);
}

void Autosaver::finish() {
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  if (!thread_.joinable()) return;
  thread_.join();
  updater_.drop_earlier();
}

void Autosaver::write_copies() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return copy_ || ending_; });
    if (!copy_) return;
    SavedMap copy = std::move(*copy_);
    copy_.reset();
    writing_ = true;
    lock.unlock();
    write(copy);
    lock.lock();
    writing_ = false;
  }
}

void Autosaver::write(SavedMap& copy) {
  const WallClock::Time begin = wall_clock_->now();
  Outcome outcome;
  outcome.time_s = copy.progress ? copy.progress->time_s : 0.0;
  try {
    copy.clusters = cluster_landmarks(copy.graph, copy.clusters,
                                      {sizes_, passages_in(copy.grid, copy.graph, sizes_.narrow_below_m)});
    updater_.save(copy);
    outcome.saved = true;
  } catch (const std::exception& error) {
    outcome.reason = error.what();
  }
  const std::scoped_lock lock(mutex_);
  const double took_s = seconds_since(taken_);
  outcome.took_ms = 1e3 * took_s;
  longest_write_ = std::max(longest_write_, std::chrono::duration<double>(took_s));
  figures_.writing_s += seconds_since(begin);
  figures_.written_bytes = updater_.bytes_written();
  note(std::move(outcome));
}

// With the mutex held.
void Autosaver::note(Outcome outcome) {
  ++(outcome.saved ? figures_.saved : figures_.failed);
  if (outcome.saved) figures_.last_time_s = outcome.time_s;
  if (figures_.failure.empty()) figures_.failure = outcome.reason;
  outcome_ = std::move(outcome);
}

std::optional<Autosaver::Outcome> Autosaver::last_outcome() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(outcome_, std::nullopt);
}

AutosaveFigures Autosaver::figures() const {
  const std::scoped_lock lock(mutex_);
  return figures_;
}

namespace {

// No link: what it leads to is no map that an earlier run here has left.
bool is_plain_file(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error));
}

std::filesystem::path numbered(std::filesystem::path file, int number) {
  const std::string extension = file.extension().string();
  return file.replace_extension("." + std::to_string(number) + extension);
}

// As far as its mission had come; less than any when it cannot be read.
double time_in(const std::filesystem::path& map) {
  try {
    const auto progress = MapFile(map).without_cells().progress;
    return progress ? progress->time_s : 0.0;
  } catch (const StoreError&) {
    return -1.0;
  }
}

// "office.autosave.3.cairn" of "office.autosave.cairn".
bool is_kept_autosave(const std::filesystem::path& kept, const std::filesystem::path& file) {
  const std::string name = kept.stem().string();
  const std::string before = file.stem().string() + ".";
  return kept.extension() == file.extension() && name.starts_with(before) && name.size() > before.size() &&
         name.find_first_not_of("0123456789", before.size()) == std::string::npos;
}

std::vector<std::filesystem::path> kept_autosaves(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> kept;
  std::error_code error;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (is_kept_autosave(entry.path(), file) && std::filesystem::is_regular_file(entry.symlink_status()))
      kept.push_back(folder / entry.path().filename());
  std::ranges::sort(kept);
  return kept;
}

}  // namespace

std::optional<KeptAutosave> keep_earlier_autosave(const std::filesystem::path& file,
                                                  const std::filesystem::path& resumed) {
  std::error_code error;
  if (!is_plain_file(file)) return std::nullopt;
  const auto is_resumed = [&](const std::filesystem::path& map) {
    std::error_code missing;
    return std::filesystem::equivalent(map, resumed, missing);
  };
  std::vector<std::filesystem::path> all = kept_autosaves(file);
  std::erase_if(all, is_resumed);
  all.insert(all.begin(), file);  // of those that hold as much, the last one
  const std::filesystem::path furthest = *std::ranges::max_element(all, {}, time_in);
  std::filesystem::path name = numbered(file, 1);
  if (is_resumed(name)) name = numbered(file, 2);
  if (furthest != name) std::filesystem::rename(furthest, name, error);
  if (error) return std::nullopt;
  for (const std::filesystem::path& other : all)
    if (other != furthest && other != name) std::filesystem::remove(other, error);
  return KeptAutosave{name, static_cast<int>(all.size()) - 1};
}

std::optional<std::filesystem::path> keep_under_free_name(const std::filesystem::path& file) {
  std::error_code error;
  if (!is_plain_file(file)) return std::nullopt;
  for (int number = 1;; ++number) {
    const std::filesystem::path kept = numbered(file, number);
    if (std::filesystem::exists(kept, error)) continue;
    std::filesystem::rename(file, kept, error);
    return error ? std::nullopt : std::optional(kept);
  }
}

}  // namespace cairn

#include "framework/modules/trial/cached_trial.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "framework/contracts/abi_stamp.hpp"
#include "framework/modules/cache_folder.hpp"
#include "framework/modules/trial/child_trial.hpp"
#include "maps/base/child_process.hpp"
#include "maps/base/fingerprint.hpp"

namespace cairn {
namespace {

constexpr std::string_view kMagic = "cairn module trial 1\n";

constexpr std::uintmax_t kMaxEntryBytes = std::uintmax_t{1} << 20U;

// Empty when it is not a plain file, too large, or cannot be read.
std::string bytes_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return "";
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > kMaxEntryBytes) return "";
  std::string bytes(size, '\0');
  std::ifstream in(file, std::ios::binary);
  return in.read(bytes.data(), static_cast<std::streamsize>(size)) ? bytes : "";
}

// Which build of the program would open the file: another one may fare otherwise.
std::string this_build() {
  Dl_info info{};
  struct stat status {};
  const auto here = &module_cache_folder;
  std::string text = text_of(this_abi_stamp());
  if (::dladdr(reinterpret_cast<const void*>(here), &info) != 0 && ::stat(info.dli_fname, &status) == 0)
    text += " " + std::to_string(status.st_size) + " " + std::to_string(status.st_mtim.tv_sec) + "." +
            std::to_string(status.st_mtim.tv_nsec);
  return text;
}

// One file a key, named after the key's hash and holding the whole key: two keys are never mixed up.
struct CacheEntry {
  std::string key;
  std::filesystem::path file;
};

CacheEntry entry_of(const FileHash& module, const std::filesystem::path& folder) {
  const std::string key = fmt::format("{} {} {:016x}\n", this_build(), module.size, module.hash);
  return {key, folder / (fingerprint_of(key) + ".module")};
}

std::string entry_text(const CacheEntry& entry, const TrialOutcome& outcome) {
  const std::string text = std::string(kMagic) + entry.key + text_of(outcome);
  return text + fingerprint_of(text);
}

std::optional<TrialOutcome> read_entry(const CacheEntry& entry) {
  const std::string all = bytes_of(entry.file);
  const std::string begin = std::string(kMagic) + entry.key;
  const std::size_t sum = fingerprint_of("").size();
  if (!all.starts_with(begin) || all.size() < begin.size() + sum) return std::nullopt;
  const std::string_view text = std::string_view(all).substr(0, all.size() - sum);
  return all.ends_with(fingerprint_of(text)) ? outcome_from(text.substr(begin.size())) : std::nullopt;
}

}  // namespace

TrialOutcome CachedTrial::outcome_of(const std::filesystem::path& file) const {
  const std::optional<FileHash> content = folder_.empty() ? std::nullopt : hash_of_file(file);
  if (!content) return trial_->outcome_of(file);
  std::optional<TrialOutcome> known = read_entry(entry_of(*content, folder_));
  if (!known) return try_again(file);
  known->is_remembered = true;
  if (!known->fault.empty()) known->fault += " (in an earlier trial; `cairn plugins check` tries again)";
  return *known;
}

TrialOutcome CachedTrial::try_again(const std::filesystem::path& file) const {
  const std::optional<FileHash> content = folder_.empty() ? std::nullopt : hash_of_file(file);
  TrialOutcome outcome = trial_->try_again(file);
  if (!content) return outcome;
  const CacheEntry entry = entry_of(*content, folder_);
  std::error_code error;
  if (outcome.fault.empty() || outcome.is_fatal)
    keep_in_cache(entry.file, entry_text(entry, outcome));
  else
    std::filesystem::remove(entry.file, error);
  return outcome;
}

std::filesystem::path module_cache_folder() {
  return cache_folder("CAIRN_MODULE_CACHE", "modules");
}

std::shared_ptr<const ModuleTrial> remembered_child_trial(const std::filesystem::path& program) {
  return std::make_shared<CachedTrial>(
      std::make_unique<ChildTrial>(program, limit_from("CAIRN_MODULE_TRIAL_S", kModuleTrialLimit)),
      module_cache_folder());
}

}  // namespace cairn

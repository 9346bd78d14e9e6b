// `cairn plugins check`: every module file is tried anew, in a process of its own.

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/in_parallel.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

struct CheckedFile {
  std::filesystem::path file;
  std::vector<ModuleSummary> modules{};
  std::vector<std::string> faults{};  // without the file's name
  bool is_loadable = false;           // only names and descriptions may be wrong
};

bool is_plain_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  return std::filesystem::equivalent(a, b, error);
}

// What is wrong with the names of a module that loads, and with those that other modules have already.
void check_names(CheckedFile& checked, const std::vector<KnownModule>& others) {
  std::vector<std::string>& faults = checked.faults;
  if (checked.modules.empty()) faults.emplace_back("it registers nothing");
  for (auto at = checked.modules.begin(); at != checked.modules.end(); ++at) {
    const ModuleSummary& module = *at;
    const auto clashes = [&](const ModuleSummary& other) {
      return other.name == module.name && share_names(other.kind, module.kind);
    };
    const std::string name = printable_excerpt(module.name);
    if (!is_plain_name(module.name))
      faults.push_back("the name \"" + name + "\" is not of lower-case letters, digits and _");
    if (module.summary.empty()) faults.push_back(name + " has no one-line description");
    if (std::any_of(checked.modules.begin(), at, clashes))
      faults.push_back("it registers the name \"" + name + "\" twice");
    for (const KnownModule& other : others)
      if (clashes(other) && !is_same_file(other.file, checked.file))
        faults.push_back("the name \"" + name + "\" is taken by " + other.file.string());
  }
}

std::vector<CheckedFile> checked_files(const std::vector<std::filesystem::path>& files, const CommonOptions& common) {
  std::vector<CheckedFile> all;
  all.reserve(files.size());
  for (const std::filesystem::path& file : files) all.push_back({file});
  const std::shared_ptr<const ModuleTrial> trial = module_trial();
  in_parallel(all.size(), [&](std::size_t i) {
    const TrialOutcome outcome = trial->try_again(all[i].file);
    all[i].modules = outcome.modules;
    all[i].is_loadable = outcome.fault.empty();
    if (!outcome.fault.empty()) all[i].faults.push_back(outcome.fault);
  });
  const bool is_one_loadable = std::ranges::any_of(all, &CheckedFile::is_loadable);
  const std::vector<KnownModule> others = is_one_loadable ? module_library(common).known() : std::vector<KnownModule>();
  for (CheckedFile& checked : all)
    if (checked.is_loadable) check_names(checked, others);
  return all;
}

// All that there are, and what is wrong with the folders.
std::vector<std::filesystem::path> all_files(const CommonOptions& common, std::vector<std::string>& folder_faults) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& folder : plugin_folders(common.plugin_folders)) {
    try {
      const std::vector<std::filesystem::path> found = module_files(folder);
      files.insert(files.end(), found.begin(), found.end());
    } catch (const std::filesystem::filesystem_error& error) {
      folder_faults.push_back(folder.string() + ": the plugin folder cannot be read: " + error.code().message());
    }
  }
  return files;
}

ordered_json json_of(const CheckedFile& checked) {
  ordered_json modules = ordered_json::array();
  for (const ModuleSummary& module : checked.modules)
    modules.push_back(
        {{"kind", std::string(name_of(module.kind))}, {"name", module.name}, {"summary", module.summary}});
  std::vector<std::string> faults;
  for (const std::string& fault : checked.faults)
    faults.push_back((checked.is_loadable ? "" : checked.file.string() + ": ") + fault);
  return {{"file", checked.file.string()},
          {"stamp", checked.is_loadable ? text_of(this_abi_stamp()) : ""},
          {"modules", modules},
          {"faults", faults}};
}

std::string line_text(const CheckedFile& checked) {
  std::vector<std::string> words;
  for (const ModuleSummary& module : checked.modules)
    words.push_back(std::string(name_of(module.kind)) + " " + printable_excerpt(module.name));
  std::string fault = joined(checked.faults, "; ");
  for (std::size_t at = 0; (at = fault.find("\n  ", at)) != std::string::npos;) fault.replace(at, 3, " ");
  return checked.file.string() + ": " + (fault.empty() ? "ok: " + joined(words) : fault) + "\n";
}

}  // namespace

int plugins_check(const PluginsCheckCommand& command, const CommonOptions& common) {
  std::vector<std::string> folder_faults;
  const std::vector<std::filesystem::path> files =
      command.files.empty() ? all_files(common, folder_faults) : command.files;
  const std::vector<CheckedFile> checked = checked_files(files, common);
  const bool is_one = command.files.size() == 1;
  std::ostream& people = common.json ? std::cerr : std::cout;
  ordered_json rows = ordered_json::array();
  bool all_good = folder_faults.empty();
  for (const CheckedFile& file : checked) {
    all_good = all_good && file.faults.empty();
    people << line_text(file);
    rows.push_back(json_of(file));
  }
  for (const std::string& fault : folder_faults) std::cerr << fault << "\n";
  if (common.json) print_json(is_one ? rows.front() : ordered_json{{"files", rows}, {"faults", folder_faults}});
  return all_good ? kExitDone : kExitNotSolved;
}

}  // namespace cairn

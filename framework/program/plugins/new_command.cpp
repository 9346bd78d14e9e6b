// `cairn plugins new`: a small complete project for a module, from the scaffold of its kind.

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/output_files.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;

struct Replacement {
  std::string mark;
  std::string text;
};

struct NewFile {
  fs::path file;  // within the project
  std::string text;
};

// CMake has targets of its own; a module's target bears the module's name.
const std::vector<std::string> kTakenTargets = {"all",     "clean",         "edit_cache", "help",   "install",
                                                "package", "rebuild_cache", "test",       "depend", "cairn"};

// The folder of the installed tree, or of the build tree of the same shape, that the program stands in.
fs::path prefix() {
  return fs::read_symlink("/proc/self/exe").parent_path().parent_path();
}

bool is_letter(char c) {
  return c >= 'a' && c <= 'z';
}

bool is_lower_snake_case(const std::string& name) {
  if (name.empty() || !is_letter(name.front()) || name.back() == '_') return false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool digit = name[i] >= '0' && name[i] <= '9';
    if (!is_letter(name[i]) && !digit && !(name[i] == '_' && name[i - 1] != '_')) return false;
  }
  return true;
}

// my_detector -> MyDetector
std::string pascal_case(const std::string& name) {
  std::string text;
  bool first = true;
  for (const char c : name) {
    if (c != '_') text += first && is_letter(c) ? static_cast<char>(c - 'a' + 'A') : c;
    first = c == '_';
  }
  return text;
}

void check_kind(const std::string& kind) {
  std::vector<std::string> kinds;
  for (const PluginKind known : kPluginKinds) kinds.emplace_back(name_of(known));
  if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) return;
  throw std::runtime_error("there is no kind of module " + in_quotes(kind) + did_you_mean(kind, kinds) +
                           "; known are: " + joined(kinds));
}

void check_name(const std::string& name, const CommonOptions& common) {
  if (!is_lower_snake_case(name))
    throw std::runtime_error(in_quotes(name) +
                             " is not a name for a module: it must be lower_snake_case, such as my_module");
  if (std::find(kTakenTargets.begin(), kTakenTargets.end(), name) != kTakenTargets.end())
    throw std::runtime_error(in_quotes(name) + " is not a name for a module: the build has a target of that name");
  for (const KnownModule& taken : module_library(common).known())
    if (taken.name == name)
      throw std::runtime_error("there is a module " + in_quotes(name) + " already, in " + taken.file.string());
}

std::string replaced(std::string text, const std::vector<Replacement>& replacements) {
  for (const Replacement& replacement : replacements)
    for (std::size_t at = 0; (at = text.find(replacement.mark, at)) != std::string::npos; at += replacement.text.size())
      text.replace(at, replacement.mark.size(), replacement.text);
  return text;
}

// The files of one scaffold folder, `NAME_test.cpp.in` as `my_module_test.cpp`.
void add_files_of(const fs::path& folder, const std::string& name, const std::vector<Replacement>& replacements,
                  std::vector<NewFile>& files) {
  if (!fs::is_directory(folder))
    throw std::runtime_error(folder.string() + ": no such folder; it belongs to the program, so install Cairn again");
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".in") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in || text.empty()) throw std::runtime_error(entry.path().string() + ": cannot be read");
    files.push_back({replaced(entry.path().stem().string(), {{"NAME", name}}), replaced(text, replacements)});
  }
}

}  // namespace

int plugins_new(const NewPluginCommand& command, const CommonOptions& common) {
  check_kind(command.kind);
  check_name(command.name, common);
  const fs::path folder = command.folder.empty() ? fs::path(command.name) : command.folder;
  if (fs::exists(fs::symlink_status(folder)))
    throw std::runtime_error(folder.string() + ": is there already; name another folder with --folder");

  const fs::path shared = prefix() / "share" / "cairn";
  const std::vector<Replacement> replacements = {
      {"@NAME@", command.name},
      {"@CLASS@", pascal_case(command.name)},
      {"@KIND@", command.kind},
      {"@CONFIG@", fs::weakly_canonical(shared / "config").string()},
      {"@MODULES@", fs::weakly_canonical(prefix() / "lib" / "cairn").string()}};
  std::vector<NewFile> files;
  add_files_of(shared / "scaffold" / "common", command.name, replacements, files);
  add_files_of(shared / "scaffold" / command.kind, command.name, replacements, files);
  std::sort(files.begin(), files.end(), [](const NewFile& a, const NewFile& b) { return a.file < b.file; });

  fs::create_directories(folder);
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  for (const NewFile& file : files) {
    write_file(folder / file.file, file.text);
    names.push_back(file.file.string());
    if (!common.json) std::cout << (folder / file.file).string() << "\n";
  }
  print({{"kind", command.kind}, {"name", command.name}, {"folder", folder.string()}, {"files", names}},
        "Next: " + (folder / "README.md").string() + " says how to build, test and run it.\n", common);
  return kExitDone;
}

}  // namespace cairn

// Whether a module file can be used, found out before the program itself opens it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/contracts/plugin_kind.hpp"

namespace cairn {

// A module by what it registers.
struct ModuleSummary {
  PluginKind kind = PluginKind::sensor;
  std::string name;
  std::string summary;
};

struct TrialOutcome {
  std::string fault;  // empty: it can be used; else what went wrong, without the file's name
  std::vector<ModuleSummary> modules;
  bool is_fatal = false;       // it crashed, hung or ended the process that opened it
  bool is_remembered = false;  // of an earlier trial
};

// Must be callable from several threads at once.
class ModuleTrial {
 public:
  virtual ~ModuleTrial() = default;
  // May be of an earlier trial of the same file.
  [[nodiscard]] virtual TrialOutcome outcome_of(const std::filesystem::path& file) const = 0;
  // Always of a new one.
  [[nodiscard]] virtual TrialOutcome try_again(const std::filesystem::path& file) const { return outcome_of(file); }
};

// As lines of text, and back. None: the text is not whole. Whether it is remembered is not part of it.
[[nodiscard]] std::string text_of(const TrialOutcome& outcome);
[[nodiscard]] std::optional<TrialOutcome> outcome_from(std::string_view text);

}  // namespace cairn

// Tries a module file in a child process: whatever it does there, it does not do to the program.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "framework/modules/trial/module_trial.hpp"

namespace cairn {

inline constexpr std::chrono::milliseconds kModuleTrialLimit{5000};  // wall clock, from start to end of the child
inline constexpr const char* kModuleTrialArgument = "--try-module";  // the first of two; the other is the file

class ChildTrial : public ModuleTrial {
 public:
  // The program must call run_module_trial() when it is started with kModuleTrialArgument.
  explicit ChildTrial(std::filesystem::path program, std::chrono::milliseconds limit = kModuleTrialLimit)
      : program_(std::move(program)), limit_(limit) {}
  [[nodiscard]] TrialOutcome outcome_of(const std::filesystem::path& file) const override;

 private:
  std::filesystem::path program_;
  std::chrono::milliseconds limit_;
};

// The child's side: opens the file, lets it register and writes the outcome to kReportFd. Returns the exit status for
// main() to return, so that the module also sees a program end.
[[nodiscard]] int run_module_trial(const std::filesystem::path& file);

}  // namespace cairn

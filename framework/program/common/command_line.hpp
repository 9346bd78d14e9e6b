// What the commands' options share: checks of their values, and how a command becomes the one that is run.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>

#include "framework/program/common/commands.hpp"

namespace cairn {

// As read so far.
struct CommandLine {
  CommonOptions common;
  std::function<int()> action;  // of the command that was asked for
};

// A command whose options live as long as it does.
template <class Options>
struct AddedCommand {
  CLI::App* app;
  Options* options;
};

// Below the parent; run gets its options. The line must outlive the parsing.
template <class Options>
AddedCommand<Options> add_command(CLI::App& parent, CommandLine& line,
                                  int (*run)(const Options& options, const CommonOptions& common),
                                  const std::string& name, const std::string& about) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = parent.add_subcommand(name, about);
  command->callback([=, &line] { line.action = [=, &line] { return run(*options, line.common); }; });
  return {command, options.get()};
}

// An option that takes one value each time it stands there.
template <class List>
void add_repeatable(CLI::App* command, const std::string& name, List& list, const std::string& about) {
  command->add_option(name, list, about)->allow_extra_args(false);
}

// CLI::Range lets nan pass.
inline CLI::Validator number_within(double min, double max) {
  const std::string range = "a number from " + CLI::detail::to_string(min) + " to " + CLI::detail::to_string(max);
  return {[min, max, range](std::string& text) {
            double value = 0.0;
            const bool is_within = CLI::detail::lexical_cast(text, value) && value >= min && value <= max;
            return is_within ? std::string() : "must be " + range + ", found \"" + text + "\"";
          },
          "FLOAT in [" + CLI::detail::to_string(min) + " - " + CLI::detail::to_string(max) + "]", "number"};
}

// A double, whose default the help shows, or an optional one.
template <class Number>
void add_number(CLI::App* command, const std::string& name, Number& number, const std::string& about, double min,
                double max) {
  CLI::Option* option = command->add_option(name, number, about)->check(number_within(min, max));
  if constexpr (std::is_same_v<Number, double>) option->capture_default_str();
}

}  // namespace cairn

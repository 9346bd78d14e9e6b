// What the options of the program share: checks of their values, and the command that they lead to.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace cairn {

using Action = std::function<int()>;

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

}  // namespace cairn

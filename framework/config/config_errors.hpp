// Several mistakes that do not depend on each other, found in one go.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "framework/config/config_value.hpp"

namespace cairn {

// The error and its others, each alone.
[[nodiscard]] std::vector<ConfigError> each_of(const ConfigError& error);

// The same with each of them changed.
template <class Change>
[[nodiscard]] ConfigError each_changed(const ConfigError& error, const Change& change) {
  std::vector<ConfigError> others;
  for (const ConfigError& other : error.others()) others.push_back(change(other));
  const ConfigError first = change(ConfigError(error.place(), error.sentence()));
  return {first.place(), first.sentence(), std::move(others)};
}

// Gathers errors instead of ending at the first.
class ConfigErrors {
 public:
  // Who reads on after so many mistakes reads what is no such file.
  static constexpr std::size_t kMax = 100;

  // Keeps the ConfigError that the work throws, with its others.
  template <class Work>
  void attempt(const Work& work) {
    try {
      work();
    } catch (const ConfigError& error) {
      add(error);
    }
  }
  void add(const ConfigError& error);
  [[nodiscard]] bool is_full() const { return errors_.size() >= kMax; }
  [[nodiscard]] const std::vector<ConfigError>& all() const { return errors_; }
  // The first, with the others. Nothing when there are none.
  void throw_if_any() const;

 private:
  std::vector<ConfigError> errors_;
};

}  // namespace cairn

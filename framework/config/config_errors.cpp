#include "framework/config/config_errors.hpp"

namespace cairn {

std::vector<ConfigError> each_of(const ConfigError& error) {
  std::vector<ConfigError> all{ConfigError(error.place(), error.sentence())};
  all.insert(all.end(), error.others().begin(), error.others().end());
  return all;
}

void ConfigErrors::add(const ConfigError& error) {
  for (ConfigError& one : each_of(error))
    if (!is_full()) errors_.push_back(std::move(one));
}

void ConfigErrors::throw_if_any() const {
  if (errors_.empty()) return;
  const ConfigError& first = errors_.front();
  throw ConfigError(first.place(), first.sentence(), {errors_.begin() + 1, errors_.end()});
}

}  // namespace cairn

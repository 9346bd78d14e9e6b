// What a library refuses, as an error that says what it is about.
#pragma once

#include <stdexcept>
#include <string>

namespace cairn {

// What the work returns. A Refusal that it throws becomes a std::runtime_error that begins with `about` and a colon.
template <class Refusal = std::invalid_argument, class Work>
auto refused_about(const std::string& about, const Work& work) {
  try {
    return work();
  } catch (const Refusal& refused) {
    throw std::runtime_error(about + ": " + refused.what());
  }
}

}  // namespace cairn

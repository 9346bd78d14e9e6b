// What a recording that cannot be written reports.
#pragma once

#include <stdexcept>
#include <string>

#include "maps/base/output_file.hpp"

namespace cairn {

// What `work` returns. An OutputError that it throws becomes a std::runtime_error that names the recording's file.
template <class Work>
auto in_recording(const std::string& file_name, const Work& work) {
  try {
    return work();
  } catch (const OutputError& error) {
    throw std::runtime_error(file_name + ": the recording " + error.what());
  }
}

}  // namespace cairn

#include "framework/mission/loop/text_files.hpp"

#include "maps/base/output_file.hpp"
#include "maps/base/spelling.hpp"

namespace cairn {

Status TextFiles::write(const OutputText& output) {
  const std::string& name = output.file_name;
  const bool is_plain =
      !name.empty() && name != "." && name != ".." && name.find_first_of("/\\\n") == std::string::npos;
  if (!is_plain) return {StepState::failure, in_quotes(name) + " is not a plain file name"};
  const bool is_ours = goes_on_ || written_.contains(name);
  try {
    if (output.append && is_ours)
      append_to_file(folder_ / name, output.text);
    else
      replace_file(folder_ / name, output.text, {.sync = false});  // the tick does not wait for the disk
  } catch (const OutputError& error) {
    return {StepState::failure, name + " could not be written: " + error.what()};
  }
  written_.insert(name);
  return {StepState::success, "wrote " + name};
}

}  // namespace cairn

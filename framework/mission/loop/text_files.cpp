#include "framework/mission/loop/text_files.hpp"

#include <fstream>

namespace cairn {

Status TextFiles::write(const OutputText& output) {
  const std::string& name = output.file_name;
  const bool is_plain =
      !name.empty() && name != "." && name != ".." && name.find_first_of("/\\\n") == std::string::npos;
  if (!is_plain) return {Progress::failure, "\"" + name + "\" is not a plain file name"};
  const bool is_ours = goes_on_ || written_.contains(name);
  const auto mode = output.append && is_ours ? std::ios::app : std::ios::trunc;
  std::ofstream out(folder_ / name, std::ios::binary | mode);
  out << output.text;
  out.close();
  if (!out) return {Progress::failure, name + " could not be written"};
  written_.insert(name);
  return {Progress::success, "wrote " + name};
}

}  // namespace cairn

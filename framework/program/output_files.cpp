#include "framework/program/output_files.hpp"

#include <fstream>
#include <stdexcept>
#include <system_error>

namespace cairn {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": the output folder cannot be made: " + error.message());
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (out) return;
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) std::filesystem::remove(file, error);  // half of it is of no use
  throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace cairn

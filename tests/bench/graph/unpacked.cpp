#include "tests/bench/graph/unpacked.hpp"

#include <zlib.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace cairn {

std::string unpacked(const std::filesystem::path& file) {
  const gzFile in = gzopen(file.c_str(), "rb");
  if (in == nullptr) throw std::runtime_error(file.string() + ": cannot be opened");
  std::string text;
  std::array<char, 65'536> part{};
  int count = 0;
  while ((count = gzread(in, part.data(), part.size())) > 0) text.append(part.data(), static_cast<std::size_t>(count));
  gzclose(in);
  if (count < 0 || text.empty()) throw std::runtime_error(file.string() + ": cannot be unpacked");
  return text;
}

std::filesystem::path data_folder() {
  const char* const data = std::getenv("CAIRN_DATA");
  return data == nullptr ? "../shared/data" : data;
}

}  // namespace cairn

// The recorded maps of the data folder, whose pictures are kept as gzip.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/framework/config/config_test_support.hpp"

namespace cairn::config_test {

inline std::filesystem::path recorded_maps() {
  const char* const named = std::getenv("CAIRN_DATA");
  return (named != nullptr ? std::filesystem::path(named)
                           : std::filesystem::path(CAIRN_SOURCE_DIR) / "../shared/data") /
         "occ_maps";
}

inline std::string unpacked(const std::filesystem::path& file) {
  std::string text;
  const gzFile in = gzopen(file.c_str(), "rb");
  std::array<char, 65536> block{};
  for (int count = 1; in != nullptr && count > 0;) {
    count = gzread(in, block.data(), block.size());
    if (count > 0) text.append(block.data(), static_cast<std::size_t>(count));
  }
  if (in != nullptr) gzclose(in);
  return text;
}

// All YAML files with a picture beside them, sorted.
inline std::vector<std::filesystem::path> map_server_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::filesystem::path stem = std::filesystem::path(entry.path()).replace_extension();
    if (entry.path().extension() == ".yaml" &&
        (std::filesystem::exists(stem.string() + ".pgm.gz") || std::filesystem::exists(stem.string() + ".png")))
      files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

// A copy in the folder, its picture unpacked; gives the YAML file.
inline std::filesystem::path unpacked_map(const std::filesystem::path& yaml, const TestFolder& folder) {
  const std::string stem = std::filesystem::path(yaml).replace_extension().string();
  const std::string name = yaml.stem().string();
  if (std::filesystem::exists(stem + ".pgm.gz"))
    static_cast<void>(folder.write(name + ".pgm", unpacked(stem + ".pgm.gz")));
  else
    std::filesystem::copy_file(stem + ".png", folder.path() / (name + ".png"));
  const std::filesystem::path copy = folder.path() / yaml.filename();
  std::filesystem::copy_file(yaml, copy);
  return copy;
}

}  // namespace cairn::config_test

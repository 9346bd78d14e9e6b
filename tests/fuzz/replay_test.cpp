// Every kept input goes through the reader that it was kept for, so that what was mended once stays mended.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "maps/store/map_store.hpp"
#include "tests/fuzz/map_file.hpp"
#include "tests/fuzz/reader.hpp"
#include "tests/fuzz/scratch.hpp"

namespace cairn::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path kCorpus = fs::path(CAIRN_SOURCE_DIR) / "tests/fuzz/corpus";

std::vector<std::uint8_t> bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class KeptInputs : public testing::TestWithParam<Reader> {};

TEST_P(KeptInputs, AreReadOrRefusedByTheReadersOwnError) {
  const std::vector<fs::path> files = files_in(kCorpus / GetParam().name);
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    const std::vector<std::uint8_t> bytes = bytes_of(file);
    EXPECT_NO_THROW(GetParam().read(bytes)) << file;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, KeptInputs, testing::ValuesIn(readers().begin(), readers().end()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(KeptInputs, BelongToReadersThatAreThere) {
  for (const fs::path& folder : files_in(kCorpus))
    EXPECT_NO_THROW(static_cast<void>(reader_called(folder.filename().string())));
}

// Without that the fuzzer of saved maps would only show checksums that do not match.
TEST(MapFile, MakesTheChecksumsThatTheStoreAsksFor) {
  MapFile map(bytes_of(fs::path(CAIRN_SOURCE_DIR) / "tests/data/map_schema_1.cairn"));
  ASSERT_TRUE(map.execute("UPDATE landmarks SET x_m = 0.25"));
  EXPECT_THROW(static_cast<void>(load_map(scratch_file("edited.cairn", map.bytes()))), StoreError);
  map.sum_up();
  const SavedMap loaded = load_map(scratch_file("edited.cairn", map.bytes()));
  ASSERT_FALSE(loaded.graph.landmarks().empty());
  for (const auto& [id, landmark] : loaded.graph.landmarks()) EXPECT_EQ(landmark.T_map_landmark.x_m, 0.25);
}

}  // namespace
}  // namespace cairn::fuzz

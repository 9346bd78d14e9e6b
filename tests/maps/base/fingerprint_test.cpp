#include "maps/base/fingerprint.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace cairn {
namespace {

// Values that xxhsum(1) gives: xxhsum -H3.
TEST(Fingerprint, IsXxh3) {
  EXPECT_EQ(fingerprint_of(""), "2d06800538d394c2");
  EXPECT_NE(fingerprint_of("a"), fingerprint_of("b"));
  EXPECT_EQ(fingerprint_of("a").size(), 16U);
}

TEST(Fingerprint, OfAFileIsThatOfItsBytes) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("cairn_fingerprint_" + std::to_string(::getpid()));
  for (const std::size_t size : {0U, 1U, 65536U, 200001U}) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(i * i % 251);
    std::ofstream(file, std::ios::binary) << bytes;
    const auto found = hash_of_file(file);
    ASSERT_TRUE(found) << size;
    EXPECT_EQ(found->size, size);
    EXPECT_EQ(found->hash, hash_of(bytes)) << size;
  }
  std::filesystem::remove(file);
}

TEST(Fingerprint, OfWhatIsNoPlainFileThereIsNone) {
  EXPECT_FALSE(hash_of_file("/dev/null"));
  EXPECT_FALSE(hash_of_file("/nowhere/at/all"));
  EXPECT_FALSE(hash_of_file("/"));
}

}  // namespace
}  // namespace cairn

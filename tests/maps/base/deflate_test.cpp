#include "maps/base/deflate.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "maps/base/source_text.hpp"

namespace cairn {
namespace {

TEST(Deflate, GivesBackWhatWasPacked) {
  for (const std::string& bytes : {std::string(), std::string("a"), std::string(100'000, '\0') + "end"}) {
    const std::string packed = deflated(bytes);
    EXPECT_EQ(inflated(packed, bytes.size()), bytes);
    EXPECT_LT(packed.size(), bytes.size() / 100 + 20);
  }
}

TEST(Deflate, AnotherSizeOrOtherBytesAreRefused) {
  const std::string packed = deflated("forty two");
  EXPECT_THROW((void)inflated(packed, 8), std::invalid_argument);
  EXPECT_THROW((void)inflated(packed, 10), std::invalid_argument);
  EXPECT_THROW((void)inflated("forty two", 9), std::invalid_argument);
  EXPECT_THROW((void)inflated(packed, std::size_t{1} << 50), std::invalid_argument);  // before any memory is taken
}

TEST(Deflate, GzipFilesOneAfterTheOtherAreAFile) {
  const auto file = std::filesystem::temp_directory_path() / ("cairn_members_" + std::to_string(::getpid()) + ".gz");
  const std::string first(100'000, 'a');
  std::ofstream(file, std::ios::binary) << gzip_member(first) << gzip_member("") << gzip_member("b\n");
  EXPECT_LT(std::filesystem::file_size(file), 1'000U);
  EXPECT_EQ(exchange::text_of_file(file), first + "b\n");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace cairn

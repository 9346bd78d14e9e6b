#include "framework/reporting/watching/change_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ChangeLog, GivesEachReaderWhatHasChangedSinceItLooked) {
  ChangeLog<int> log;
  std::uint64_t early = 0;
  std::uint64_t late = 0;
  log.mark(7);
  log.mark(3);
  EXPECT_THAT(log.take(early, 10), ElementsAre(7, 3));
  EXPECT_THAT(log.take(early, 10), IsEmpty());
  log.mark(7);
  EXPECT_THAT(log.take(early, 10), ElementsAre(7));
  EXPECT_THAT(log.take(late, 10), ElementsAre(3, 7)) << "each once, in the order of their last change";
}

TEST(ChangeLog, GivesPartsThatMakeTheWhole) {
  ChangeLog<int> log;
  for (int i = 0; i < 5; ++i) log.mark(i);
  std::uint64_t read = 0;
  EXPECT_THAT(log.take(read, 3), ElementsAre(0, 1, 2));
  EXPECT_TRUE(log.has_more(read));
  log.mark(1);
  EXPECT_THAT(log.take(read, 3), ElementsAre(3, 4, 1));
  EXPECT_FALSE(log.has_more(read));
}

}  // namespace
}  // namespace cairn

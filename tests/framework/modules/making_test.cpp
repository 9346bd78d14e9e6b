#include "framework/modules/making.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <thread>

namespace cairn {
namespace {

using testing::StrEq;

TEST(ModuleMaking, TheInnermostOfThisThreadIsKnown) {
  EXPECT_EQ(module_being_made_here(), nullptr);
  EXPECT_FALSE(module_being_made());
  {
    const ModuleMaking localizer("localizer");
    {
      const ModuleMaking closer("closer", true);
      EXPECT_THAT(module_being_made_here(), StrEq("closer"));
      EXPECT_EQ(module_being_made()->module, "closer");
      EXPECT_TRUE(module_being_made()->may_take_long);
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      EXPECT_GE(module_being_made()->for_s, 0.3);
    }
    EXPECT_THAT(module_being_made_here(), StrEq("localizer"));
    EXPECT_LT(module_being_made()->for_s, 0.3) << "what another took does not count";
  }
  EXPECT_EQ(module_being_made_here(), nullptr);
}

TEST(ModuleMaking, OfManyThreadsTheOneThatHasTakenLongest) {
  std::promise<void> begun;
  std::promise<void> end;
  std::thread other([&] {
    const ModuleMaking slow("slow");
    begun.set_value();
    end.get_future().wait();
  });
  begun.get_future().wait();
  const ModuleMaking quick("quick");
  EXPECT_EQ(module_being_made()->module, "slow");
  EXPECT_THAT(module_being_made_here(), StrEq("quick"));
  end.set_value();
  other.join();
  EXPECT_EQ(module_being_made()->module, "quick");
}

}  // namespace
}  // namespace cairn

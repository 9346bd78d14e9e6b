// The host's own part of a tick allocates nothing once it is under way.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "framework/reporting/report.hpp"
#include "tests/framework/mission/still_modules.hpp"

namespace {
std::atomic<long> allocations{0};
}

// GCC takes free() in here for a mistake.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

// Counts what the whole program, its libraries included, allocates.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace cairn {
namespace {

TEST(HostOverhead, ATickAllocatesNothing) {
  const ModuleLibrary library = still::library();
  const auto out = std::filesystem::path(testing::TempDir()) / "cairn_still";
  std::filesystem::create_directories(out);
  MissionRunner runner(still::mission(5000), library, {out, false, nullptr});
  RunReport report;
  runner.subscribe(report);
  long at_1000 = -1;
  long at_5000 = -2;
  still::on_tick = [&](int tick) {
    if (tick == 1000) at_1000 = allocations;
    if (tick == 5000) at_5000 = allocations;
  };
  const MissionResult result = runner.run();
  still::on_tick = nullptr;
  EXPECT_EQ(result.readings, 0);
  EXPECT_EQ(at_5000 - at_1000, 0) << "allocations in 4000 ticks";
}

}  // namespace
}  // namespace cairn

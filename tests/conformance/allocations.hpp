// Counting allocations, for calls that promise to make none.
//
// The library that holds this replaces the global operator new of the test program, modules included. What
// calls malloc by itself (Eigen's matrices without a fixed size) is not seen.
#pragma once

#include <cstdint>

namespace cairn::conformance {

// Counts what this thread allocates from its construction on.
class AllocationCount {
 public:
  AllocationCount();
  [[nodiscard]] std::int64_t count() const;

 private:
  std::int64_t before_;
};

}  // namespace cairn::conformance

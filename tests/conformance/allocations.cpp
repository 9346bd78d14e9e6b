#include "tests/conformance/allocations.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CAIRN_COUNTS_NO_ALLOCATIONS  // the operators are ThreadSanitizer's own
#endif
#endif

namespace {

thread_local std::int64_t allocations_of_this_thread = 0;

}  // namespace

#if !defined(CAIRN_COUNTS_NO_ALLOCATIONS)
namespace {

void* counted(std::size_t bytes) {
  ++allocations_of_this_thread;
  if (void* const memory = std::malloc(std::max<std::size_t>(bytes, 1))) return memory;
  throw std::bad_alloc();
}

void* counted(std::size_t bytes, std::align_val_t alignment) {
  ++allocations_of_this_thread;
  const auto step = static_cast<std::size_t>(alignment);
  if (void* const memory = std::aligned_alloc(step, (std::max<std::size_t>(bytes, 1) + step - 1) / step * step))
    return memory;
  throw std::bad_alloc();
}

}  // namespace

// The array forms of the standard library come here too; its nothrow forms do, unless a sanitizer has its own.
void* operator new(std::size_t bytes) {
  return counted(bytes);
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  ++allocations_of_this_thread;
  return std::malloc(std::max<std::size_t>(bytes, 1));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return counted(bytes, alignment);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
#endif

namespace cairn::conformance {

AllocationCount::AllocationCount() : before_(allocations_of_this_thread) {}

std::int64_t AllocationCount::count() const {
  return allocations_of_this_thread - before_;
}

}  // namespace cairn::conformance

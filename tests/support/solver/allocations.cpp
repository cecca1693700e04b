#include "tests/support/solver/allocations.h"

#include <atomic>
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TRAMMEL_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TRAMMEL_SANITIZED
#endif
#endif

#ifdef TRAMMEL_SANITIZED

std::int64_t allocations() {
  return -1;
}

#else

namespace {
std::atomic<std::int64_t> count{0};
}  // namespace

extern "C" {
// glibc allows a program to replace malloc and to call the original by this name.
void* __libc_malloc(std::size_t size);  // NOLINT(bugprone-reserved-identifier)
void* malloc(std::size_t size) {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
}

std::int64_t allocations() {
  return count.load();
}

#endif

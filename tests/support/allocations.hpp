// Counts what is asked of the heap. To be included in one source of a test
// program: it replaces operator new for all of it.
#pragma once

#include <cstdlib>
#include <new>

namespace sofof::test {

inline long allocations = 0;

} // namespace sofof::test

// NOLINTBEGIN
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++sofof::test::allocations;
  if (auto* memory = std::malloc(size > 0 ? size : 1))
    return memory;
  throw std::bad_alloc{};
}
// Sorting asks so; the address sanitizer would answer with its own memory.
[[gnu::noinline]] void* operator new(std::size_t size,
                                     const std::nothrow_t&) noexcept {
  ++sofof::test::allocations;
  return std::malloc(size > 0 ? size : 1);
}
[[gnu::noinline]] void* operator new(std::size_t size,
                                     std::align_val_t alignment) {
  ++sofof::test::allocations;
  const auto unit = static_cast<std::size_t>(alignment);
  if (auto* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit))
    return memory;
  throw std::bad_alloc{};
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory,
                                       std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t,
                                       std::align_val_t) noexcept {
  std::free(memory);
}
// NOLINTEND

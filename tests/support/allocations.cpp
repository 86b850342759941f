// Replaces operator new for all of a test program. It is compiled alone: a
// compiler that sees both a replacement and who calls it may take the calls for
// impossible, as Clang 16 does.
#include "tests/support/allocations.hpp"

#include <cstdlib>
#include <new>

namespace sofof::test {

long allocations = 0;

} // namespace sofof::test

// NOLINTBEGIN
void* operator new(std::size_t size) {
  ++sofof::test::allocations;
  if (auto* memory = std::malloc(size > 0 ? size : 1))
    return memory;
  throw std::bad_alloc{};
}
// Sorting asks so; the address sanitizer would answer with its own memory.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++sofof::test::allocations;
  return std::malloc(size > 0 ? size : 1);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++sofof::test::allocations;
  const auto unit = static_cast<std::size_t>(alignment);
  if (auto* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit))
    return memory;
  throw std::bad_alloc{};
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
// NOLINTEND

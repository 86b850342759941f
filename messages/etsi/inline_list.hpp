// A short list without heap.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace sofof::messages::etsi {

/// Longer lists than this many bytes take the heap instead.
inline constexpr std::size_t longest_inline = 1024;

/// At most `most` values, in place; those that are not there cost nothing.
template <class T, std::size_t most>
class inline_list {
  static_assert(std::is_trivially_copyable_v<T>);

public:
  using value_type = T;

  inline_list() {} // leaves the room as it is
  inline_list(const inline_list& x) { *this = x; }
  inline_list& operator=(const inline_list& x) {
    size_ = x.size_;
    std::uninitialized_copy(x.begin(), x.end(), begin());
    return *this;
  }
  ~inline_list() = default;

  static constexpr std::size_t capacity() { return most; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }

  /// New values are as they are made. Precondition: size <= capacity().
  void resize(std::size_t size) {
    assert(size <= capacity());
    for (auto i = size_; i < size; ++i)
      std::construct_at(begin() + i);
    size_ = size;
  }
  /// Precondition: size() < capacity().
  void push_back(const T& x) {
    assert(size() < capacity());
    std::construct_at(begin() + size_++, x);
  }

  T& operator[](std::size_t i) { return begin()[i]; }
  const T& operator[](std::size_t i) const { return begin()[i]; }
  T* begin() { return std::launder(reinterpret_cast<T*>(room_.data())); }
  T* end() { return begin() + size_; }
  const T* begin() const {
    return std::launder(reinterpret_cast<const T*>(room_.data()));
  }
  const T* end() const { return begin() + size_; }

private:
  std::size_t size_ = 0;
  alignas(T) std::array<std::byte, most * sizeof(T)> room_;
};

} // namespace sofof::messages::etsi

// A number that names things of one kind.
#pragma once

#include <fmt/core.h>

#include <compare>
#include <concepts>
#include <cstddef>
#include <functional>

namespace sofof {

/// Made of its number without further ado; back to the number, and so to
/// another kind, only by `value`.
/// @tparam Tag  Tells the kinds apart.
template <class Tag, std::unsigned_integral Rep>
class strong_id {
public:
  using rep = Rep; ///< As it travels in messages.

  constexpr strong_id() = default;
  // NOLINTNEXTLINE(*-explicit-*): numbers come from files and messages
  constexpr strong_id(Rep value) : value_{value} {}

  constexpr Rep value() const { return value_; }

  friend constexpr bool operator==(strong_id, strong_id) = default;
  friend constexpr auto operator<=>(strong_id, strong_id) = default;

private:
  Rep value_ = 0;
};

} // namespace sofof

template <class Tag, class Rep>
struct std::hash<sofof::strong_id<Tag, Rep>> {
  std::size_t operator()(sofof::strong_id<Tag, Rep> x) const {
    return std::hash<Rep>{}(x.value());
  }
};

template <class Tag, class Rep>
struct fmt::formatter<sofof::strong_id<Tag, Rep>> : fmt::formatter<Rep> {
  template <class Context>
  auto format(sofof::strong_id<Tag, Rep> x, Context& context) const {
    return fmt::formatter<Rep>::format(x.value(), context);
  }
};

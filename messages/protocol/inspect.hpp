// How the types of world/ travel; every message header builds on these.
#pragma once

#include "base/geometry.hpp"
#include "base/strong_id.hpp"
#include "base/time.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace sofof {

/// Enumerations travel as numbers; unknown ones are refused.
template <class Inspector, class Enum>
bool inspect_enum(Inspector& f, Enum& x, Enum last) {
  using number = std::underlying_type_t<Enum>;
  auto get = [&x] { return static_cast<number>(x); };
  auto set = [&x, last](number value) {
    if (value > static_cast<number>(last))
      return false;
    x = static_cast<Enum>(value);
    return true;
  };
  return f.apply(get, set);
}

template <class Inspector>
bool inspect(Inspector& f, time_point& x) {
  auto get = [&x] { return x.time_since_epoch().count(); };
  auto set = [&x](duration::rep count) {
    x = time_point{duration{count}};
    return is_plausible(x);
  };
  return f.apply(get, set);
}

/// An id travels as its number.
template <class Inspector, class Tag, class Rep>
bool inspect(Inspector& f, strong_id<Tag, Rep>& x) {
  auto get = [&x] { return x.value(); };
  auto set = [&x](Rep value) {
    x = value;
    return true;
  };
  return f.apply(get, set);
}

/// A finite number as its bits: CAF 0.18 breaks those next to zero.
template <class Inspector>
auto exact_field(Inspector& f, std::string_view name, double& x) {
  auto get = [&x] { return std::bit_cast<std::uint64_t>(x); };
  auto set = [&x](std::uint64_t bits) {
    x = std::bit_cast<double>(bits);
    return std::isfinite(x);
  };
  return f.field({name.data(), name.size()}, get, set);
}

template <class Inspector>
bool inspect(Inspector& f, point& x) {
  return f.object(x).fields(exact_field(f, "x_m", x.x_m),
                            exact_field(f, "y_m", x.y_m));
}

} // namespace sofof

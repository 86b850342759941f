// How the types of world/ travel; every message header builds on these.
#pragma once

#include "world/geometry.hpp"
#include "world/time.hpp"

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

template <class Inspector>
bool inspect(Inspector& f, point& x) {
  return f.object(x).fields(f.field("x_m", x.x_m), f.field("y_m", x.y_m));
}

} // namespace sofof

// Every number in a message, one after the other.
#pragma once

#include "messages/etsi/schema.hpp"

namespace sofof::test {

/// Calls `visit` with every INTEGER that is there.
template <class T, class Visit>
void each_number(T& x, Visit&& visit) {
  using namespace messages::etsi;
  const auto go_on = [&](auto& inner) { each_number(inner, visit); };
  if constexpr (is_integer<T>) {
    visit(x);
  } else if constexpr (is_optional<T>) {
    if (x)
      go_on(*x);
  } else if constexpr (is_defaulted<T>) {
    go_on(x.value);
  } else if constexpr (is_sequence_of<T>) {
    for (auto& element : x)
      go_on(element);
  } else if constexpr (is_choice<T> || is_open_type<T>) {
    std::visit(go_on, x.value);
  } else if constexpr (requires { T::fields(x, [](auto&&...) {}); }) {
    T::fields(x, [&](std::string_view, auto& member) { go_on(member); });
  }
}

} // namespace sofof::test

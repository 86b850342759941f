// What a struct consists of, said once for all who write and read it.
#pragma once

#include <concepts>
#include <string_view>

namespace sofof {

/// Takes any field, and does nothing.
struct no_field_visitor {
  template <class T>
  void operator()(std::string_view, T&) {}
};

/// A struct whose fields are listed in order, directly behind it, for whoever
/// writes or reads them: CAF's inspectors (messages/protocol/inspect.hpp) and
/// the plain bytes of payloads (messages/protocol/bytes.hpp).
///
///     void visit_fields(auto& v, point& x) {
///       v("x_m", x.x_m);
///       v("y_m", x.y_m);
///     }
template <class T>
concept has_fields = requires(no_field_visitor& v, T& x) {
  visit_fields(v, x);
};

/// An enumeration that says beside it which is its last number, the first one
/// being 0; others are refused when one is read.
///
///     constexpr side last_of(side) { return side::provider; }
template <class T>
concept has_last = requires(T x) {
  { last_of(x) } -> std::same_as<T>;
};

} // namespace sofof

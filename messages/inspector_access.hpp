// Tells CAF's inspectors how our values travel.
#pragma once

#include "base/fields.hpp"
#include "base/strong_id.hpp"
#include "base/time.hpp"
#include "messages/protocol/inspect.hpp"

#include <caf/inspector_access.hpp>
#include <caf/inspector_access_base.hpp>

namespace sofof::messages {

/// As messages/protocol/inspect.hpp says.
template <class T>
struct value_access : caf::inspector_access_base<T> {
  template <class Inspector>
  static bool apply(Inspector& f, T& x) {
    return inspect_value(f, x);
  }
};

} // namespace sofof::messages

// Specialised for any struct that lists its fields, wherever it is declared:
// an overload of `inspect` is only found beside its type.
template <sofof::has_fields T>
struct caf::inspector_access<T> : sofof::messages::value_access<T> {};

template <sofof::has_last T>
struct caf::inspector_access<T> : sofof::messages::value_access<T> {};

template <>
struct caf::inspector_access<sofof::time_point>
    : sofof::messages::value_access<sofof::time_point> {};

template <class Tag, class Rep>
struct caf::inspector_access<sofof::strong_id<Tag, Rep>>
    : sofof::messages::value_access<sofof::strong_id<Tag, Rep>> {};

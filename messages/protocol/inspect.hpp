// How structs, enumerations and times travel in CAF's messages. CAF finds this
// by messages/inspector_access.hpp; counting octets does without CAF.
#pragma once

#include "base/fields.hpp"
#include "base/geometry.hpp"
#include "base/strong_id.hpp"
#include "base/time.hpp"

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace sofof::messages {

/// Enumerations travel as numbers; unknown ones are refused.
template <class Inspector, has_last Enum>
bool inspect_value(Inspector& f, Enum& x) {
  using number = std::underlying_type_t<Enum>;
  auto get = [&x] { return static_cast<number>(x); };
  auto set = [&x](number value) {
    if (value > static_cast<number>(last_of(x)))
      return false;
    x = static_cast<Enum>(value);
    return true;
  };
  return f.apply(get, set);
}

template <class Inspector>
bool inspect_value(Inspector& f, time_point& x) {
  auto get = [&x] { return x.time_since_epoch().count(); };
  auto set = [&x](duration::rep count) {
    x = time_point{duration{count}};
    return is_plausible(x);
  };
  return f.apply(get, set);
}

/// An id travels as its number.
template <class Inspector, class Tag, class Rep>
bool inspect_value(Inspector& f, strong_id<Tag, Rep>& x) {
  auto get = [&x] { return x.value(); };
  auto set = [&x](Rep value) {
    x = value;
    return true;
  };
  return f.apply(get, set);
}

/// What travels as a text of its own making.
template <class T>
concept packs_itself = requires(T& x, const std::string& text) {
  { x.packed() } -> std::same_as<std::string>;
  { x.unpack(text) } -> std::same_as<bool>;
};

/// Hands the fields of a struct to one of CAF's inspectors.
template <class Inspector>
class field_inspector {
public:
  explicit field_inspector(Inspector& f) : f_{f} {}

  template <class T>
  void operator()(std::string_view name, T& x) {
    ok_ = ok_ && f_.field({name.data(), name.size()}, x)(f_);
  }

  /// A number, finite and as its bits: CAF 0.18 breaks those next to zero. An
  /// optional one takes CAF's way; none crosses between hosts.
  void operator()(std::string_view name, double& x) {
    auto get = [&x] { return std::bit_cast<std::uint64_t>(x); };
    auto set = [&x](std::uint64_t bits) {
      x = std::bit_cast<double>(bits);
      return std::isfinite(x);
    };
    ok_ = ok_ && f_.field({name.data(), name.size()}, get, set)(f_);
  }

  /// What packs itself into a text, and refuses others.
  template <packs_itself T>
  void operator()(std::string_view name, T& x) {
    auto get = [&x] { return x.packed(); };
    auto set = [&x](const std::string& text) { return x.unpack(text); };
    ok_ = ok_ && f_.field({name.data(), name.size()}, get, set)(f_);
  }

  /// An id that may be missing, as its number: no provider has the number 0.
  template <class Tag, class Rep>
  void operator()(std::string_view name,
                  std::optional<strong_id<Tag, Rep>>& x) {
    auto get = [&x] { return x ? x->value() : Rep{0}; };
    auto set = [&x](Rep value) {
      x = value == 0 ? std::nullopt : std::optional<strong_id<Tag, Rep>>{value};
      return true;
    };
    ok_ = ok_ && f_.field({name.data(), name.size()}, get, set)(f_);
  }

  bool ok() const { return ok_; }

private:
  Inspector& f_;
  bool ok_ = true;
};

/// Structs travel as the list of their fields says.
template <class Inspector, has_fields T>
bool inspect_value(Inspector& f, T& x) {
  return f.object(x).fields([&x](Inspector& g) {
    field_inspector each{g};
    visit_fields(each, x);
    return each.ok();
  });
}

} // namespace sofof::messages

// Random contents for every message, and whether two of them are the same.
// Both walk the members themselves, not `inspect`, so that a member that
// `inspect` forgets is noticed.
#pragma once

#include "messages/type_ids.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/echo_service.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace sofof::test {

/// Number of members; a wrong one does not compile.
template <class T>
inline constexpr std::size_t arity = 0;
template <>
inline constexpr std::size_t arity<point> = 2;
template <>
inline constexpr std::size_t arity<messages::session_id> = 4;
template <>
inline constexpr std::size_t arity<messages::cam> = 9;
template <>
inline constexpr std::size_t arity<messages::provider_motion> = 2;
template <>
inline constexpr std::size_t arity<messages::service_offer> = 8;
template <>
inline constexpr std::size_t arity<messages::session_digest> = 4;
template <>
inline constexpr std::size_t arity<candidate> = 3;
template <>
inline constexpr std::size_t arity<messages::service_request> = 7;
template <>
inline constexpr std::size_t arity<messages::verdict> = 4;
template <>
inline constexpr std::size_t arity<messages::service_response> = 4;
template <>
inline constexpr std::size_t arity<messages::service_input> = 8;
template <>
inline constexpr std::size_t arity<messages::transit> = 2;
template <>
inline constexpr std::size_t arity<messages::result_timing> = 5;
template <>
inline constexpr std::size_t arity<messages::service_result> = 7;
template <>
inline constexpr std::size_t arity<messages::service_end> = 4;
template <>
inline constexpr std::size_t arity<messages::qos_limits> = 3;
template <>
inline constexpr std::size_t arity<messages::arrival> = 4;
template <>
inline constexpr std::size_t arity<messages::qos_violation> = 6;
template <>
inline constexpr std::size_t arity<world::vehicle_state> = 5;
template <>
inline constexpr std::size_t arity<messages::motion_report> = 3;
template <>
inline constexpr std::size_t arity<messages::ego_state> = 2;
template <>
inline constexpr std::size_t arity<messages::source_change> = 2;
template <>
inline constexpr std::size_t arity<world::perceived_object> = 6;
template <>
inline constexpr std::size_t arity<world::perception> = 3;
template <>
inline constexpr std::size_t arity<messages::roadside_detections> = 4;
template <>
inline constexpr std::size_t arity<world::viewpoint> = 4;
template <>
inline constexpr std::size_t arity<messages::peer_hello> = 6;
template <>
inline constexpr std::size_t arity<messages::peer_welcome> = 2;
template <>
inline constexpr std::size_t arity<messages::ping> = 2;
template <>
inline constexpr std::size_t arity<messages::pong> = 3;
template <>
inline constexpr std::size_t arity<messages::stream_id> = 3;

/// Everything that travels and is not a handle.
using all_messages =
    std::tuple<time_point, point, messages::service_name, messages::payload,
               messages::session_id, messages::cam, messages::service_offer,
               messages::session_digest, messages::service_request,
               messages::service_response, messages::service_input,
               messages::service_result, messages::service_end,
               messages::qos_limits, messages::arrival, messages::qos_violation,
               messages::lifecycle_step, messages::motion_report,
               messages::ego_state, messages::source_change, world::perception,
               messages::roadside_detections, messages::its_pdu,
               messages::peer_hello, messages::peer_welcome, messages::ping,
               messages::pong, messages::stream_id>;

/// @returns references to all members.
template <class T>
auto members(T& x) {
  constexpr auto n = arity<std::remove_const_t<T>>;
  static_assert(n >= 2 && n <= 9);
  if constexpr (n == 2) {
    auto& [a, b] = x;
    return std::tie(a, b);
  } else if constexpr (n == 3) {
    auto& [a, b, c] = x;
    return std::tie(a, b, c);
  } else if constexpr (n == 4) {
    auto& [a, b, c, d] = x;
    return std::tie(a, b, c, d);
  } else if constexpr (n == 5) {
    auto& [a, b, c, d, e] = x;
    return std::tie(a, b, c, d, e);
  } else if constexpr (n == 6) {
    auto& [a, b, c, d, e, f] = x;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (n == 7) {
    auto& [a, b, c, d, e, f, g] = x;
    return std::tie(a, b, c, d, e, f, g);
  } else if constexpr (n == 8) {
    auto& [a, b, c, d, e, f, g, h] = x;
    return std::tie(a, b, c, d, e, f, g, h);
  } else {
    auto& [a, b, c, d, e, f, g, h, i] = x;
    return std::tie(a, b, c, d, e, f, g, h, i);
  }
}

/// Fills a message with random contents.
class filler {
public:
  explicit filler(std::uint64_t seed) : random_{seed} {}

  /// @returns a whole number in [0, n).
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(random_.between(0, static_cast<double>(n)));
  }

  template <class T>
  void fill(T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      x = below(2) == 1;
    } else if constexpr (std::is_floating_point_v<T>) {
      x = random_.between(-1e6, 1e6);
    } else if constexpr (std::is_integral_v<T>) {
      x = static_cast<T>(below(1u << 31) * (1u << 31) + below(1u << 31));
    } else if constexpr (std::is_enum_v<T>) {
      fill_enum(x);
    } else {
      const auto fill_all = [this](auto&... xs) { (fill(xs), ...); };
      std::apply(fill_all, members(x));
    }
  }
  template <class Tag, class Rep>
  void fill(strong_id<Tag, Rep>& x) {
    Rep value = 0;
    fill(value);
    x = value;
  }
  void fill(duration& x) {
    duration::rep count = 0;
    fill(count);
    x = duration{count};
  }
  void fill(time_point& x) {
    duration since{};
    fill(since);
    x = time_point{since / 8}; // plausible
  }
  void fill(std::string& x) {
    x.resize(below(20));
    for (auto& c : x)
      c = static_cast<char>(below(256));
  }
  void fill(messages::service_name& x) {
    std::string text(below(messages::service_name::max_size + 1), ' ');
    for (auto& c : text)
      c = static_cast<char>('a' + below(26));
    x = messages::service_name{text};
  }
  void fill(messages::payload& x) {
    echo inside;
    fill(inside.number);
    x = below(4) == 0 ? messages::payload{} : messages::payload::of(inside);
  }
  void fill(messages::its_pdu& x) {
    fill(x.octets);
  } // the rest does not travel
  void fill(messages::service_input& x) {
    const auto keep = x.up;         // does not travel, ...
    const auto at_once = x.at_once; // nor does this, ...
    const auto sensed = x.sensed;   // or this
    std::apply([this](auto&... xs) { (fill(xs), ...); }, members(x));
    x.up = keep;
    x.at_once = at_once;
    x.sensed = sensed;
  }
  void fill(messages::result_timing& x) {
    const auto keep = x.down; // does not travel
    std::apply([this](auto&... xs) { (fill(xs), ...); }, members(x));
    x.down = keep;
  }
  template <class T>
  void fill(std::optional<T>& x) {
    x.reset();
    if (below(2) == 1)
      fill(x.emplace());
  }
  template <class T>
  void fill(std::vector<T>& xs) {
    xs.resize(below(6));
    for (auto& x : xs)
      fill(x);
  }

private:
  void fill_enum(std::byte& x) { x = static_cast<std::byte>(below(256)); }
  void fill_enum(messages::end_reason& x) {
    x = static_cast<messages::end_reason>(below(13));
  }
  void fill_enum(messages::side& x) {
    x = static_cast<messages::side>(below(2));
  }
  void fill_enum(messages::qos_breach& x) {
    x = static_cast<messages::qos_breach>(below(5));
  }
  void fill_enum(messages::lifecycle_step& x) {
    x = static_cast<messages::lifecycle_step>(below(4));
  }
  void fill_enum(messages::stream_id::what& x) {
    x = static_cast<messages::stream_id::what>(below(4));
  }

  dice random_;
};

inline bool same(const messages::payload& a, const messages::payload& b);
inline bool same(const messages::its_pdu& a, const messages::its_pdu& b);
template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b);
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b);

/// @returns whether two messages agree in every member.
template <class T>
bool same(const T& a, const T& b) {
  if constexpr (arity<T> == 0)
    return a == b;
  else
    return std::apply(
        [&](const auto&... as) {
          return std::apply(
              [&](const auto&... bs) { return (same(as, bs) && ...); },
              members(b));
        },
        members(a));
}

inline bool same(const messages::payload& a, const messages::payload& b) {
  return a.type() == b.type() && a.encoded() == b.encoded();
}

inline bool same(const messages::its_pdu& a, const messages::its_pdu& b) {
  return a.octets == b.octets;
}

template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  if (a.size() != b.size())
    return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!same(a[i], b[i]))
      return false;
  return true;
}

/// Calls `f` with a default-made message of every type.
template <class Function>
void for_every_message(Function f) {
  std::apply([&](const auto&... xs) { (f(xs), ...); }, all_messages{});
}

} // namespace sofof::test

// From the description of a message to its JSON, and back.
#include "messages/etsi/json.hpp"

#include "base/options/spelling.hpp"
#include "messages/etsi/field_path.hpp"
#include "messages/etsi/hex.hpp"
#include "messages/etsi/uper.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <type_traits>
#include <utility>

namespace sofof::messages::etsi {

namespace {

using nlohmann::json;

/// A BIT STRING of no fixed size.
template <class T>
inline constexpr bool is_bit_list = false;
template <std::size_t a, std::size_t b, growth g>
inline constexpr bool is_bit_list<sequence_of<bool, a, b, g>> = true;

/// Deeper than any message goes, and no strain for who walks down.
constexpr int deepest = 32;

/// How far beyond its names an enumeration goes: what small numbers can say.
constexpr std::int64_t most_unknown = (1 << small_width) - 1;

// -- writing ------------------------------------------------------------------

class json_writer {
public:
  explicit json_writer(std::string& out) : out_{out} {}

  template <class T>
  void write(const T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      out_ += x ? "true" : "false";
    } else if constexpr (is_integer<T>) {
      write_number(x.value);
    } else if constexpr (std::is_enum_v<T>) {
      const auto index = static_cast<std::size_t>(x);
      if (index < names_of<T>.names.size())
        write_word(names_of<T>.names[index]);
      else
        write_number(index);
    } else if constexpr (is_bit_string<T>) {
      out_ += '"';
      for (unsigned i = 0; i < T::width; ++i)
        out_ += x.test(i) ? '1' : '0';
      out_ += '"';
    } else if constexpr (is_bit_list<T>) {
      out_ += '"';
      for (const auto bit : x)
        out_ += bit ? '1' : '0';
      out_ += '"';
    } else if constexpr (is_sequence_of<T>) {
      write_list(x);
    } else if constexpr (is_choice<T>) {
      out_ += '{';
      write_word(T::names[x.value.index()]);
      out_ += ':';
      std::visit([this](const auto& value) { write(value); }, x.value);
      out_ += '}';
    } else if constexpr (is_open_type<T>) {
      members of{*this};
      of(T::id_name, x.id());
      std::visit([&](const auto& value) { of(T::value_name, value); }, x.value);
    } else if constexpr (std::is_same_v<T, opaque>) {
      out_ += '"';
      append_hex(out_, x.octets);
      out_ += '"';
    } else {
      T::fields(x, members{*this});
    }
  }

private:
  /// Writes an object, member by member.
  class members {
  public:
    explicit members(json_writer& to) : to_{to} { to_.out_ += '{'; }
    ~members() { to_.out_ += '}'; }
    members(const members&) = delete;
    members& operator=(const members&) = delete;

    template <class T>
    void operator()(std::string_view name, const T& x) {
      if constexpr (is_optional<T>) {
        if (x)
          (*this)(name, *x);
      } else if constexpr (is_defaulted<T>) {
        (*this)(name, x.value);
      } else {
        if (!std::exchange(empty_, false))
          to_.out_ += ',';
        to_.write_word(name);
        to_.out_ += ':';
        to_.write(x);
      }
    }

  private:
    json_writer& to_;
    bool empty_ = true;
  };

  void write_list(const auto& xs) {
    out_ += '[';
    for (auto first = true; const auto& x : xs) {
      if (!std::exchange(first, false))
        out_ += ',';
      write(x);
    }
    out_ += ']';
  }
  void write_number(auto x) {
    fmt::format_to(std::back_inserter(out_), "{}", x);
  }
  /// Names in ASN.1 have no character that JSON escapes.
  void write_word(std::string_view name) {
    out_ += '"';
    out_ += name;
    out_ += '"';
  }

  std::string& out_;
};

// -- reading ------------------------------------------------------------------

/// What is wrong, in a sentence.
struct wrong {
  std::string sentence;
};

/// Reads into a message; what it has been is overwritten.
class json_reader {
public:
  template <class T>
  void read(const json& from, T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      if (!from.is_boolean())
        refuse(from, "true or false");
      x = from.get<bool>();
    } else if constexpr (is_integer<T>) {
      read_integer(from, x);
    } else if constexpr (std::is_enum_v<T>) {
      read_enum(from, x);
    } else if constexpr (is_bit_string<T>) {
      x.bits = 0;
      const auto& bits = read_bits(from, T::width, T::width);
      for (unsigned i = 0; i < T::width; ++i)
        if (bits[i] == '1')
          x.set(i);
    } else if constexpr (is_bit_list<T>) {
      const auto& bits = read_bits(from, T::low, T::high);
      x.resize(bits.size());
      std::ranges::transform(bits, x.begin(), [](char c) { return c == '1'; });
    } else if constexpr (is_sequence_of<T>) {
      read_list(from, x);
    } else if constexpr (is_choice<T>) {
      read_choice(from, x);
    } else if constexpr (is_open_type<T>) {
      read_open(from, x);
    } else if constexpr (std::is_same_v<T, opaque>) {
      auto octets = from.is_string()
                        ? octets_from_hex(from.get_ref<const std::string&>())
                        : std::nullopt;
      if (!octets)
        refuse(from, "a string of hexadecimal digits, two an octet,");
      x.octets = std::move(*octets);
    } else {
      member_list members;
      T::fields(x, members);
      check_members(from, members.names);
      T::fields(x, member_reader{*this, from});
    }
  }

  /// @returns what the header of a message says it is. Only the names of its
  /// members differ from message to message.
  message_key read_key(const json& from) {
    if (!from.is_object())
      refuse(from, "an object");
    const auto& header = member(from, "header");
    path_.enter("header");
    if (!header.is_object())
      refuse(header, "an object");
    integer<0, 255> version, id;
    const member_reader members{*this, header};
    members("protocolVersion", version);
    members(header.contains("messageId") ? "messageId" : "messageID", id);
    path_.leave();
    return {version, id};
  }

private:
  /// @returns the member of that name.
  const json& member(const json& from, std::string_view name) const {
    const auto found = from.find(name);
    if (found == from.end())
      throw wrong{fmt::format("{} has no \"{}\"", path_.text(), name)};
    return *found;
  }

  /// Checks that this is an object with no other members than these.
  void check_members(const json& from,
                     std::span<const std::string_view> known) const {
    if (!from.is_object())
      refuse(from, "an object");
    for (const auto& [name, value] : from.items())
      if (std::ranges::find(known, name) == known.end())
        throw wrong{fmt::format("{} has a member \"{}\", {}", path_.text(),
                                name, what_instead(name, known))};
  }

  [[noreturn]] void refuse(const json& found, std::string_view wanted) const {
    constexpr std::size_t longest_quote = 40;
    auto text = found.is_array() ? "an array"
                : found.is_object()
                    ? "an object"
                    : found.dump(-1, ' ', true, json::error_handler_t::replace);
    if (text.size() > longest_quote)
      text = text.substr(0, longest_quote) + "...";
    throw wrong{fmt::format("{} is {}, and {} is expected", path_.text(), text,
                            wanted)};
  }

  struct member_list {
    std::vector<std::string_view> names;
    void operator()(std::string_view name, const auto&) {
      names.push_back(name);
    }
  };

  struct member_reader {
    json_reader& in;
    const json& from;

    template <class T>
    void operator()(std::string_view name, T& x) const {
      if constexpr (is_optional<T>) {
        x.reset();
        if (from.contains(name))
          (*this)(name, x.emplace());
      } else if constexpr (is_defaulted<T>) {
        x = {};
        if (from.contains(name))
          (*this)(name, x.value);
      } else {
        const auto& value = in.member(from, name);
        in.path_.enter(name);
        in.read(value, x);
        in.path_.leave();
      }
    }
  };

  static std::string what_instead(std::string_view word,
                                  std::span<const std::string_view> known) {
    const auto meant = nearest_word(word, known);
    return meant.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                         : fmt::format("did you mean \"{}\"?", meant);
  }

  template <std::int64_t lo, std::int64_t hi, growth g>
  void read_integer(const json& from, integer<lo, hi, g>& x) const {
    using number = typename integer<lo, hi, g>::number;
    constexpr auto may_grow = g == extensible;
    constexpr auto low =
        may_grow ? std::int64_t{std::numeric_limits<std::int32_t>::min()} : lo;
    constexpr auto high =
        may_grow ? std::int64_t{std::numeric_limits<std::int32_t>::max()} : hi;
    if (!is_whole(from, low, high))
      refuse(from, fmt::format("a whole number from {} to {}", low, high));
    x.value = static_cast<number>(from.get<std::int64_t>());
  }

  static bool is_whole(const json& from, std::int64_t low, std::int64_t high) {
    constexpr std::uint64_t most = std::numeric_limits<std::int64_t>::max();
    if (from.is_number_unsigned() && from.get<std::uint64_t>() > most)
      return false;
    return from.is_number_integer() && from.get<std::int64_t>() >= low
           && from.get<std::int64_t>() <= high;
  }

  template <class T>
  void read_enum(const json& from, T& x) const {
    const auto& names = names_of<T>.names;
    constexpr auto count = static_cast<std::int64_t>(names.size());
    if constexpr (names_of<T>.may_grow == extensible)
      if (is_whole(from, count, count + most_unknown)) {
        x = static_cast<T>(from.get<std::int64_t>());
        return;
      }
    if (!from.is_string())
      refuse(from, fmt::format("one of {}", fmt::join(names, ", ")));
    const auto& word = from.get_ref<const std::string&>();
    const auto found = std::ranges::find(names, word);
    if (found == names.end())
      throw wrong{fmt::format("{} is \"{}\", {}", path_.text(), word,
                              what_instead(word, names))};
    x = static_cast<T>(found - names.begin());
  }

  const std::string& read_bits(const json& from, std::size_t least,
                               std::size_t most) const {
    if (from.is_string()) {
      const auto& bits = from.get_ref<const std::string&>();
      if (bits.size() >= least && bits.size() <= most
          && bits.find_first_not_of("01") == bits.npos)
        return bits;
    }
    refuse(from, least == most
                     ? fmt::format("a string of {} zeros and ones", most)
                     : fmt::format("a string of {} to {} zeros and ones", least,
                                   most));
  }

  template <class T>
  void read_list(const json& from, T& xs) {
    if (!from.is_array() || from.size() < T::low || from.size() > T::high)
      refuse(from, fmt::format("a list of {} to {}", T::low, T::high));
    xs.clear();
    xs.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
      path_.enter(i);
      read(from[i], xs[i]);
      path_.leave();
    }
  }

  template <growth g, class... As>
  void read_choice(const json& from, basic_choice<g, As...>& x) {
    using type = basic_choice<g, As...>;
    check_members(from, type::names);
    if (from.size() != 1)
      refuse(from, fmt::format("one of {}", fmt::join(type::names, ", ")));
    const auto name = from.begin().key();
    const auto read_one = [&]<std::size_t i>() {
      if (name != type::names[i])
        return;
      path_.enter(name);
      read(*from.begin(), x.value.template emplace<i>());
      path_.leave();
    };
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (read_one.template operator()<i>(), ...);
    }
    (std::index_sequence_for<As...>{});
  }

  template <class T>
  void read_open(const json& from, T& x) {
    constexpr std::array known{T::id_name, T::value_name};
    check_members(from, known);
    typename T::id_type id;
    const member_reader members{*this, from};
    members(T::id_name, id);
    const auto read_one = [&]<std::size_t i>() {
      if (id.value != T::ids[i])
        return false;
      members(T::value_name, x.value.template emplace<i>());
      return true;
    };
    const auto is_known = [&]<std::size_t... i>(std::index_sequence<i...>) {
      return (read_one.template operator()<i>() || ...);
    }
    (std::make_index_sequence<T::count>{});
    if (!is_known) {
      x.unknown_id = id;
      members(T::value_name, x.value.template emplace<opaque>());
    }
  }

  field_path path_;
};

json parse(std::string_view text) {
  using event = json::parse_event_t;
  return json::parse(text, [](int depth, event what, const json&) {
    const auto opens =
        what == event::array_start || what == event::object_start;
    if (opens && depth >= deepest)
      throw wrong{fmt::format("this is nested deeper than {} levels", deepest)};
    return true;
  });
}

} // namespace

void append_json(std::string& out, const message& m) {
  std::visit([&](const auto& x) { json_writer{out}.write(x); }, m);
}

outcome<message> message_from_json(std::string_view text) {
  try {
    const auto from = parse(text);
    json_reader in;
    const auto [version, id] = in.read_key(from);
    auto made = make_message(version, id);
    if (made.value)
      std::visit([&](auto& x) { in.read(from, x); }, *made.value);
    return made;
  } catch (const wrong& e) {
    return {{}, e.sentence};
  } catch (const json::out_of_range&) {
    return {{}, "this has a number that is too large"};
  } catch (const json::parse_error& e) {
    return {{}, fmt::format("this is no JSON from character {} on", e.byte)};
  }
}

} // namespace sofof::messages::etsi

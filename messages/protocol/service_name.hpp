// The name of a service, short enough to live inside a message.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sofof::messages {

/// At most 31 characters, stored in place: copying one allocates nothing.
class service_name {
public:
  static constexpr std::size_t max_size = 31;

  service_name() = default;

  /// @throws std::invalid_argument when `name` is longer than `max_size`.
  explicit(false) service_name(std::string_view name) {
    if (name.size() > max_size)
      throw std::invalid_argument("a service's name has at most 31 characters");
    std::copy(name.begin(), name.end(), text_.begin());
  }
  explicit(false) service_name(const char* name)
      : service_name{std::string_view{name}} {}

  std::string_view view() const { return text_.data(); }

  friend bool operator==(const service_name& a, const service_name& b) {
    return std::memcmp(a.text_.data(), b.text_.data(), sizeof(text_)) == 0;
  }
  friend std::strong_ordering operator<=>(const service_name& a,
                                          const service_name& b) {
    return std::memcmp(a.text_.data(), b.text_.data(), sizeof(text_)) <=> 0;
  }

  template <class Inspector>
  friend bool inspect(Inspector& f, service_name& x) {
    auto get = [&x] { return std::string{x.view()}; };
    auto set = [&x](const std::string& text) {
      if (text.size() > max_size || text.find('\0') != text.npos)
        return false;
      x = service_name{text};
      return true;
    };
    return f.apply(get, set);
  }

private:
  std::array<char, max_size + 1> text_{};
};

} // namespace sofof::messages

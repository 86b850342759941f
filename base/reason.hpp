// Why something was decided so.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>

namespace sofof {

/// A few words, and the number that decided beside its limit, where one did.
class reason {
public:
  constexpr reason() = default;
  /// @param words  A literal, or what lives as long.
  constexpr reason(std::string_view words) : words_{words} {}
  constexpr reason(const char* words) : words_{words} {}
  reason(const std::string&) = delete;
  /// @param value  What was found.
  /// @param unit   Of both numbers: "m", "s"; a literal; empty for none.
  constexpr reason(std::string_view words, double value, double limit,
                   std::string_view unit = {})
      : words_{words}, found_{{value, limit, unit}} {}

  constexpr bool empty() const { return words_.empty(); }

  /// @returns as records have it: "no room value=0.9 limit=0.8", or
  /// "t_in_area < t_min value_s=3.2 limit_s=5".
  std::string text() const {
    if (!found_)
      return std::string{words_};
    const auto& [value, limit, unit] = *found_;
    const auto of = unit.empty() ? "" : "_";
    return fmt::format("{}{}{}{}={:.6g} limit{}{}={:.6g}", words_, value_mark,
                       of, unit, value, of, unit, limit);
  }

  /// @param text  Of any reason.
  /// @returns its words alone, by which reasons are counted.
  static constexpr std::string_view words_of(std::string_view text) {
    return text.substr(0, text.find(value_mark));
  }

  /// Reasons are the same by their words.
  friend constexpr bool operator==(const reason& a, const reason& b) {
    return a.words_ == b.words_;
  }

private:
  struct comparison {
    double value;
    double limit;
    std::string_view unit;
  };

  static constexpr std::string_view value_mark = " value";

  std::string_view words_;
  std::optional<comparison> found_;
};

} // namespace sofof

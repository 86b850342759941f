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
  /// @param words  A short literal.
  constexpr reason(std::string_view words) : words_{words} {}
  constexpr reason(const char* words) : words_{words} {}
  /// @param value  What was found, in the unit of the limit.
  constexpr reason(std::string_view words, double value, double limit)
      : words_{words}, found_{{value, limit}} {}

  constexpr bool empty() const { return words_.empty(); }

  /// @returns as records have it: "no room value=0.900 limit=0.800".
  std::string told() const {
    return found_ ? fmt::format("{}{}{:.3f} limit={:.3f}", words_, number,
                                found_->value, found_->limit)
                  : std::string{words_};
  }

  /// @param told  By any reason.
  /// @returns its words alone, by which reasons are counted.
  static constexpr std::string_view words_of(std::string_view told) {
    return told.substr(0, told.find(number));
  }

  /// Reasons are the same by their words.
  friend constexpr bool operator==(const reason& a, const reason& b) {
    return a.words_ == b.words_;
  }

private:
  struct comparison {
    double value;
    double limit;
  };

  static constexpr std::string_view number = " value=";

  std::string_view words_;
  std::optional<comparison> found_;
};

} // namespace sofof

// Doubt that is an objection only when it lasts.
#pragma once

#include "base/objection.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

namespace sofof::planners {

/// Sensors err, messages come late, and what was there a moment ago is told a
/// moment longer: one doubtful result means nothing. The time of those adds up,
/// and the time of the others takes half as much off, so that whoever is honest
/// for most of the time goes on being believed, and who changes from one lie to
/// the next does not.
class lasting_doubt {
public:
  /// @param limit_s  So much time of doubt is an objection.
  explicit lasting_doubt(double limit_s) : limit_s_{limit_s} {}

  /// Another result has been looked at.
  /// @param check     The one that it failed; empty: none.
  /// @param passed_s  Since the result before, >= 0.
  /// @returns an objection that names the check, once doubt has lasted.
  std::optional<objection> add(std::string_view check, double passed_s) {
    if (check.empty()) {
      sum_s_ = std::max(0.0, sum_s_ - passed_s / 2);
      return std::nullopt;
    }
    sum_s_ += passed_s;
    if (sum_s_ < limit_s_)
      return std::nullopt;
    return objection{check, sum_s_, limit_s_};
  }

  /// @returns how much more doubt would be too much, s.
  double left_s() const { return limit_s_ - sum_s_; }

private:
  double limit_s_;
  double sum_s_ = 0;
};

} // namespace sofof::planners

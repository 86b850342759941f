// Tells of refusals, but not of each: one sentence a second at most.
#pragma once

#include "network/deadline.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace sofof {

class refusal_log {
public:
  using teller = std::function<void(const std::string&)>;

  /// @param tell  Gets the sentences; may be empty.
  explicit refusal_log(teller tell) : tell_{std::move(tell)} {}

  /// Somebody was refused.
  /// @param sentence  Who and why.
  void add(const std::string& sentence, deadline now);

  /// Tells of those that were left out, once a second is over.
  void look_at(deadline now);

  /// @returns when `look_at` has something to tell; nullopt: never.
  std::optional<deadline> next() const;

private:
  teller tell_;
  std::optional<deadline> last_told_;
  std::string last_;
  std::uint64_t left_out_ = 0;
};

} // namespace sofof

// Publishes refusals, but not each: one sentence a second at most.
#pragma once

#include "network/deadline.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace sofof::network {

/// A crowd that is refused fills no journal: the first sentence is published at
/// once, the last of each second with how many were left out.
class refusal_log {
public:
  using publisher = std::function<void(const std::string&)>;

  /// @param publish  Gets the sentences; may be empty.
  explicit refusal_log(publisher publish) : publish_{std::move(publish)} {}

  /// A peer was refused.
  /// @param sentence  Who and why.
  void add(const std::string& sentence, deadline now);

  /// Publishes those that were left out, once a second is over.
  void publish_rest(deadline now);

  /// @returns when `publish_rest` has something to do; nullopt: never.
  std::optional<deadline> next() const;

private:
  publisher publish_;
  std::optional<deadline> last_published_;
  std::string last_;
  std::uint64_t left_out_ = 0;
};

} // namespace sofof::network

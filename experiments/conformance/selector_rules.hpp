// The rules that the source selector of a vehicle's service keeps, as seen in
// its own steps.
#pragma once

#include "experiments/conformance/duties.hpp"
#include "messages/protocol/trace.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace sofof::experiments::conformance {

/// Follows one selector from its first step on. Rules: docs/trace.md, S1 ff.
class selector_rules {
public:
  selector_rules(duration slack, breach_sink found)
      : slack_{slack}, found_{found}, duties_{slack, std::move(found)} {}

  /// @param x  The next step of this selector; about one session, or the own
  ///           function (counter 0).
  void add(const messages::trace_record& x, trace_place at);

private:
  using step = messages::trace_record;
  /// A provider, and the counter of the session there.
  using key = std::pair<provider_id, std::uint32_t>;

  struct session {
    bool in_use = false;
    std::optional<std::uint64_t> last_cycle;  // that was used
    std::optional<time_point> used, left_out; // the latest result that was
  };

  void on_begun(const step& x);
  void on_first_data(const step& x);
  void on_used(const step& x);
  void on_left_out(const step& x);
  void on_called(const step& x);
  void on_watched(const step& x);
  void on_source(const step& x);
  void on_end(const step& x);

  void judge_reason(const session& ended, const step& x);
  session* find(const step& x);
  std::ptrdiff_t in_use() const;
  void refute(rule broken, std::string what);

  duration slack_;
  breach_sink found_;
  duties duties_;
  std::map<key, session> sessions_;
  bool is_remote_ = false; // its source
  std::optional<key> watched_;
  /// When the latest result of the watched session was left out, if no result
  /// has been used since.
  std::optional<time_point> useless_;
  provider_id standby_ = 0;
  trace_place at_; // of the step that is followed
};

} // namespace sofof::experiments::conformance

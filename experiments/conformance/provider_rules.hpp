// The rules that a provider keeps, as seen in its own steps.
#pragma once

#include "experiments/conformance/duties.hpp"
#include "experiments/conformance/names.hpp"
#include "messages/protocol/trace.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace sofof::experiments::conformance {

/// Follows one provider from its first step on. Rules: docs/trace.md, P1 ff.
class provider_rules {
public:
  provider_rules(duration slack, breach_sink found)
      : slack_{slack}, found_{found}, duties_{slack, std::move(found)} {}

  /// @param x  The next step of this provider.
  void add(const messages::trace_record& x, trace_place at);

  /// There are no more steps.
  void finish();

private:
  using step = messages::trace_record;
  using service = messages::service_name;

  struct session {
    std::uint32_t counter = 0;
    bool was_inside = false;
    bool untold = false; // the vehicle was the one to end it
    reasons may_end;
  };

  struct station {
    bool is_known = false;
    std::uint64_t requester = 0;
    time_point heard;
    bool is_inside = false;
    std::optional<time_point> offered;
    bool may_offer = false; // though it was offered something just before
    std::uint64_t last_request = 0;
    std::map<std::uint64_t, std::set<service>> open; // requests
    std::map<service, session> sessions;
    std::optional<time_point> digest_due;
    time_point told_until = time_point::min();
    reasons may_go;
  };

  void on_heard(station& of, const step& x);
  void on_met(station& of, const step& x);
  void on_offer(station& of, const step& x);
  void on_request(station& of, const step& x);
  void on_response(station& of, const step& x);
  void on_begun(station& of, const step& x);
  void on_digest(station& of, const step& x);
  void on_end_sent(station& of, const step& x);
  void on_closed(station& of, const step& x);
  void on_forgotten(station& of, const step& x);
  void on_lost(const step& x);
  void on_shut_down(const step& x);

  static session* find(station& of, const step& x);
  void must_close(const step& x, const service& name, session& what,
                  std::string_view reason, bool untold = false);
  void judge_reason(const station& of, const session& known, const step& x);
  void drop_requests(station_id id, station& of);
  void await_digest(station& of, const step& x);
  void refute(rule broken, std::string what);

  duration slack_;
  breach_sink found_;
  duties duties_;
  std::map<station_id, station> stations_;
  std::uint32_t last_counter_ = 0;
  bool has_ended_ = false;
  trace_place at_; // of the step that is followed
};

} // namespace sofof::experiments::conformance

// The rules that a vehicle's requester keeps, as seen in its own steps.
#pragma once

#include "experiments/conformance/duties.hpp"
#include "experiments/conformance/names.hpp"
#include "messages/protocol/trace.hpp"

#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace sofof::experiments::conformance {

/// Follows one requester from its first step on. Rules: docs/trace.md, V1 ff.
class requester_rules {
public:
  requester_rules(duration slack, breach_sink found)
      : slack_{slack}, found_{found}, duties_{slack, std::move(found)} {}

  /// @param x  The next step of this requester.
  void add(const messages::trace_record& x, trace_place at);

  /// There are no more steps.
  void finish();

private:
  using step = messages::trace_record;
  using service = messages::service_name;

  /// A session that has begun.
  struct session {
    std::uint32_t counter = 0;
    time_point begun;
    time_point confirmed;   // by its beginning, or a digest
    bool is_remote = false; // its results have come
    std::optional<time_point> unnamed_since{};
    bool untold = false; // its end needs not be told to the provider
    reasons may_end;
  };

  struct provider {
    std::optional<std::uint64_t> peer; // that speaks for it, while it is known
    std::map<service, time_point> offered; // and not asked for since
    std::optional<std::uint64_t> open_request;
    time_point asked;
    std::set<service> requested;
    std::uint32_t last_counter = 0;
    std::map<service, std::uint32_t> accepted; // by the latest answer
    std::optional<time_point> complained, corrected;
    std::map<service, session> sessions;
    std::map<service, time_point> cools_until;
    bool is_lost = false; // and has offered nothing since
  };

  void on_met(const step& x);
  void on_forgotten(const step& x);
  void on_offer(const step& x);
  void on_request(const step& x);
  void judge_others(const step& x, const service& name);
  void on_request_over(const step& x);
  void on_response(const step& x);
  void on_begun(const step& x);
  void on_first_data(const step& x);
  void on_digest(const step& x);
  void judge_unnamed(provider& from, const step& x);
  void on_unknown_result(const step& x);
  void on_violation(const step& x);
  void on_end_got(const step& x);
  void on_end_sent(const step& x);
  void on_closed(const step& x);
  void on_lost(const step& x);
  void on_shut_down(const step& x);

  session* find(const step& x);
  void must_close(const step& x, const messages::traced_service& what,
                  session& known, std::initializer_list<std::string_view> why);
  bool may_close(const step& x, const session& known) const;
  void must_end(const step& x, const messages::traced_service& what,
                rule owed_by);
  void refute(rule broken, std::string what);

  duration slack_;
  breach_sink found_;
  duties duties_;
  std::map<provider_id, provider> providers_;
  std::set<service> own_; // of which it has asked for
  std::uint64_t last_request_ = 0;
  bool has_ended_ = false;
  trace_place at_; // of the step that is followed
};

} // namespace sofof::experiments::conformance

// Traces that tests write step by step, to see which rules they break.
#pragma once

#include "experiments/conformance/trace_checker.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sofof::test::traces {

using namespace messages;
using namespace experiments::conformance;
using namespace std::chrono_literals;
using enum trace_step;

inline constexpr provider_id server = 3;
inline constexpr station_id car = 101;
inline const std::vector<traced_service> none{};
inline const std::vector<traced_service> plan{{"plan", 0}};
inline const std::vector<traced_service> session{{"plan", 7}};
inline const std::vector<traced_service> first_session{{"plan", 1}};

/// A trace that is written step by step.
struct traced {
  trace_checker checker{duration{0}};
  time_point now{1s};
  std::map<trace_part, std::uint64_t> last;

  void pass(duration d) { now += d; }

  traced& add(trace_part by, trace_step what,
              std::vector<traced_service> services = session,
              std::string detail = {}, std::uint64_t number = 1) {
    checker.add({.at = now,
                 .by = by,
                 .step = ++last[by],
                 .what = what,
                 .provider = server,
                 .station = car,
                 .number = number,
                 .services = std::move(services),
                 .detail = std::move(detail)},
                {0, checker.steps() + 1});
    return *this;
  }
  traced& vehicle(trace_step what,
                  std::vector<traced_service> services = session,
                  std::string detail = {}, std::uint64_t number = 1) {
    return add(trace_part::requester, what, std::move(services),
               std::move(detail), number);
  }
  traced& provider(trace_step what,
                   std::vector<traced_service> services = first_session,
                   std::string detail = {}, std::uint64_t number = 1) {
    return add(trace_part::provider, what, std::move(services),
               std::move(detail), number);
  }
  traced& selector(trace_step what,
                   std::vector<traced_service> services = session,
                   std::uint64_t number = 1, std::string detail = {}) {
    return add(trace_part::selector, what, std::move(services),
               std::move(detail), number);
  }
  /// It ends, for that reason, and the own function goes on.
  void come_home(const char* reason) {
    selector(end_got, session, 0, reason);
    selector(unwatched);
    selector(source, plan);
  }

  /// @returns the names of the rules that were broken ("V9").
  std::vector<std::string> broken() {
    std::vector<std::string> all;
    for (const auto& x : checker.finish())
      all.push_back(std::string{x.broken.id});
    return all;
  }
};

using rules = std::vector<std::string>;

/// The vehicle's session 7 has begun.
struct running_vehicle : traced {
  running_vehicle() {
    vehicle(offer_got, plan);
    vehicle(request_sent, plan);
    pass(20ms);
    vehicle(response_got, session);
    vehicle(begun);
    pass(50ms);
  }
};

/// The provider's session 1 has begun.
struct running_provider : traced {
  running_provider() {
    provider(heard, none, "inside");
    provider(met, none);
    provider(offer_sent, plan);
    provider(request_got, plan);
    provider(begun, first_session, "inside");
    provider(response_sent);
  }
};

/// Results of session 7 are in use.
struct running_selector : traced {
  running_selector() {
    selector(used, plan);
    selector(begun);
    pass(100ms);
    selector(first_data);
    selector(watched);
    selector(source);
    selector(used);
    pass(100ms);
  }
};

} // namespace sofof::test::traces

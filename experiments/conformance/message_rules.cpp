// Messages and sessions by name.
#include "experiments/conformance/message_rules.hpp"

#include "experiments/conformance/names.hpp"

#include <algorithm>
#include <utility>

namespace sofof::experiments::conformance {

namespace {

using messages::trace_part;
using messages::trace_record;
using messages::trace_step;

/// A step that one side takes because of a step of the other.
struct pair_of_steps {
  trace_part sender;
  trace_step sent;
  trace_step got;
  std::string_view what;
};

constexpr pair_of_steps pairs[]{
    {trace_part::provider, trace_step::offer_sent, trace_step::offer_got,
     "offer"},
    {trace_part::requester, trace_step::request_sent, trace_step::request_got,
     "request"},
    {trace_part::provider, trace_step::response_sent, trace_step::response_got,
     "response"},
    {trace_part::provider, trace_step::digest_sent, trace_step::digest_got,
     "digest"},
    {trace_part::provider, trace_step::end_sent, trace_step::end_got,
     "service_end"},
    {trace_part::requester, trace_step::end_sent, trace_step::end_got,
     "service_end"},
    {trace_part::provider, trace_step::begun, trace_step::begun, "session"},
};

/// @returns a name that all messages of the same content have.
std::string named(const pair_of_steps& kind, const trace_record& x) {
  auto text =
      fmt::format("{} of {} {}, station {}, number {}, {}", kind.what,
                  messages::name_of(kind.sender), x.provider, x.station,
                  x.number, kind.sent == trace_step::begun ? "" : x.detail);
  for (const auto& [service, counter] : x.services)
    text += fmt::format(" {}#{}", service.view(), counter);
  return text;
}

bool is_refusal(const trace_record& x) {
  return x.what == trace_step::response_got
         && std::ranges::all_of(x.services,
                                [](const auto& s) { return s.counter == 0; });
}

} // namespace

void message_rules::add(const trace_record& x, trace_place at) {
  if (x.by == trace_part::selector)
    return;
  if (x.by == trace_part::provider)
    providers_.insert(x.provider);
  else
    requesters_.insert(x.station);
  for (const auto& kind : pairs) {
    const auto by_sender = x.by == kind.sender;
    if (by_sender && x.what == kind.sent)
      sent_.insert(named(kind, x));
    else if (!by_sender && x.what == kind.got)
      got_.try_emplace(named(kind, x),
                       got{at, kind.sender == trace_part::provider, x.provider,
                           x.station, is_refusal(x) ? x.number : 0});
  }
  if (x.what == trace_step::request_got)
    asked_.emplace(x.provider, x.station, x.number);
}

// A provider that has started again refuses in the name that it had before,
// which never got that request.
void message_rules::finish() {
  const auto may_be_unsent = [this](const got& x) {
    return x.refused != 0
           && !asked_.contains({x.provider, x.station, x.refused});
  };
  for (const auto& [what, x] : got_) {
    const auto sender_is_traced = x.from_provider
                                      ? providers_.contains(x.provider)
                                      : requesters_.contains(x.station);
    if (sender_is_traced && !sent_.contains(what) && !may_be_unsent(x))
      found_({rule_of("M1"), what, x.at});
  }
}

} // namespace sofof::experiments::conformance

// The rules of the protocol, in the words of docs/trace.md.
#pragma once

#include <algorithm>
#include <iterator>
#include <string_view>

namespace sofof::experiments::conformance {

/// What each part does, or what holds between them. V: a vehicle's requester,
/// S: a source selector, P: a provider, M: between the parts, C: between the
/// services of a chain.
struct rule {
  std::string_view id;
  std::string_view sentence; ///< Without its full stop.
};

/// In the page's order.
inline constexpr rule all_rules[]{
    {"V1", "Request numbers rise by one"},
    {"V2", "At most one request to a provider is open"},
    {"V3", "Only what is offered, for at most 2.5 s, and does not run there is "
           "asked for"},
    {"V4", "A request is answered, or is over after 500 ms, not earlier"},
    {"V5", "After an end by a fault a provider is not asked for that service "
           "for 1 s"},
    {"V6", "An acceptance that comes too late is answered with `service_end`, "
           "unless its provider was lost meanwhile"},
    {"V7", "A session gives first data within 1 s, or is closed"},
    {"V8", "At a violation, an end, a lost peer, or a second digest without "
           "it, a session is closed in the same instant"},
    {"V9", "The provider is told of a session that the vehicle closes"},
    {"V10", "Results of no session are answered with `service_end`, every "
            "200 ms at most"},
    {"V11", "A session that only a digest has is answered with `service_end`, "
            "too, unless a request is open"},
    {"V12", "A session begins with an acceptance that was asked for, and not "
            "beside another one of that service there"},
    {"V13", "Counters of a provider's sessions rise"},
    {"V14", "First data come once, of a session that has begun"},
    {"V15", "Results of a session that runs are not refused as those of none"},
    {"V16", "What runs is closed before its provider is told to end it"},
    {"V17", "A session is closed once"},
    {"V18", "A provider at which nothing runs is forgotten when its peer "
            "speaks for another one, and only then"},
    {"V19", "While a service moves, as a request for it is open or its session "
            "has not given data yet, no other provider is asked for it later"},
    {"V20",
     "A session is closed for a reason that this instant or a time gives"},

    {"S1", "Results come from the source that was announced, and from no "
           "other"},
    {"S2", "When the last provider's session ends, the own function goes on in "
           "the same instant"},
    {"S3", "While results of a provider are used, the watchdog watches by the "
           "name of one that is in use"},
    {"S4", "Only results of sessions that run are used"},
    {"S5", "A session begins once"},
    {"S6", "Results of one session are used in the order of their cycles"},
    {"S7", "A session ends as `implausible` if its latest result was left out, "
           "at once if that was refused, else instead of for a gap; no other "
           "one does"},
    {"S8", "Only a provider that stands by is called, and beside another one "
           "whose results are in use"},

    {"P1", "Only stations that are heard are spoken to"},
    {"P2", "A station gets one offer a second, but when it comes into the area "
           "or has a new requester"},
    {"P3", "What runs for a station is not offered to it"},
    {"P4",
     "A request is answered once, within 500 ms unless its station asks "
     "anew, has a new requester or is forgotten meanwhile, and not at all "
     "if its number is not above the last one's"},
    {"P5", "What is accepted runs, and is answered in the same instant"},
    {"P6", "A session begins with a request, and not beside another one of "
           "that station and service"},
    {"P7", "Counters rise by one"},
    {"P8", "At an end of the vehicle, a lost function, a CAM from outside, a "
           "new requester or silence, a session is closed in the same "
           "instant"},
    {"P9", "The vehicle is told of a session that the provider closes"},
    {"P10", "While something runs, and for 2 s longer, a digest comes every "
            "500 ms"},
    {"P11", "A digest names what runs, and the latest counter"},
    {"P12", "A station is forgotten when it has been silent for more than 2 s, "
            "not earlier"},
    {"P13", "What runs is closed before its vehicle is told"},
    {"P14", "A session is closed once"},
    {"P15", "A station inside the area has not left it"},
    {"P16", "A station whose requester is lost is forgotten in the same "
            "instant"},
    {"P17", "A session is closed, and a station forgotten, for a reason that "
            "this instant or a time gives"},

    {"M1", "What is got has been sent, and a session that runs in the vehicle "
           "has begun at its provider, if the other side's steps are there"},
    {"M2", "No step of a part is missing"},
    {"M3", "A selector begins, ends and lets stand by what its requester does, "
           "and nothing else"},

    {"C1", "Each input of a service that follows another one comes with a "
           "result of that one that is used, in the same instant"},
    {"C2", "Each used result of a service makes one input of the one that "
           "follows it, in the same instant"},
    {"C3", "No result of a service that follows another one is used before "
           "its first input"},
    {"C4",
     "A session that ends by a violation has none of another service of "
     "the chain released in the same instant, unless that one is violated, "
     "too"},
};

/// @param id  Of a rule that there is, or this does not compile.
consteval rule rule_of(std::string_view id) {
  return *std::ranges::find(all_rules, id, &rule::id);
}

} // namespace sofof::experiments::conformance

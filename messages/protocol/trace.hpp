// What each part of the offloading protocol got, sent and did:
// protocol_trace.csv.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"
#include "messages/protocol/service_name.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::messages {

/// Whose steps they are; each has an order of its own.
enum class trace_part : std::uint8_t {
  requester, ///< Of a vehicle.
  selector,  ///< Of a vehicle's service.
  provider,
};

/// When each is made, and what it tells besides: docs/trace.md.
enum class trace_step : std::uint8_t {
  offer_sent,
  offer_got,
  request_sent,
  request_got,
  request_over, ///< No answer has come.
  response_sent,
  response_got,
  digest_sent,
  digest_got,
  end_sent,
  end_got,
  heard,     ///< A CAM, of a station that is known from then on.
  met,       ///< A station has a new requester; a provider is known.
  forgotten, ///< A station, or a provider, is known no longer.
  peer_lost,
  result_refused, ///< Of no session.
  begun,          ///< A session, with acceptance.
  first_data,     ///< Its first result is in use.
  violation,
  closed, ///< A session, for a reason.
  function_lost,
  asked,     ///< An input of the client has come.
  used,      ///< A result has reached the client.
  left_out,  ///< A result has not, by its judge.
  standby,   ///< From now on this provider stands by, of several.
  called,    ///< Who stands by has been asked for a cycle.
  watched,   ///< The watchdog watches by this session's name, ...
  unwatched, ///< ... or no longer.
  source,    ///< From now on results come from here.
  shut_down,
};

inline constexpr std::array trace_part_names{std::string_view{"requester"},
                                             std::string_view{"selector"},
                                             std::string_view{"provider"}};

inline constexpr std::array trace_step_names{
    std::string_view{"offer_sent"},    std::string_view{"offer_got"},
    std::string_view{"request_sent"},  std::string_view{"request_got"},
    std::string_view{"request_over"},  std::string_view{"response_sent"},
    std::string_view{"response_got"},  std::string_view{"digest_sent"},
    std::string_view{"digest_got"},    std::string_view{"end_sent"},
    std::string_view{"end_got"},       std::string_view{"heard"},
    std::string_view{"met"},           std::string_view{"forgotten"},
    std::string_view{"peer_lost"},     std::string_view{"result_refused"},
    std::string_view{"begun"},         std::string_view{"first_data"},
    std::string_view{"violation"},     std::string_view{"closed"},
    std::string_view{"function_lost"}, std::string_view{"asked"},
    std::string_view{"used"},          std::string_view{"left_out"},
    std::string_view{"standby"},       std::string_view{"called"},
    std::string_view{"watched"},       std::string_view{"unwatched"},
    std::string_view{"source"},        std::string_view{"shut_down"}};

static_assert(trace_part_names.size()
              == static_cast<std::size_t>(trace_part::provider) + 1);
static_assert(trace_step_names.size()
              == static_cast<std::size_t>(trace_step::shut_down) + 1);

constexpr std::string_view name_of(trace_part x) {
  return trace_part_names.at(static_cast<std::size_t>(x));
}
constexpr std::string_view name_of(trace_step x) {
  return trace_step_names.at(static_cast<std::size_t>(x));
}

/// A service, and its session if there is one.
struct traced_service {
  service_name name;
  std::uint32_t counter = 0; ///< 0: none; as an answer: refused.
  friend auto operator<=>(const traced_service&,
                          const traced_service&) = default;
};

/// One step of one part.
struct trace_record {
  time_point at;
  trace_part by{};
  std::uint64_t step = 0; ///< From 1 on, without a gap, for each part.
  trace_step what{};
  provider_id provider = 0; ///< 0: concerns none.
  station_id station = 0;   ///< 0: likewise.
  /// Of a request and its answer; of a digest its last counter; of a result
  /// its cycle; of `met`, a vehicle's `forgotten` and a provider's `peer_lost`
  /// the peer; of `standby` how long an answer is waited for, ns.
  std::uint64_t number = 0;
  std::vector<traced_service> services{};
  std::string detail{}; ///< Of `closed` and `end_*` the reason.
};

} // namespace sofof::messages

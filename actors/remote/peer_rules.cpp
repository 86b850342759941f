// What a provider hears of a peer that has been let in.
#include "actors/remote/peer_rules.hpp"

#include "base/protocol.hpp"

namespace sofof::actors {

namespace {

constexpr double messages_per_station_s = 100;
/// What a peer may send beyond that: acknowledgements for each of its stations,
/// pings and pongs.
constexpr double acknowledgements_per_station_s = 100;
constexpr double pings_s = 200;
constexpr double burst_s = 2;

constexpr std::size_t longest_route = 1000;
constexpr std::size_t most_services = 64;

/// @returns a full bucket.
network::token_bucket two_seconds_of(double per_second) {
  return {per_second, burst_s * per_second};
}

double messages_s(std::size_t stations) {
  return pings_s
         + (messages_per_station_s + acknowledgements_per_station_s)
               * static_cast<double>(stations);
}

} // namespace

peer_rules::peer_rules(const std::set<station_id>& stations)
    : all_{two_seconds_of(messages_s(stations.size()))} {
  for (const auto station : stations)
    by_station_.try_emplace(station, two_seconds_of(messages_per_station_s));
}

std::string_view peer_rules::objection_to_message(time_point now) {
  return all_.try_spend(now) ? "" : "the peer says too much";
}

std::string_view peer_rules::objection_to_sender(station_id station) const {
  return by_station_.contains(station) ? "" : "speaks for another station";
}

std::string_view peer_rules::objection_to(station_id station,
                                          const messages::its_pdu& message,
                                          time_point now) {
  if (const auto why = objection_to_rate(station, now); !why.empty())
    return why;
  return message.station() == station ? ""
                                      : "carries another station's message";
}

std::string_view peer_rules::objection_to(const messages::service_input& input,
                                          time_point now) {
  return objection_to_rate(input.session.station, now);
}

std::string_view
peer_rules::objection_to(const messages::service_request& request) {
  const auto is_small =
      request.route.size() <= longest_route
      && request.services.size() <= most_services
      && request.candidates.size() <= protocol::most_candidates;
  return is_small ? "" : "asks for too much";
}

std::string_view peer_rules::objection_to_rate(station_id station,
                                               time_point now) {
  return by_station_.at(station).try_spend(now) ? "" : "says too much";
}

} // namespace sofof::actors

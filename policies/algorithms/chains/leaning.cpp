// Links that lean on others, found by station and name.
#include "policies/algorithms/chains/leaning.hpp"

#include <algorithm>
#include <cassert>
#include <span>

namespace sofof::policies {

namespace {

template <class View>
std::optional<std::size_t> place_of(std::span<const View> all,
                                    station_id station,
                                    std::string_view service) {
  const auto i = std::ranges::find_if(all, [&](const View& x) {
    return x.station == station && x.service == service;
  });
  if (i == all.end())
    return std::nullopt;
  return static_cast<std::size_t>(i - all.begin());
}

} // namespace

leaning_list leaning_of(const central_context& context) {
  leaning_list all;
  const auto requests = context.requests.size();
  const auto running = [&](const auto& view) {
    auto found =
        place_of(context.sessions, view.station, view.links.follows.service);
    if (found)
      *found += requests;
    return found;
  };
  for (const auto& request : context.requests) {
    const auto& [service, at] = request.links.follows;
    all.push_back(at == link_place::asked
                      ? place_of(context.requests, request.station, service)
                  : at == link_place::here ? running(request)
                                           : std::nullopt);
  }
  for (const auto& session : context.sessions)
    all.push_back(session.links.follows.at == link_place::here
                      ? running(session)
                      : std::nullopt);
  assert(all.size() == requests + context.sessions.size());
  return all;
}

} // namespace sofof::policies

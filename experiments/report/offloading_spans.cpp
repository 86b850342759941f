// From events.jsonl, or from a provider's episodes.
#include "experiments/report/offloading_spans.hpp"

#include "messages/protocol/event_type.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace sofof::experiments::report {

namespace {

std::vector<offloading_span> switched(std::span<const event_line> events,
                                      double end_s) {
  std::vector<offloading_span> all;
  std::map<std::pair<std::uint64_t, std::string>, std::size_t> open;
  for (const auto& event : events) {
    if (event.what != messages::name_of(messages::event_type::switched))
      continue;
    const std::pair key{event.of.station, event.of.service};
    if (const auto found = open.find(key); found != open.end()) {
      all[found->second].until_s = event.t_s;
      open.erase(found);
    }
    if (event.detail == "remote") {
      open[key] = all.size();
      all.push_back({event.of, event.t_s, end_s});
    }
  }
  return all;
}

std::vector<offloading_span> served(std::span<const episode_line> episodes) {
  std::vector<offloading_span> all;
  for (const auto& one : episodes)
    if (!one.by_requester)
      all.push_back({one.of, one.accepted_s, one.ended_s});
  return all;
}

} // namespace

std::vector<offloading_span> offloadings_of(const recorded_run& run,
                                            std::span<const event_line> events,
                                            double end_s) {
  auto all = switched(events, end_s);
  return all.empty() ? served(run.episodes) : all;
}

} // namespace sofof::experiments::report

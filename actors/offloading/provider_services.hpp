// What a provider's services are made of: contexts, functions, computing times.
#pragma once

#include "actors/offloading/service_provider.hpp"
#include "network/flow/token_bucket.hpp"
#include "offloading/provider.hpp"
#include "offloading/service_cycle.hpp"

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace sofof {

/// Makes what services of a provider run by, from their types.
class provider_services {
public:
  /// @param clock  Of the provider's actor.
  provider_services(const provider_setup& setup,
                    std::function<time_point()> clock);

  /// @returns what the rules of the provider have to know of each.
  std::vector<offloading::offered_service> offered() const;

  /// @returns the function of a session that starts, and when it runs.
  offloading::cycle_setup make(const offloading::session_start& start) const;

  /// Calls `tell` with each context.
  /// @returns what is to be recorded of the stations that are doubted or
  /// believed again since; a limited number, however many are made up.
  template <class Function>
  std::vector<event_record> tell_contexts(Function tell) {
    std::vector<event_record> news;
    for (const auto& context : contexts_)
      if (context) {
        tell(*context);
        for (const auto& doubt : context->news())
          if (doubts_.try_spend(clock_()))
            news.push_back(record_of(doubt));
      }
    return news;
  }

private:
  service_setup setup_of(std::size_t service, station_id station,
                         random_stream noise) const;
  std::function<time_point(time_point, std::uint64_t)>
  computing_time(const service_type& type, station_id station) const;
  event_record record_of(const station_doubt& doubt) const;

  provider_id id_;
  point position_;
  streets_ptr world_;
  georeference_ptr where_;
  std::vector<service_type_ptr> types_;
  std::vector<std::shared_ptr<provider_context>> contexts_; // of each, or null
  std::shared_ptr<const channel_profile> profile_;
  std::shared_ptr<multi_server_queue> workers_;
  random_stream seed_;
  std::uint32_t number_;
  bool virtual_time_;
  bool crossings_granted_;
  std::function<time_point()> clock_;
  token_bucket doubts_;
};

/// @returns what the rules of a provider are made of.
offloading::provider_setup rules_of(provider_setup setup,
                                    const provider_services& services);

} // namespace sofof

// What a provider's services are made of: contexts, functions, computing times.
#pragma once

#include "actors/offloading/broadcast_listener.hpp"
#include "actors/offloading/service_provider.hpp"
#include "channel/shared_server_queue.hpp"
#include "channel/vehicle_place.hpp"
#include "network/flow/token_bucket.hpp"
#include "offloading/provider.hpp"
#include "offloading/service_cycle.hpp"

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace sofof::actors {

/// The services of one provider, and what their sessions run by.
class provider_services {
public:
  /// @param clock  Of the provider's actor.
  provider_services(const provider_actor_setup& setup,
                    std::function<time_point()> clock);

  /// The provider rides with a vehicle, which is here now.
  void ride(point to) { place_->tell(to); }

  /// Each of them as it is here.
  const std::vector<offloading::offered_service>& offered() const {
    return services_;
  }

  /// @returns the function of a session that starts, and when it runs.
  offloading::cycle_setup make(const offloading::session_start& start) const;

  /// Calls `tell` with each listener of a service.
  /// @returns what is to be recorded of the stations that are doubted or
  /// believed again since; a limited number, however many are made up.
  template <class Function>
  std::vector<messages::event_record> tell_listeners(Function tell) {
    std::vector<messages::event_record> records;
    for (auto* listener : listeners_) {
      tell(*listener);
      for (const auto& doubt : listener->take_doubts())
        if (doubts_.try_spend(clock_()))
          records.push_back(record_of(doubt));
    }
    return records;
  }

private:
  std::function<offloading::cycle_work(time_point, std::uint64_t)>
  computing_time(const offloading::offered_service& service,
                 std::shared_ptr<const offloading::service_function> function,
                 station_id station) const;
  messages::event_record record_of(const planners::station_doubt& doubt) const;

  provider_id id_;
  std::shared_ptr<channel::vehicle_place> place_; // of one that rides
  std::vector<offloading::offered_service> services_;
  std::vector<broadcast_listener*> listeners_; // of some of them
  channel::provider_compute compute_;
  std::shared_ptr<channel::load_meter> load_;
  std::shared_ptr<channel::shared_server_queue> workers_;
  random_stream seed_;
  std::uint32_t number_;
  bool virtual_time_;
  std::function<time_point()> clock_;
  network::token_bucket doubts_;
};

/// @returns what the rules of a provider are made of.
offloading::provider_setup rules_of(provider_actor_setup setup,
                                    const provider_services& services);

} // namespace sofof::actors

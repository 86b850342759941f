// What a requester sends and to whom: its managers, its providers, its records.
#pragma once

#include "actors/offloading/peers.hpp"
#include "messages/type_ids.hpp"
#include "offloading/requester.hpp"

#include <map>
#include <optional>
#include <vector>

namespace sofof::actors {

/// SR itself; besides its interface: its timer with this number.
using requester_impl = messages::onboard_requester_actor::extend<
    messages::reacts_to<messages::tick_atom, std::uint64_t>>;

/// Turns what the rules want into messages of their actor.
class requester_links : public offloading::requester_port {
public:
  /// @param self  Outlives the links.
  requester_links(requester_impl::pointer self, station_id station,
                  messages::recorder_actor recorder)
      : self_{self}, station_{station}, recorder_{std::move(recorder)} {}

  void add(const messages::service_name& service,
           messages::requester_manager_actor manager);

  /// @returns the number of the provider that sent the message that is handled,
  /// if anybody did; from its first one on it is monitored.
  std::optional<offloading::peer_id> sender();
  peers<messages::provider_actor>& providers() { return providers_; }

  /// Takes up the managers of a response, one for each accepted service, in
  /// their order. A verdict of a broken peer that has none, and all after that,
  /// are taken away.
  void take_up(messages::service_response& response,
               const std::vector<messages::provider_manager_actor>& given);

  void send(offloading::peer_id to,
            const messages::service_request& request) override;
  void send(offloading::peer_id to, const messages::service_end& end) override;
  void begin(const messages::session_id& session) override;
  void forward(const messages::service_result& result) override;
  void end(const messages::service_end& end) override;
  void set_standby(const messages::service_name& service,
                   const std::optional<messages::standby>& chosen) override;
  void foresee_home(const messages::service_name& service) override;
  void on_placement(bool any_remote) override;
  void record(messages::record&& x) override;
  void wake_at(time_point t, std::uint64_t number) override;

private:
  requester_impl::pointer self_;
  station_id station_;
  messages::recorder_actor recorder_;
  std::map<messages::service_name, messages::requester_manager_actor> managers_;
  // Managers given with the response that is handled.
  std::map<messages::session_id, messages::provider_manager_actor> accepted_;
  peers<messages::provider_actor> providers_;
};

} // namespace sofof::actors

// What a provider sends and to whom: its requesters, its managers, its records.
#pragma once

#include "actors/offloading/peers.hpp"
#include "actors/offloading/provider_services.hpp"
#include "messages/type_ids.hpp"
#include "offloading/provider.hpp"

#include <map>
#include <optional>
#include <utility>

namespace sofof::actors {

/// SP itself; besides its interface: its timer with this number.
using provider_impl = messages::roadside_provider_actor::extend<
    messages::reacts_to<messages::tick_atom, std::uint64_t>>;

/// Turns what the rules want into messages of their actor.
class provider_links : public offloading::provider_port {
public:
  /// @param self, services  Outlive the links.
  provider_links(provider_impl::pointer self, const provider_services& services,
                 messages::recorder_actor recorder)
      : self_{self}, services_{services}, recorder_{std::move(recorder)} {}

  /// Calls `tell` with the number of a requester, which stays known only if it
  /// is served then; does nothing for none, of a station that wants no service.
  template <class Function>
  void with(const messages::requester_actor& requester,
            const offloading::provider& rules, Function tell) {
    if (!requester)
      return;
    const auto known = requesters_.find(requester.address());
    const auto peer = known ? *known : requesters_.add(requester);
    tell(peer);
    if (!known && !rules.serves(peer))
      requesters_.forget(peer);
  }

  /// Tells the rules that a manager or a requester is no more.
  void on_down(const caf::down_msg& down, offloading::provider& rules);

  void send(offloading::peer_id to,
            const messages::service_offer& offer) override;
  void send(offloading::peer_id to,
            const messages::session_digest& digest) override;
  void send(offloading::peer_id to,
            const messages::service_response& response) override;
  void send(offloading::peer_id to, const messages::service_end& end) override;
  void meet(offloading::peer_id requester) override;
  void leave(offloading::peer_id requester) override;
  void start(const offloading::session_start& start) override;
  void end(const messages::service_end& end) override;
  void record(messages::record&& x) override;
  void wake_at(time_point t, std::uint64_t number) override;

private:
  std::optional<messages::session_id>
  session_of(const caf::actor_addr& manager) const;

  provider_impl::pointer self_;
  const provider_services& services_;
  messages::recorder_actor recorder_;
  std::map<messages::session_id, messages::provider_manager_actor> managers_;
  peers<messages::requester_actor> requesters_;
};

} // namespace sofof::actors

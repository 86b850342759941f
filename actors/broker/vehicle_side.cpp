// Envelopes to those that stand for providers.
#include "actors/broker/vehicle_side.hpp"

#include "actors/broker/brokered_provider.hpp"

#include <caf/exit_reason.hpp>
#include <caf/send.hpp>

#include <mutex>
#include <utility>

namespace sofof::actors {

namespace {

/// Tells a connected proxy or its endpoint what a provider has sent.
class delivery_to_vehicles {
public:
  /// @param proxy  Lives.
  delivery_to_vehicles(const wire::envelope& from,
                       brokered_provider_actor proxy,
                       const messages::vehicle_endpoint_actor& endpoint)
      : from_{from}, proxy_{std::move(proxy)}, endpoint_{endpoint} {}

  void operator()(const wire::challenge& x) const {
    caf::anon_send(proxy_, x.protocol, x.types, x.nonce);
  }
  void operator()(const messages::peer_welcome& x) const {
    caf::anon_send(proxy_, x, from_.from.value());
  }
  void operator()(const wire::refusal& x) const {
    caf::anon_send(proxy_, x.why, x.for_ever);
  }
  void operator()(const wire::closing&) const {
    caf::anon_send_exit(proxy_, caf::exit_reason::remote_link_unreachable);
  }
  void operator()(const wire::offer& x) const {
    if (from_.to)
      tell(from_.to->value(), x.what);
  }
  void operator()(const messages::ping& x) const { tell(x); }
  void operator()(const messages::pong& x) const { tell(x); }
  void operator()(const messages::service_response& x) const { tell(x); }
  void operator()(const messages::session_digest& x) const { tell(x); }
  void operator()(const messages::service_result& x) const { tell(x); }
  void operator()(const messages::service_end& x) const {
    if (x.from == messages::side::provider)
      tell(x);
  }
  template <class T>
  void operator()(const T&) const {} // no provider says so

private:
  template <class... Ts>
  void tell(const Ts&... xs) const {
    if (endpoint_)
      caf::send_as(proxy_, endpoint_, xs...);
  }

  const wire::envelope& from_;
  brokered_provider_actor proxy_;
  const messages::vehicle_endpoint_actor& endpoint_;
};

} // namespace

vehicle_side::vehicle_side(caf::actor_system& sys, vehicle_side_setup setup)
    : shared_{std::make_shared<shared>(sys, std::move(setup))} {}

messages::acceptor_actor
vehicle_side::proxy_for(const std::string& provider) const {
  return spawn_brokered_provider(shared_, shared_->setup.draw_link(), provider);
}

void vehicle_side::tell(station_id from,
                        const messages::its_pdu& message) const {
  shared_->tell(from, message);
}

void vehicle_side::on_envelope(const wire::envelope& x) const {
  const auto to = shared_->find(x.link);
  const auto& is_sent_by = shared_->setup.is_sent_by;
  if (!to || (is_sent_by && !is_sent_by(x.user, to->provider)))
    return;
  if (const auto proxy = caf::actor_cast<brokered_provider_actor>(to->proxy))
    std::visit(delivery_to_vehicles{x, proxy, to->endpoint}, x.what);
}

void vehicle_side::lose() const {
  const std::lock_guard lock{shared_->mutex};
  for (const auto& [link, to] : shared_->proxies)
    if (const auto proxy = caf::actor_cast<brokered_provider_actor>(to.proxy))
      caf::anon_send_exit(proxy, caf::exit_reason::remote_link_unreachable);
}

} // namespace sofof::actors

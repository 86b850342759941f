// Envelopes to those that stand for processes of vehicles.
#include "actors/broker/provider_side.hpp"

#include "actors/broker/vehicle_process.hpp"

#include <caf/exit_reason.hpp>
#include <caf/send.hpp>

#include <mutex>
#include <utility>

namespace sofof::actors {

namespace {

/// So many processes may have introduced themselves or be about to.
constexpr std::size_t most_processes = 1024;
/// So many of one user, and of all where nobody has a name, may be about to.
constexpr std::size_t most_waiting = 2, most_nameless = 64;

/// Tells an endpoint, or who stands for its process, what that has sent.
class delivery_to_provider {
public:
  delivery_to_provider(const process_actor& process,
                       const messages::provider_endpoint_actor& endpoint)
      : process_{process}, endpoint_{endpoint} {}

  void operator()(const messages::peer_hello& x) const {
    caf::anon_send(process_, x);
  }
  void operator()(const wire::closing&) const {
    caf::anon_send_exit(process_, caf::exit_reason::remote_link_unreachable);
  }
  void operator()(const wire::broadcast& x) const {
    if (const auto station = x.message.station())
      tell(station->value(), x.message);
  }
  void operator()(const messages::ping& x) const { tell(x); }
  void operator()(const messages::pong& x) const { tell(x); }
  void operator()(const messages::service_request& x) const { tell(x); }
  void operator()(const messages::service_input& x) const { tell(x); }
  void operator()(const messages::service_end& x) const {
    if (x.from == messages::side::requester)
      tell(x);
  }
  template <class T>
  void operator()(const T&) const {} // no process of vehicles says so

private:
  template <class... Ts>
  void tell(const Ts&... xs) const {
    if (endpoint_)
      caf::send_as(process_, endpoint_, xs...);
  }

  const process_actor& process_;
  const messages::provider_endpoint_actor& endpoint_;
};

} // namespace

provider_side::provider_side(caf::actor_system& sys, provider_side_setup setup)
    : shared_{std::make_shared<shared>(sys, std::move(setup))} {}

void provider_side::on_envelope(const wire::envelope& x) const {
  if (const auto* connect_request =
          std::get_if<wire::connect_request>(&x.what)) {
    if (connect_request->provider != shared_->setup.name
        || is_provider_station(x.from))
      return;
    const std::lock_guard lock{shared_->mutex};
    const auto most = x.user.empty() ? most_nameless : most_waiting;
    if (shared_->processes.size() >= most_processes
        || shared_->processes.contains(x.link)
        || shared_->waiting_of(x.user) >= most)
      return;
    auto& process = shared_->processes[x.link];
    process.sender = x.from;
    process.user = x.user;
    process.stands_for_it =
        spawn_process(shared_, x.link, x.from, *connect_request);
    return;
  }
  const auto* told = std::get_if<wire::broadcast>(&x.what);
  const auto process = told ? shared_->find(x.from) : shared_->find(x.link);
  if (!process) {
    if (told)
      shared_->setup.on_foreign(told->message);
    return;
  }
  if (process->user == x.user && process->is_of(x.from))
    std::visit(delivery_to_provider{process->stands_for_it, process->endpoint},
               x.what);
}

void provider_side::lose() const {
  const std::lock_guard lock{shared_->mutex};
  for (const auto& [link, process] : shared_->processes)
    caf::anon_send_exit(process.stands_for_it,
                        caf::exit_reason::remote_link_unreachable);
}

} // namespace sofof::actors

// Handles are found by service, session and peer.
#include "actors/offloading/requester_links.hpp"

#include "actors/runtime/cpu_accounts.hpp"
#include "actors/runtime/record_on_air.hpp"
#include "actors/runtime/time.hpp"

#include <caf/typed_event_based_actor.hpp>

#include <utility>

namespace sofof::actors {

void requester_links::add(const messages::service_name& service,
                          messages::requester_manager_actor manager) {
  managers_.emplace(service, std::move(manager));
}

std::optional<offloading::peer_id> requester_links::sender() {
  const auto who =
      caf::actor_cast<messages::provider_actor>(self_->current_sender());
  if (!who)
    return std::nullopt;
  if (const auto known = providers_.find(who.address()))
    return *known;
  self_->monitor(who);
  return providers_.add(who);
}

void requester_links::take_up(
    messages::service_response& response,
    const std::vector<messages::provider_manager_actor>& given) {
  accepted_.clear();
  auto manager = given.begin();
  auto v = response.verdicts.begin();
  for (; v != response.verdicts.end(); ++v) {
    if (v->accepted && manager == given.end())
      break;
    if (v->accepted)
      accepted_.emplace(v->session, *manager++);
  }
  response.verdicts.erase(v, response.verdicts.end());
}

void requester_links::send(offloading::peer_id to,
                           const messages::service_request& request) {
  self_->send(providers_.at(to), request, messages::requester_actor{self_});
}

void requester_links::send(offloading::peer_id to,
                           const messages::service_end& end) {
  record_on_air(self_, recorder_, end.what);
  self_->send(providers_.at(to), end);
}

void requester_links::begin(const messages::session_id& session) {
  self_->send(managers_.at(session.service), session, accepted_.at(session));
}

void requester_links::forward(const messages::service_result& result) {
  self_->send(managers_.at(result.session.service), result);
}

void requester_links::end(const messages::service_end& end) {
  self_->send(managers_.at(end.session.service), end);
}

void requester_links::set_standby(
    const messages::service_name& service,
    const std::optional<messages::standby>& chosen) {
  const auto& manager = managers_.at(service);
  if (chosen)
    self_->send(manager, *chosen);
  else
    self_->send(manager, messages::no_standby_atom_v);
}

void requester_links::foresee_home(const messages::service_name& service) {
  self_->send(managers_.at(service), messages::home_is_near_atom_v);
}

// For whom it works, in case accounts are kept.
void requester_links::on_placement(bool any_remote) {
  charge(self_->system(), self_->id(), {station_, {}, any_remote});
}

void requester_links::record(messages::record&& x) {
  self_->send(recorder_, std::move(x));
}

void requester_links::wake_at(time_point t, std::uint64_t number) {
  send_at(self_, self_, t, messages::tick_atom_v, number);
}

} // namespace sofof::actors

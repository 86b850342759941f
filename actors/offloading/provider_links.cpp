// Handles are found by session and peer.
#include "actors/offloading/provider_links.hpp"

#include "actors/offloading/service_manager.hpp"
#include "actors/runtime/record_on_air.hpp"
#include "actors/runtime/time.hpp"

#include <caf/typed_event_based_actor.hpp>

#include <algorithm>
#include <cassert>
#include <vector>

namespace sofof::actors {

void provider_links::on_down(const caf::down_msg& down,
                             offloading::provider& rules) {
  using messages::end_reason;
  const auto in_order = down.reason == caf::exit_reason::user_shutdown;
  // A manager that was never fed gives up; any other has died.
  if (const auto session = session_of(down.source))
    rules.on_function_lost(
        *session, in_order ? end_reason::no_data : end_reason::peer_lost,
        now(self_));
  else if (const auto peer = requesters_.find(down.source))
    rules.on_lost(*peer,
                  in_order ? end_reason::shutdown : end_reason::peer_lost,
                  now(self_));
}

std::optional<messages::session_id>
provider_links::session_of(const caf::actor_addr& manager) const {
  const auto i = std::ranges::find(managers_, manager, [](const auto& entry) {
    return entry.second.address();
  });
  if (i == managers_.end())
    return std::nullopt;
  return i->first;
}

void provider_links::send(offloading::peer_id to,
                          const messages::service_offer& offer) {
  self_->send(requesters_.at(to), offer);
}

void provider_links::send(offloading::peer_id to,
                          const messages::session_digest& digest) {
  self_->send(requesters_.at(to), digest);
}

void provider_links::send(offloading::peer_id to,
                          const messages::service_response& response) {
  std::vector<messages::provider_manager_actor> started;
  for (const auto& v : response.verdicts)
    if (v.accepted)
      started.push_back(managers_.at(v.session));
  self_->send(requesters_.at(to), response, std::move(started));
}

void provider_links::send(offloading::peer_id to,
                          const messages::service_end& end) {
  record_on_air(self_, recorder_, end.what);
  self_->send(requesters_.at(to), end);
}

void provider_links::meet(offloading::peer_id requester) {
  self_->monitor(requesters_.at(requester));
}

void provider_links::leave(offloading::peer_id requester) {
  self_->demonitor(requesters_.at(requester));
  requesters_.forget(requester);
}

void provider_links::start(const offloading::session_start& start) {
  auto manager = spawn_provider_manager(
      self_->system(), {services_.make(start), requesters_.at(start.requester),
                        self_, recorder_});
  self_->monitor(manager);
  managers_.emplace(start.session, std::move(manager));
}

void provider_links::end(const messages::service_end& end) {
  const auto manager = managers_.extract(end.session);
  assert(!manager.empty());
  self_->demonitor(manager.mapped());
  self_->send(manager.mapped(), end);
}

void provider_links::record(messages::record&& x) {
  self_->send(recorder_, std::move(x));
}

void provider_links::wake_at(time_point t, std::uint64_t number) {
  send_at(self_, self_, t, messages::tick_atom_v, number);
}

} // namespace sofof::actors

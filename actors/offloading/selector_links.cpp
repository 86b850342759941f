// The vehicle's own function rests while a provider's results are used.
#include "actors/offloading/selector_links.hpp"

#include "actors/offloading/qos_watchdog.hpp"
#include "actors/runtime/cpu_accounts.hpp"
#include "actors/runtime/record_on_air.hpp"
#include "actors/runtime/time.hpp"
#include "messages/v2x/octets_on_air.hpp"

#include <caf/typed_event_based_actor.hpp>

#include <utility>
#include <variant>

namespace sofof::actors {

selector_links::selector_links(requester_manager_impl::pointer self,
                               const requester_manager_setup& setup)
    : self_{self}, station_{setup.station}, service_{setup.service.name},
      client_{setup.client}, requester_{setup.requester}, recorder_{
                                                              setup.recorder} {}

void selector_links::start(requester_manager_setup setup) {
  local_ = spawn_instance(self_->system(), {std::move(setup.local), self_});
  self_->link_to(local_);
  watchdog_ = spawn_qos_watchdog(self_->system(), setup.service.options.limits,
                                 requester_);
  self_->link_to(watchdog_);
  charge_all(false);
  self_->send(local_, messages::lifecycle_step::configure);
  self_->send(local_, messages::lifecycle_step::activate);
  self_->send(client_, messages::requester_manager_actor{self_});
}

// For whom they work, in case accounts are kept.
void selector_links::charge_all(bool remote) {
  const cpu_account to{station_, service_, remote};
  for (const auto who : {self_->id(), local_.id(), watchdog_.id()})
    charge(self_->system(), who, to);
}

void selector_links::add(const messages::session_id& session,
                         messages::provider_manager_actor manager) {
  managers_[session] = std::move(manager);
}

void selector_links::count(const messages::service_result& result) {
  if (result.session.is_remote())
    octets_down_ += octets_on_air(result);
}

void selector_links::feed_local(const messages::service_input& input) {
  self_->send(local_, input);
}

void selector_links::feed_remote(messages::service_input input) {
  record_on_air(self_, recorder_, input.what);
  octets_up_ += octets_on_air(input);
  const auto& manager = managers_.at(input.session);
  self_->send(manager, std::move(input));
}

void selector_links::use(const messages::service_result& result) {
  self_->send(client_, result);
}

void selector_links::go_remote() {
  charge_all(true);
  self_->send(local_, messages::lifecycle_step::deactivate);
}

void selector_links::go_local(messages::service_input input) {
  charge_all(false);
  run_along(std::move(input));
}

void selector_links::run_along(messages::service_input input) {
  self_->send(local_, std::move(input));
  self_->send(local_, messages::lifecycle_step::activate);
}

void selector_links::rest() {
  self_->send(local_, messages::lifecycle_step::deactivate);
}

void selector_links::announce_source(bool remote) {
  self_->send(client_, messages::source_change{service_, remote});
}

void selector_links::report_first_data(const messages::session_id& session) {
  self_->send(requester_, session);
}

void selector_links::report(messages::qos_violation violation) {
  self_->send(requester_, std::move(violation));
}

void selector_links::report_safe_response(duration longest) {
  self_->send(requester_, service_, longest);
}

void selector_links::record(messages::record&& x) {
  if (auto* work = std::get_if<messages::work_record>(&x)) {
    work->octets_up = std::exchange(octets_up_, 0);
    work->octets_down = std::exchange(octets_down_, 0);
  }
  self_->send(recorder_, std::move(x));
}

void selector_links::wake_at(time_point t, std::uint64_t number) {
  send_at(self_, self_, t, messages::tick_atom_v, number);
}

} // namespace sofof::actors

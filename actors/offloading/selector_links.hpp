// What a source selector sends and to whom: functions, client, watchdog.
#pragma once

#include "actors/offloading/service_manager.hpp"
#include "messages/type_ids.hpp"
#include "offloading/source_selector.hpp"

#include <cstdint>
#include <map>
#include <string>

namespace sofof::actors {

/// A manager itself; besides its interface: the selector's timer with this
/// number.
using requester_manager_impl = messages::requester_manager_actor::extend<
    messages::reacts_to<messages::tick_atom, std::uint64_t>>;

/// Turns what the rules want into messages of their actor.
class selector_links : public offloading::selector_port {
public:
  /// @param self  Outlives the links.
  selector_links(requester_manager_impl::pointer self,
                 const requester_manager_setup& setup);

  /// Spawns the vehicle's own function and the watchdog, and tells the client
  /// where inputs are wanted.
  void start(requester_manager_setup setup);

  void add(const messages::session_id& session,
           messages::provider_manager_actor manager);
  void forget(const messages::session_id& session) { managers_.erase(session); }

  /// A result has come, of whatever source.
  void count(const messages::service_result& result);

  void feed_local(const messages::service_input& input) override;
  void feed_remote(messages::service_input input) override;
  void use(const messages::service_result& result) override;
  void go_remote() override;
  void go_local(messages::service_input input) override;
  void run_along(messages::service_input input) override;
  void rest() override;
  void announce_source(bool remote) override;
  void report_first_data(const messages::session_id& session) override;
  void report(messages::qos_violation violation) override;
  void report_safe_response(duration longest) override;
  void watch(const messages::session_id& session, time_point last) override;
  void watch_arrival(const messages::arrival& result) override;
  void watch_useless(const messages::session_id& session,
                     const messages::implausibility& found) override;
  void watch_limits(const messages::qos_limits& limits) override;
  void watch_end(const messages::service_end& end) override;
  void record(messages::record&& x) override;
  void wake_at(time_point t, std::uint64_t number) override;

private:
  void charge_all(bool remote);

  requester_manager_impl::pointer self_;
  station_id station_;
  messages::service_name service_;
  messages::client_actor client_;
  messages::onboard_requester_actor requester_;
  messages::recorder_actor recorder_;
  messages::instance_actor local_;
  messages::watchdog_actor watchdog_;
  std::map<messages::session_id, messages::provider_manager_actor> managers_;
  std::uint64_t octets_up_ = 0, octets_down_ = 0; // since work was recorded
};

} // namespace sofof::actors

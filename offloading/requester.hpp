// The vehicle's side of offloading: which provider is asked for which service,
// and when a session ends.
#pragma once

#include "messages/protocol/motion.hpp"
#include "messages/protocol/qos.hpp"
#include "messages/protocol/record.hpp"
#include "offloading/ending.hpp"
#include "offloading/peer.hpp"
#include "offloading/service_state.hpp"
#include "offloading/standby.hpp"
#include "offloading/timer_list.hpp"
#include "offloading/tracer.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sofof::offloading {

/// What a requester is made of.
struct requester_setup {
  station_id station = 0;
  std::vector<onboard_service> services;          ///< With different names.
  std::unique_ptr<policies::local_policy> policy; ///< Not null.
  world::computer_options computer{};             ///< The vehicle's.
  random_stream noise{0, ""};                     ///< Of this vehicle.
  /// The route ahead, m, as decisions and requests need it.
  std::function<std::vector<point>(const messages::ego_state&)> path_ahead =
      [](const messages::ego_state&) { return std::vector<point>{}; };
  /// What is to come, where a run can tell; else null.
  std::shared_ptr<const policies::channel_oracle> future{};
  /// What results are like by place, as far as that is known; else null. Told
  /// of all that comes; from the requester's thread alone.
  std::shared_ptr<policies::quality_forecast> forecast{};
  bool trace = false; ///< Record each step.
};

/// What a requester makes others do. Nothing of this calls the requester back.
class requester_port {
public:
  virtual ~requester_port() = default;

  virtual void send(peer_id provider,
                    const messages::service_request& request) = 0;
  virtual void send(peer_id provider, const messages::service_end& end) = 0;

  /// The source selector of `session.service` has one more session to feed.
  virtual void begin(const messages::session_id& session) = 0;
  /// A result of one of its sessions has come.
  virtual void forward(const messages::service_result& result) = 0;
  /// One of its sessions has ended.
  virtual void end(const messages::service_end& end) = 0;
  /// This provider stands by from now on; nullopt: none does.
  virtual void set_standby(const messages::service_name& service,
                           const std::optional<messages::standby>& chosen) = 0;
  /// The service may come home soon.
  virtual void foresee_home(const messages::service_name& service) = 0;

  /// Whether any service is run by a provider has perhaps changed.
  virtual void on_placement(bool any_remote) = 0;

  virtual void record(messages::record&& x) = 0;

  /// `on_timer` is due then, with this number.
  virtual void wake_at(time_point t, std::uint64_t number) = 0;
};

/// Weighs offers, requests services, and owns the state of all services of its
/// vehicle; one state machine for each service and provider:
///
///     local → requested → starting → remote → local
///
/// * A service that runs at one provider goes on there until another one that
///   it was requested from gives first data (hand-over), or at both of them, if
///   that was decided.
/// * A violation, a lost provider and the provider's own end close a session at
///   once; the selector then goes on with what is left, at last the vehicle's
///   own function.
/// * Each session is closed once; its provider is told, unless it was the one
///   to say so or is lost.
/// * A provider with an implausible result is not asked for a while, for no
///   service (distrust.hpp). One whose session ended by a fault (not
///   messages::is_planned) is not asked for that service for
///   protocol::cool_down, nor are those that ran it beside that one.
/// * Results of a session that is not known are dropped; its provider is told
///   so every protocol::unknown_result_period at most.
/// * A provider's digests name the sessions that run there. A session that two
///   digests in a row do not name ends here; a session that only the provider
///   has is ended there once more, every protocol::unknown_result_period at
///   most. A session ends, too, of which neither result nor digest comes for
///   protocol::confirmation_timeout.
///
/// Source: Dehler & Buchholz 2025, service requester.
/// No clock and no I/O: every call says what time it is, never less than
/// before.
class requester {
public:
  /// @param port  Outlives the requester.
  requester(requester_setup setup, requester_port& port, time_point now);

  /// Where the vehicle is and how it moves.
  void on_motion(const messages::ego_state& ego) { ego_ = ego; }

  /// A service has found under which response time the scene is safe.
  void on_safe_response(const messages::service_name& service, duration longest,
                        time_point now);

  /// @param from  Whoever has sent it; an offer in the name of a provider that
  ///              another peer speaks for is ignored.
  void on_offer(const messages::service_offer& offer, peer_id from,
                time_point now);

  /// @returns whether a peer speaks for a provider, by the offers that came.
  bool is_peer_of(provider_id provider, peer_id peer) const;

  /// Verdicts up to the first that cannot be meant for this vehicle count.
  void on_response(const messages::service_response& response, time_point now);

  /// A provider tells what it believes to run for this vehicle. What it ended
  /// ends here too, and what runs there for nothing is ended again.
  /// @param from  Whoever has sent it; see `on_offer`.
  void on_digest(const messages::session_digest& digest, peer_id from,
                 time_point now);

  /// A result has come over the air, of whatever session.
  void on_result(const messages::service_result& result, time_point now);

  /// The selector uses the first result of a session.
  void on_first_data(const messages::session_id& session, time_point now);

  /// The watchdog or the selector has found a violation.
  void on_violation(const messages::qos_violation& violation, time_point now);

  /// A provider has ended a session; one that is not known is ignored.
  void on_end(const messages::service_end& end, time_point now);

  /// A peer cannot be reached any more.
  void on_lost(peer_id peer, time_point now);

  /// The time that `wake_at` was given with this number has come.
  void on_timer(std::uint64_t number, time_point now);

  /// Closes what still runs.
  void shut_down(time_point now);

private:
  using step = messages::trace_step;

  /// A request is open for too long.
  struct request_timeout {
    provider_id provider = 0;
    std::uint32_t number = 0;
  };
  /// A session should have given its first data by now.
  struct start_timeout {
    messages::session_id session;
  };
  /// Does its provider still say that it runs it?
  struct confirmation_check {
    messages::session_id session;
    time_point accepted;
  };
  /// An epoch of the policy is over.
  struct epoch_end {};
  using timer = std::variant<request_timeout, start_timeout, confirmation_check,
                             epoch_end>;

  /// A session that has been accepted, and its service.
  struct found_session {
    service_state* service = nullptr;
    requester_session* session = nullptr;
    explicit operator bool() const { return session != nullptr; }
  };

  void pass(time_point now);
  bool is_consistent() const;
  service_state* find(const messages::service_name& service);
  found_session find(const messages::session_id& session);
  void wake_at(time_point t, timer what);
  void announce_placement();

  known_provider& meet(provider_id id, peer_id peer);
  bool is_in_use(provider_id id) const;
  void learn(const messages::service_offer& offer, time_point now);
  void look_ahead(service_state& service, time_point now);
  void distrust_peer_of(provider_id provider, time_point now);

  template <class Predicate>
  void weigh(Predicate is_due, std::optional<provider_id> offering,
             time_point now);
  std::vector<provider_id>
  decide(service_state& service,
         std::span<const policies::provider_view> providers,
         std::optional<provider_id> offering, std::span<const point> path,
         time_point now);
  policies::local_context
  context_of(const service_state& service,
             std::span<const policies::provider_view> providers,
             std::span<const policies::chain_link> chain,
             std::span<const point> path, time_point now) const;
  std::vector<policies::provider_forecast>
  forecasts(const service_state& service,
            std::span<const policies::provider_view> providers,
            std::span<const point> path) const;
  void learn_place(const service_state& service, provider_id provider,
                   duration latency, bool is_offer);
  void learn_missed(const service_state& service, provider_id provider);
  std::vector<candidate> candidates(service_state& service, provider_id asked,
                                    std::span<const point> path,
                                    time_point now);
  policies::service_times times_of(const service_state& service) const;
  std::vector<policies::chain_link> chain_view(time_point now);
  void learn_times(service_state& service,
                   const messages::service_result& result, time_point now);
  void predict_response(time_point now);
  void set_standby(service_state& service, duration after);
  std::string own_services_of(const messages::service_offer& offer) const;
  void request(provider_id id, std::vector<messages::service_name> wanted,
               const std::vector<point>& path, time_point now);

  void expire(const request_timeout& x, time_point now);
  void expire(const start_timeout& x, time_point now);
  void expire(const confirmation_check& x, time_point now);
  void expire(const epoch_end&, time_point now);

  void refuse_requested(provider_id provider, std::string_view why,
                        time_point now);
  void accept(service_state& service, requester_session& session,
              const messages::verdict& v, time_point now);
  void refuse(service_state& service, provider_id provider,
              std::string_view why, std::optional<provider_id> instead,
              time_point now);
  void complain(const messages::session_id& session, time_point now);
  void end_unknown(const messages::session_digest& digest,
                   std::optional<time_point>& last, time_point now);
  void end_unconfirmed(const messages::session_digest& digest, time_point now);

  std::vector<provider_id>
  leave(service_state& service, const ending& why, time_point now,
        const std::function<bool(provider_id)>& is_meant);
  void leave_unwanted(service_state& service, time_point now);
  void stop_unsafe_starts(time_point now);
  void leave_beside(service_state& service, provider_id violator,
                    std::string_view why, time_point now);
  void end(service_state& service, provider_id provider, const ending& why,
           bool tell, time_point now);
  void observe_missed(const service_state& service, provider_id provider,
                      time_point now);
  void learn_from(const service_state& service, const requester_session& ended,
                  messages::end_reason reason, time_point now);
  void log_end(service_state& service, const requester_session& ended,
               const ending& why, time_point now);
  void send_end(const messages::service_end& end);

  void log_verdict(const service_state& service, provider_id provider,
                   std::uint32_t counter, std::string_view why, bool accepted,
                   time_point now);
  void log_switch(const messages::session_id& session, bool remote,
                  time_point now);
  void log(messages::event_type what, const messages::session_id& session,
           std::string_view detail, time_point now);

  requester_setup setup_;
  std::vector<messages::service_name>
      chain_; // of services; empty: there is none
  requester_port& port_;
  tracer trace_;
  std::vector<service_state> services_;
  known_providers providers_;
  messages::ego_state ego_;
  timer_list<timer> timers_;
  std::uint32_t last_request_ = 0;
  std::uint64_t decisions_ = 0;
  duration epoch_{}; // of the policy; 0: none
  time_point now_;   // of the latest call
};

} // namespace sofof::offloading

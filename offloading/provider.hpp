// The edge server's side of offloading: to which station its services are
// offered, and for which they run.
#pragma once

#include "base/moving_area.hpp"
#include "messages/protocol/qos.hpp"
#include "messages/protocol/record.hpp"
#include "offloading/ending.hpp"
#include "offloading/peer.hpp"
#include "offloading/service_cycle.hpp"
#include "offloading/timer_list.hpp"
#include "offloading/tracer.hpp"
#include "policies/api/context.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace sofof::offloading {

/// What cycles are computed by: how long one of unit demand takes.
struct provider_computer {
  std::size_t workers = 1; ///< > 0.
  double mean_s = 0;       ///< ≥ 0.
  double deviation_s = 0;  ///< ≥ 0.
  double longest_s = 0; ///< That no cycle takes longer than, but for `overrun`.
  policies::overrun_law overrun{};
};

/// What a provider is made of.
struct provider_setup {
  provider_id id = 0;
  point position; ///< m, east-north.
  polygon area;   ///< Services end for stations that leave it.
  std::vector<offered_service> services;            ///< With different names.
  std::unique_ptr<policies::central_policy> policy; ///< Not null.
  provider_computer computer;
  /// Of the provider; not null. Without lanes: it has none, and refuses what
  /// needs one, whatever the policy says.
  std::shared_ptr<const world::road_map> map =
      std::make_shared<const world::road_map>();
  random_stream noise{0, ""}; ///< Of this provider.
  bool trace = false;         ///< Record each step.
  /// Of a provider that rides with a vehicle: it serves who is nearer, m, and
  /// `area` lies round (0, 0), which stands for where the vehicle is.
  std::optional<double> reach_m{};
};

/// A session that begins.
struct session_start {
  messages::session_id session;
  peer_id requester{};      ///< It gets the results.
  duration phase{};         ///< Cycles start at phase + k · period.
  bool keeps_phase = false; ///< The first one too.
};

/// @returns the cycle of a session at a provider that offers the service;
/// `finish` is left to be filled in.
cycle_setup cycle_of(const offered_service& service,
                     const session_start& start);

/// What a provider makes others do. Nothing of this calls the provider back.
class provider_port {
public:
  virtual ~provider_port() = default;

  virtual void send(peer_id requester,
                    const messages::service_offer& offer) = 0;
  virtual void send(peer_id requester,
                    const messages::session_digest& digest) = 0;
  /// The sessions of its accepted verdicts have been started before.
  virtual void send(peer_id requester,
                    const messages::service_response& response) = 0;
  virtual void send(peer_id requester, const messages::service_end& end) = 0;

  /// This requester speaks for a station from now on: `on_lost` is to be called
  /// when it cannot be reached any more.
  virtual void meet(peer_id requester) = 0;
  /// It speaks for none any more, and waits for no answer: nothing more is sent
  /// to it.
  virtual void leave(peer_id requester) = 0;

  /// A function shall run for this session from its first input on.
  virtual void start(const session_start& start) = 0;
  /// It shall end.
  virtual void end(const messages::service_end& end) = 0;

  virtual void record(messages::record&& x) = 0;

  /// `on_timer` is due then, with this number.
  virtual void wake_at(time_point t, std::uint64_t number) = 0;
};

/// Offers its services to every station that it hears, asks its policy about
/// requests, and ends a session when the station has left the area, has fallen
/// silent, or says so. One state machine for each station and service:
///
///     idle → offered → active → idle
///
/// * Every protocol::offer_period, and when it comes into the area, a station
///   is offered what does not run for it. Whether it has to be in the area is
///   the policy's business.
/// * A CAM counts by where the area was when it was made.
/// * A provider that rides with a vehicle offers on while all services run:
///   offers tell where it is. Its carrier is not served.
/// * A station leaves the area with a CAM from outside; whom the policy accepts
///   though it asks from outside leaves it when it has been inside.
/// * Requests are answered at once, or together at the end of the policy's
///   epoch; each named service gets its verdict (provider_requests.cpp). With
///   its verdicts the policy may take running sessions back: these are revoked.
/// * A new requester of a station knows nothing of what ran for the one before:
///   that ends.
/// * Each session is closed once; the requester is told, unless it was the one
///   to say so.
/// * A station is told every protocol::digest_period what runs for it, and,
///   while it is heard, for protocol::digest_goes_on after nothing does: an end
///   that was lost is found by either side.
///
/// Source: Dehler & Buchholz 2025, service provider.
/// No clock and no I/O: every call says what time it is, never less than
/// before.
class provider {
public:
  /// @param port  Outlives the provider.
  provider(provider_setup setup, provider_port& port);

  /// A station tells where it is, which alone shows that it is still there.
  /// Source: Dehler & Buchholz 2025, "CAM check" of fig. 2.
  /// @param from  Where its requester is reached.
  void on_cam(const messages::cam& c, peer_id from, time_point now);

  /// The vehicle that the provider rides with is here now, and moves like this:
  /// so does the area. Who is in it is found by the next CAMs.
  void on_ride(const messages::cam& carrier, time_point now);

  /// A request with a number that is not above the last one is ignored.
  void on_request(const messages::service_request& request, peer_id from,
                  time_point now);

  /// A requester has ended a session; one that is not known is ignored.
  void on_end(const messages::service_end& end, time_point now);

  /// The function of a session runs no longer; one that is not known is
  /// ignored.
  /// @param why  no_data if no input ever came, peer_lost if it has died.
  void on_function_lost(const messages::session_id& session,
                        messages::end_reason why, time_point now);

  /// A requester cannot be reached any more.
  /// @param why  shutdown if it has ended in good order, else peer_lost.
  void on_lost(peer_id peer, messages::end_reason why, time_point now);

  /// The time that `wake_at` was given with this number has come.
  void on_timer(std::uint64_t number, time_point now);

  /// Closes what still runs.
  void shut_down(time_point now);

  /// @returns whether a requester speaks for a station that is known, or waits
  /// for an answer.
  bool serves(peer_id requester) const;
  /// @returns whether a requester speaks for this station.
  bool serves(station_id station) const {
    const auto known = stations_.find(station);
    return known != stations_.end() && known->second.requester.has_value();
  }

private:
  using step = messages::trace_step;

  /// Has the station fallen silent, whose record has this number?
  struct station_check {
    station_id station = 0;
    std::uint64_t record = 0;
  };
  /// The station whose record has this number is to be told what runs for it.
  struct digest_due {
    station_id station = 0;
    std::uint64_t record = 0;
  };
  /// An epoch of the policy is over.
  struct epoch_end {};
  using timer = std::variant<station_check, digest_due, epoch_end>;

  struct provider_session {
    messages::session_id session;
    time_point since;
    policies::periodic_task task;
    std::size_t worker = 0;
    std::vector<candidate> candidates; // as the station told
    bool was_inside = false; // in the area as it asked, or by a CAM since
  };

  /// A station that is heard.
  struct station_record {
    std::uint64_t number = 0; // so that a timer knows its record
    std::optional<peer_id> requester;
    messages::cam latest;
    time_point heard;       // when the latest message came
    bool is_inside = false; // in the area, by the latest CAM
    time_point next_offer;
    std::uint32_t last_request = 0;
    std::vector<provider_session> sessions;
    bool is_told = false;    // the next digest has its timer
    time_point told_until{}; // though nothing runs

    const provider_session* find(const messages::service_name& service) const;
    /// Whether it has a requester, which is told of what runs, and no service
    /// runs for it twice; between two calls it always is.
    bool is_consistent() const;
  };
  using stations = std::map<station_id, station_record>;

  /// A request that waits for its answer.
  struct open_request {
    messages::service_request what;
    peer_id from{};
  };

  /// What the policy is asked about one request, and what it gets for an
  /// answer.
  struct question {
    // One for each named service.
    std::vector<policies::central_decision> verdicts;
    std::vector<policies::request_view> asked;
    std::vector<std::size_t> places; // of what is asked, among the services
  };

  void pass(time_point now);
  bool is_consistent() const;
  void wake_at(time_point t, timer what);
  void expire(const station_check& x, time_point now);
  void expire(const digest_due& x, time_point now);
  void expire(const epoch_end&, time_point now);

  void meet(station_id id, station_record& station, peer_id requester,
            time_point now);
  void leave(station_record& station, const ending& why, time_point now);
  bool is_inside(const messages::cam& c) const;
  void locate(station_record& station, time_point now);
  std::optional<messages::provider_motion> motion() const;
  void offer(station_record& station, time_point now);
  void begin_digests(station_record& station, time_point now);
  void forget(stations::iterator i, const ending& why, time_point now);
  std::set<peer_id> drop_waiting(station_id station);
  void part_from(const std::set<peer_id>& requesters);

  void answer(std::vector<open_request> requests, time_point now);
  void refuse(const messages::service_request& request, peer_id from,
              std::string_view why);
  void tell(const messages::service_response& response, peer_id to);
  question question_of(const open_request& open, time_point now);
  std::vector<policies::central_decision>
  ask_policy(std::vector<policies::request_view> asked, time_point now);
  policies::chain_links
  links_of(station_id station, std::string_view service,
           std::span<const policies::request_view> asked) const;
  void respond(const open_request& open,
               const std::vector<policies::central_decision>& decisions,
               time_point now);
  void start(station_record& station, const messages::session_id& session,
             const open_request& open, const policies::accepted& terms,
             time_point now);

  void end(station_record& station, messages::session_id session,
           const ending& why, bool tell, time_point now);

  const offered_service* find(const messages::service_name& service) const;
  policies::periodic_task task_of(const offered_service& service) const;
  policies::periodic_task at_most(const offered_service& service) const;
  double utilisation_by(const messages::service_name& service) const;
  double utilisation() const;

  provider_setup setup_;
  moving_area area_;
  std::optional<station_id> carrier_; // once it has moved
  provider_port& port_;
  tracer trace_;
  stations stations_;
  std::vector<open_request> waiting_; // for the end of an epoch
  timer_list<timer> timers_;
  std::uint32_t last_session_ = 0;
  std::uint64_t last_record_ = 0;
  std::uint64_t decisions_ = 0;
  duration epoch_{};                   // of the policy; 0: none
  bool in_epoch_ = false;              // one has begun
  time_point now_ = time_point::min(); // of the latest call
};

} // namespace sofof::offloading

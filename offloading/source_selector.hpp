// Whose results of a service a vehicle uses: its own function's or a
// provider's, exactly one at a time.
#pragma once

#include "messages/protocol/qos.hpp"
#include "messages/protocol/record.hpp"
#include "offloading/first_response.hpp"
#include "offloading/service.hpp"
#include "offloading/standby.hpp"
#include "offloading/tracer.hpp"
#include "offloading/warm_standby.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sofof::offloading {

/// What a selector is made of.
struct selector_setup {
  station_id station = 0;
  onboard_service service;
  bool record_margins = false; ///< With the cycles, those of used results.
  bool trace = false;          ///< Record each step.
  bool asks_scene = false;     ///< Under which response time it is safe.
  world::computer_options computer{}; ///< The vehicle's.
};

/// What a selector makes others do. Nothing of this calls the selector back.
class selector_port {
public:
  virtual ~selector_port() = default;

  /// The vehicle's own function has new input, whether it is active or not.
  virtual void feed_local(const messages::service_input& input) = 0;
  /// A provider has new input; `input.session` is the session.
  virtual void feed_remote(messages::service_input input) = 0;
  /// The client gets a result.
  virtual void use(const messages::service_result& result) = 0;

  /// From now on results come from providers: the own function rests.
  virtual void go_remote() = 0;
  /// The own function runs a cycle from this input, though its result is not
  /// used, and one more whenever it is asked to, until it rests again.
  virtual void run_along(messages::service_input input) = 0;
  /// The own function rests again.
  virtual void rest() = 0;
  /// The own function plans at once, from this input.
  virtual void go_local(messages::service_input input) = 0;
  /// The client is told that its source has changed.
  virtual void announce_source(bool remote) = 0;

  /// The first result of a session is in use.
  virtual void report_first_data(const messages::session_id& session) = 0;
  virtual void report(messages::qos_violation violation) = 0;
  /// Under which response time the scene is safe.
  virtual void report_safe_response(duration longest) = 0;

  /// The watchdog watches this session; its last result came at `last`.
  virtual void watch(const messages::session_id& session, time_point last) = 0;
  virtual void watch_arrival(const messages::arrival& result) = 0;
  virtual void watch_useless(const messages::session_id& session,
                             const messages::implausibility& found) = 0;
  virtual void watch_limits(const messages::qos_limits& limits) = 0;
  virtual void watch_end(const messages::service_end& end) = 0;

  virtual void record(messages::record&& x) = 0;

  /// `on_timer` is due then, with this number.
  virtual void wake_at(time_point t, std::uint64_t number) = 0;
};

/// Chooses the source of one service in one vehicle:
/// * the own function is fed always, so that it can jump in at any moment, and
///   rests while a provider's results are used;
/// * a provider's results are used from the first one on that comes in time and
///   that its judge finds nothing against; those that come late, twice or out
///   of order are not used, nor are those of the own function that a later
///   cycle has overtaken;
/// * an implausible result ends its session at once;
/// * where the scene says how late a result may be (`limits_in_scene`), its
///   limits hold from each input on, and a scene that allows for none ends all
///   sessions at once;
/// * of several providers the first result of each cycle is used, if the result
///   in use may be followed by it; one that has not been in time for
///   protocol::start_timeout is reported;
/// * when the last of them ends, the own function plans at once; if it has run
///   along (warm_standby.hpp), its latest result is used in the same instant,
///   unless that is old, or does not continue the one in use, or an implausible
///   result is the reason.
///
/// No clock and no I/O: every call says what time it is, never less than
/// before.
class source_selector {
public:
  /// @param port  Outlives the selector.
  source_selector(selector_setup setup, selector_port& port);

  /// The client has new input.
  void on_input(const messages::service_input& input, time_point now);

  /// A provider runs the service too. It is fed at once.
  void on_session(const messages::session_id& session, time_point now);

  /// Of several providers, this one stands by; nullopt: none does.
  void on_standby(std::optional<messages::standby> chosen, time_point now);

  /// A result has come, of the own function (counter 0) or of a provider.
  void on_result(const messages::service_result& result, time_point now);

  /// The service may come home soon, as who decides about it foresees.
  void on_home_is_near(time_point now);

  /// A session has ended; one that is not known is ignored.
  void on_end(const messages::service_end& end, time_point now);

  /// Records what has been done since it was recorded last: for the end, since
  /// inputs cause it once a second, as does a change of the source.
  void record_work();

  /// The time that `wake_at` was given with this number has come.
  void on_timer(std::uint64_t number, time_point now);

  /// @returns whether the results of a provider are used.
  bool is_remote() const { return in_use() > 0; }

private:
  using step = messages::trace_step;

  /// A result of another provider need not follow the one in use when that one
  /// is older than so many periods.
  static constexpr auto patience_periods = 2;

  /// A session at a provider, waited for or in use.
  struct source {
    messages::session_id session;
    std::unique_ptr<result_judge> judge;
    bool in_use = false;
    bool in_doubt = false; // its latencies cannot be judged
    bool given_up = false;
    std::optional<std::uint64_t> last_cycle;
    std::optional<time_point> repetition_told, doubt_told; ///< In a record.
    std::optional<time_point> last_sent;
    int answers = 0; // since then
    std::optional<time_point> last_received;
    std::optional<time_point> last_in_time;
    std::optional<messages::implausibility> useless; // the latest since then
    bool knows_it_stands_by = false;                 // by the last input
    int calls_in_vain = 0;
  };

  void pass(time_point now);
  bool is_consistent() const;
  const service_options& options() const { return setup_.service.options; }
  const vehicle_service& own() const { return *setup_.service.own; }
  source* find(const messages::session_id& session);
  std::ptrdiff_t in_use() const;
  bool is_standby(const source& x) const;

  void look_at_scene(time_point now);
  duration greatest_age(const safe_response& found, time_point now);
  void limit_by_scene(duration safe, time_point now);
  bool input_due(const source& x, time_point now) const;
  bool feed(source& x, time_point now);
  void announce_roles(time_point now);
  void await_cycle_after(time_point start);

  std::string broken_limit(const messages::service_result& result,
                           time_point now) const;
  void note(messages::event_type what, const messages::session_id& session,
            std::string detail, time_point now);
  void record_now_and_then(std::optional<time_point>& last,
                           const messages::session_id& session, std::string why,
                           time_point now);
  bool can_judge(source& x, const messages::service_result& result,
                 time_point now);
  void refuse(const messages::session_id& session, const objection& why,
              time_point now);
  void leave_out(source& x, const objection& why, time_point now);
  void on_result_of(source& x, const messages::service_result& result,
                    time_point now, bool in_limits,
                    std::span<const margin> margins);
  void record_cycle(const source& x, const messages::service_result& result,
                    time_point now, bool used, std::span<const margin> margins);
  bool may_follow(const messages::service_result& result, time_point now) const;
  void give_up_silent(time_point now);

  bool run_along(time_point now, bool at_once = false);
  void call_own(time_point now, bool at_once = false);
  void on_own_result(const messages::service_result& result, time_point now);
  void take_own(const messages::service_result& result, time_point now);
  void drop_own();
  void await_missed_result();
  void on_missed_result(time_point now);
  std::optional<messages::service_result> ready(time_point now) const;
  void come_home(const messages::service_end& end, time_point now);

  void use(const messages::service_result& result, time_point now);
  void begin(source& x, time_point now);
  void watch(const messages::session_id& session, time_point last);

  selector_setup setup_;
  selector_port& port_;
  tracer trace_;
  /// What is asked of results now; nullopt: the scene allows for none.
  std::optional<messages::qos_limits> limits_;
  /// Of the scenes that inputs were made of, and when they were looked at.
  std::deque<std::pair<time_point, duration>> ages_;
  std::vector<source> sources_; // the oldest first
  first_response answers_;      // of cycles, by any of them
  std::optional<messages::standby> standby_;
  time_point began_;         // the latest cycle of a source that is fed always
  std::uint64_t timers_ = 0; // so many have been set
  std::uint64_t timer_ = 0;  // the one for a cycle's answer that counts
  std::uint64_t missing_timer_ = 0; // for a missing result; 0: none
  warm_standby warm_;
  bool own_runs_along_ = false;
  std::optional<messages::service_result> newest_own_; // since it runs along
  std::uint64_t last_own_cycle_ = 0;
  time_point believed_from_ =
      time_point::min();           // what it began before may go on from a lie
  messages::session_id watched_;   // by whose name the watchdog watches
  messages::service_input newest_; // of no session; with the result in use,
  messages::session_id used_from_; // the session that it is of,
  time_point used_at_;             // when it came,
  time_point used_input_at_;       // and when its input was made
  messages::work_record work_;     // since the last such record,
  time_point work_since_;          // which was then
  time_point now_ = time_point::min(); // of the latest call
};

} // namespace sofof::offloading

// A service: what vehicles and providers have to know of it to have it computed
// on either side. Inputs and results are opaque here.
#pragma once

#include "base/options/option_visitor.hpp"
#include "messages/protocol/qos.hpp"
#include "messages/protocol/record.hpp"
#include "messages/protocol/service.hpp"
#include "offloading/result_judge.hpp"
#include "offloading/service_function.hpp"
#include "world/vehicle/cycle_cost.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sofof::offloading {

/// The options that every service has.
struct service_options {
  messages::qos_limits limits; ///< Of the remote service.
  duration period{};           ///< Of a cycle, local and remote.
  duration input_period{};     ///< At least this between two inputs on the air.
  /// Whether each input has one result, whose latency begins with the input;
  /// else a result comes in every period, from the newest input.
  bool per_input = false;
  /// For so long around a change of source the vehicle's own function runs
  /// along: offloading/warm_standby.
  duration warm_standby{};
  world::cycle_options compute; ///< What a cycle asks of who computes it.
  /// The longest time from a cycle's start to its result on board, where
  /// functions share the vehicle's cores, duration::max() if nothing limits it;
  /// else a cycle takes its run time. No option: it follows from those of all.
  std::optional<duration> shared_response;
  /// Whether the scene says how late a result may be: `limits_in_scene`. The
  /// most that it may say is limits.max_latency, by which whoever does not see
  /// the scene goes: providers, schedules, policies.
  bool latency_by_scene = false;
  duration latency_floor = std::chrono::milliseconds{20}; ///< > 0; the least.

  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    latency_by_scene = s.word("max_latency", "scene", latency_by_scene);
    if (latency_by_scene) {
      s.field("max_latency_cap", limits.max_latency, duration{1});
      s.field("max_latency_floor", latency_floor, duration{1});
      if (latency_floor > limits.max_latency)
        s.refuse("max_latency_floor", "must not be more than "
                                      "`max_latency_cap`.");
    } else {
      s.field("max_latency", limits.max_latency, duration{1});
    }
    s.field("max_interarrival", limits.max_interarrival, duration{1});
    s.field("max_input_age", limits.max_input_age, duration{1});
    s.field("period", period, 1ms);
    s.field("input_period", input_period, 1ms);
    s.field("per_input", per_input);
    s.field("warm_standby", warm_standby, duration{0});
    for (const std::string key :
         {"demand", "run_time_mean", "run_time_sd", "run_time_max"})
      s.moved(key, "compute." + key);
    s.moved("task", "compute");
    s.table("compute", [this](option_visitor& t) { compute.visit_options(t); });
  }
};

/// @returns the options with run times as on this computer: in proportion to
/// its clock, on a slower one at most a period, since a cycle ends before the
/// next one begins.
service_options on(const world::computer_options& computer,
                   service_options options);

/// @returns what a vehicle has of a cycle that a provider computes, on average:
/// time, of an input's way there alone; energy, of the inputs that it sends for
/// it and of the framework.
world::cycle_cost offloaded_cost(const world::computer_options& computer,
                                 const service_options& options);

/// @returns the longest time from what a vehicle sees to the first result that
/// depends on it while a provider computes the service, as long as limits are
/// kept and until the own function has taken over when they are not:
/// max_input_age + max_interarrival + the longest run time of the own function,
/// or what it takes on shared cores; duration::max() if nothing limits the age
/// of inputs, or that.
/// @param options  With run times as on the vehicle's computer.
duration worst_response(const service_options& options);

/// @returns the longest time from an input to the first result that depends on
/// it while the vehicle computes the service itself: the longest run time, and
/// a period before it unless each input has a result of its own.
/// @param options  With run times as on the vehicle's computer.
duration own_response(const service_options& options);

/// @param safe     The longest response time under which the scene is safe.
/// @param options  With run times as on the vehicle's computer.
/// @returns what may be asked of a result that comes now, so that no response
/// takes longer, if it is the last one before a gap and the own function has to
/// take over: limits.max_latency and max_input_age are at most what the longest
/// gap and the own function's run time leave; nullopt if that is less than
/// `latency_floor`: then no result is to be waited for.
std::optional<messages::qos_limits>
limits_in_scene(const service_options& options, duration safe);

/// For which vehicle parts of a service are made.
struct vehicle_context {
  station_id station = 0;
  /// The time.
  std::function<time_point()> clock = [] { return time_point{}; };
  /// No time passes in a cycle, and what is left of one that has begun must not
  /// read the clock.
  bool virtual_time = false;
  /// Records what has happened to a function, in a turn of its own; may be
  /// empty.
  std::function<void(messages::event_record)> report{};
};

/// The longest response time under which a vehicle's scene is safe, from what
/// it sees to the first result that depends on it.
struct safe_response {
  duration longest{};
  std::string_view because; ///< Who or what asks for no longer one; a literal.
  /// Of the scene, when the input was made: in a chain it was sensed before.
  duration age{};
};

/// A service in one vehicle. It says the same whenever it is asked: where time
/// is real, more than one thread asks.
class vehicle_service {
public:
  virtual ~vehicle_service() = default;

  /// @returns what computes it on board; not null.
  virtual std::shared_ptr<service_function> make_function() const = 0;

  /// What of an input crosses the air to a provider; as it is, unless the
  /// service says it in messages of its own. `input.in_use` is the result in
  /// use.
  /// @param takes_over  Whether the provider is to take over from the source
  ///                    of the result in use.
  /// @returns nothing in `what` if there is nothing to say.
  virtual messages::service_input encode_input(messages::service_input input,
                                               bool takes_over) const;

  /// Whether results may come from one provider and from another in turns.
  /// @param in_use   The result in use.
  /// @param offered  The first one of another provider.
  virtual bool continues(const messages::payload& in_use,
                         const messages::payload& offered,
                         time_point now) const;

  /// @returns what reads and judges the results of one session; by default
  /// they are used as they are.
  virtual std::unique_ptr<result_judge> make_judge() const;

  /// @returns whether the service looks at scenes, or one of its chain does in
  /// its place; by default it does not.
  virtual bool looks_at_scenes() const { return false; }

  /// @param latest  The vehicle's newest input, of no session.
  /// @returns the longest response time under which the vehicle's scene is
  /// safe; nullopt if the service does not know, by default.
  virtual std::optional<safe_response>
  look_at_scene(const messages::service_input& latest) const;

  /// What tells a provider in the terms of the service that the vehicle ends a
  /// session; by default nothing.
  /// @param own  The vehicle's motion.
  virtual messages::payload
  termination_message(const messages::service_end& end, time_point now,
                      const messages::cam& own) const;
};

/// At which provider parts of a service are made.
struct provider_context {
  station_id station = 0; ///< As ITS messages name it.
  point position;         ///< m, east-north.
  /// The time.
  std::function<time_point()> clock = [] { return time_point{}; };
  provider_id id = 0;        ///< Another one after each start.
  bool virtual_time = false; ///< As in a vehicle.
  std::function<void(messages::event_record)> report{}; ///< Likewise.
  /// Where a provider is that rides with a vehicle; empty: one that stands.
  std::function<point()> rides{};

  point place() const { return rides ? rides() : position; } ///< Now.
};

/// A service at one provider. Where time is real, functions of several sessions
/// run at the same time, and the provider goes on: what they share must lock.
class provider_service {
public:
  virtual ~provider_service() = default;

  /// @returns what computes it for this vehicle; not null.
  virtual std::shared_ptr<service_function>
  make_function(station_id vehicle) = 0;

  /// @param route  The way ahead of a vehicle that asks.
  /// @returns why it cannot be served there, a short literal for the records;
  /// by default empty: it can.
  virtual std::string_view objection(std::span<const point> route) const;

  /// What tells a vehicle in the terms of the service that the provider ends a
  /// session; by default nothing.
  virtual messages::payload
  termination_message(const messages::service_end& end, time_point now);
};

/// A service that vehicles can leave to providers. What it needs of the world
/// besides its inputs, the functions have captured; each is never null.
struct service {
  messages::service_name name;
  service_options options;
  std::function<std::shared_ptr<vehicle_service>(const vehicle_context&)>
      in_vehicle;
  std::function<std::shared_ptr<provider_service>(const provider_context&)>
      at_provider;
  /// The service of whose results its inputs are made; empty: of none.
  messages::service_name follows{};
};

/// A service that one vehicle has.
struct onboard_service {
  messages::service_name name;
  service_options options;                    ///< Limits and period > 0.
  std::shared_ptr<const vehicle_service> own; ///< Not null.
  messages::service_name follows{}; ///< Of whose results its inputs are made.
};

/// A service that one provider has.
struct offered_service {
  messages::service_name name;
  service_options options;                ///< Limits and period > 0.
  std::shared_ptr<provider_service> here; ///< Not null.
  messages::service_name follows{}; ///< Of whose results its inputs are made.
};

/// @returns the service as that vehicle has it.
onboard_service in_vehicle(const service& what, const vehicle_context& where);

/// @returns the service as that provider has it.
offered_service at_provider(const service& what, const provider_context& where);

} // namespace sofof::offloading

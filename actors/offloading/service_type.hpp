// What the framework knows of a service: its name, limits and demand, how to
// run it, and who uses it. A new kind is one new file in actors/services.
#pragma once

#include "base/options/settings.hpp"
#include "base/random.hpp"
#include "messages/interfaces.hpp"
#include "messages/v2x/georeference.hpp"
#include "messages/v2x/object_list.hpp"
#include "offloading/result_judge.hpp"
#include "offloading/service_function.hpp"
#include "planners/plausibility/station_doubt.hpp"
#include "world/roads/streets.hpp"
#include "world/vehicle/cycle_cost.hpp"
#include "world/vehicle/vehicle.hpp"

#include <caf/actor_system.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace sofof {

/// The options that every kind has.
struct service_options {
  qos_limits limits;        ///< Of the remote service.
  duration period{};        ///< Of a cycle, local and remote.
  duration input_period{};  ///< At least this between two inputs on the air.
  double demand = 1;        ///< Provider's computing time, in units of the
                            ///< channel profile's service time.
  duration run_time_mean{}; ///< Of a local cycle, in virtual time, at
                            ///< `usual_clock_ghz`.
  duration run_time_sd{};
  duration run_time_max{};
  task_options task; ///< What a cycle asks of who computes it.

  void fields(settings& s);
};

/// @returns the options with run times as on this computer: in proportion to
/// its clock, on a slower one at most a period, since a cycle ends before the
/// next one begins.
service_options on(const computer_options& computer, service_options options);

/// What a provider knows beyond one vehicle's input; shared by all functions
/// of a kind there. Where time is real, functions run in threads of their own
/// while the provider goes on telling: an implementation must lock.
class provider_context {
public:
  virtual ~provider_context() = default;

  /// A CAM has come, from anybody near enough to be heard: in the area or not,
  /// perhaps with no service, perhaps overtaken by a later one on its way.
  virtual void hear(const cam& c, sender_id from) = 0;

  /// A CPM has come, likewise.
  virtual void hear(const object_list& told, sender_id from) = 0;

  /// One of the provider's sensors at the roadside has looked at the road.
  virtual void see(const roadside_detections& view) = 0;

  /// @returns which stations have come to be doubted or believed again since
  /// the last call, the oldest first.
  virtual std::vector<station_doubt> news() { return {}; }
};

/// Whose functions run at a provider, as ITS messages name it.
struct roadside_station {
  station_id station = 0;
  point position; ///< m, east-north.
};

/// For whom a function, a client or a site is made.
struct service_setup {
  streets_ptr world;
  georeference_ptr where; ///< Where that is on Earth.
  vehicle_params car = {};
  station_id station = 0;
  bool remote = false;
  random_stream noise{0, ""}; ///< A stream of its own.
  /// Whether the road grants crossings; else drivers judge them.
  bool crossings_granted = true;
  /// The time of the run; it stands still during a cycle unless run times are
  /// real.
  std::function<time_point()> clock = [] { return time_point{}; };
  /// The provider's; null in vehicles.
  std::shared_ptr<provider_context> site = nullptr;
  roadside_station provider{}; ///< Where it runs, if not in a vehicle.
};

/// A kind of service with its options.
class service_type {
public:
  virtual ~service_type() = default;

  virtual std::string_view name() const = 0;

  /// Lists the options, first the common ones.
  virtual void fields(settings& s) { common.fields(s); }

  virtual std::shared_ptr<service_function>
  make_function(const service_setup& setup) const = 0;

  /// @param vehicle  The vehicle that the client belongs to; a kind may
  ///                 return it when the vehicle itself is the user.
  virtual client_actor spawn_client(caf::actor_system& sys,
                                    const service_setup& setup,
                                    const vehicle_actor& vehicle) const = 0;

  /// Called once per provider; the setup names no station and no site.
  /// @returns what all functions of this kind at one provider share; null if
  /// that is nothing.
  virtual std::shared_ptr<provider_context>
  make_site(const service_setup&) const {
    return nullptr;
  }

  /// What of an input crosses the air to a provider; as it is, unless a kind
  /// says it in messages of its own. `input.in_use` is the result in use.
  /// @param setup       The vehicle's.
  /// @param takes_over  Whether the provider is to take over from the source
  ///                    of the result in use.
  virtual service_input on_air(const service_setup& setup, service_input input,
                               bool takes_over) const {
    static_cast<void>(setup);
    if (!takes_over)
      input.in_use = {};
    return input;
  }

  /// Whether results may come from one provider and from another in turns.
  /// @param in_use   The result in use.
  /// @param offered  The first one of another provider.
  virtual bool continues(const payload& in_use, const payload& offered,
                         time_point now) const {
    static_cast<void>(in_use);
    static_cast<void>(offered);
    static_cast<void>(now);
    return true;
  }

  /// @param setup  The vehicle's.
  /// @returns what reads and judges the results of one running service; by
  /// default results are used as they are.
  virtual std::unique_ptr<result_judge>
  make_judge(const service_setup& setup) const;

  /// What says in the terms of the service that it has ended; nothing, unless
  /// a kind has such a message.
  /// @param setup  Of the side that ends it.
  /// @param now    When.
  /// @param own    The vehicle's motion, on its side.
  virtual payload termination_message(const service_setup& setup,
                                      const service_end& end, time_point now,
                                      const cam* own) const {
    static_cast<void>(setup), static_cast<void>(end);
    static_cast<void>(now), static_cast<void>(own);
    return {};
  }

  service_options common;
};

using service_type_ptr = std::shared_ptr<service_type>;

/// @returns the kind with its default options; null for an unknown name.
service_type_ptr make_service_kind(std::string_view name);

/// @returns the names of all kinds, sorted.
std::vector<std::string_view> service_kind_names();

} // namespace sofof

// The services of this project by name, as scenarios list them. A new one is
// one new file in this folder.
#pragma once

#include "actors/services/planning/known_others.hpp"
#include "actors/services/programs/program_options.hpp"
#include "actors/simulation/plan_client.hpp"
#include "base/options/option_visitor.hpp"
#include "messages/v2x/georeference.hpp"
#include "offloading/service.hpp"
#include "planners/safety/rss.hpp"
#include "world/roads/streets.hpp"
#include "world/sensing/sensors.hpp"
#include "world/sensing/viewpoint.hpp"
#include "world/vehicle/vehicle.hpp"

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace sofof::actors {

/// What services may know of the world that they run in.
struct service_world {
  world::streets_ptr streets;
  messages::georeference_ptr where; ///< Where that is on Earth.
  world::vehicle_params car{};      ///< Each vehicle.
  /// Whether the road grants crossings; else drivers judge them.
  bool crossings_granted = true;
  world::sensor_params eyes{};            ///< Of each vehicle.
  std::vector<world::viewpoint> roadside; ///< Sensors of the provider there.
  planners::rss_assumptions rss{};        ///< How vehicles move at worst.
  /// What the services of a chain share at providers.
  std::shared_ptr<functions_beside> beside =
      std::make_shared<functions_beside>();
  /// What the provider there runs in place of programs of services.
  std::vector<program_at_provider> programs{};
};

// actors/simulation/service_client.hpp has both.
struct client_place;
struct service_client;

/// A service with its options, before it knows the world.
class service_type {
public:
  virtual ~service_type() = default;

  virtual std::string_view name() const = 0;

  /// Lists the options, first the common ones.
  virtual void visit_options(option_visitor& s) { options.visit_options(s); }

  /// @returns the service of whose results it is made inputs, if both are
  /// there: they are a chain then; empty: of none.
  virtual std::string_view follows() const { return {}; }

  /// @returns the service with these options in this world.
  virtual offloading::service in(const service_world& world) const = 0;

  /// @returns who asks it in a vehicle and uses its results. The vehicle is
  /// itself the client of the service that has `plans`, and of no other.
  virtual service_client spawn_client(const client_place& where) const = 0;

  /// @returns how vehicles ask it for plans to drive by; null for a service
  /// that makes none.
  virtual std::shared_ptr<const plan_client> plans() const { return nullptr; }

  /// Reads files that it needs to run.
  /// @param beside  The folder of the scenario.
  /// @throws std::invalid_argument in words for the user.
  virtual void load(const std::filesystem::path& /*beside*/) {}

  /// @returns the files that results depend on, besides what is built in.
  virtual std::vector<std::filesystem::path> files() const { return {}; }

  /// @returns whether its function is a program, and its name the scenario's.
  virtual bool is_program() const { return false; }

  /// Gives a program its name.
  virtual void be_called(std::string_view /*name*/) {}

  /// @returns the program whose results are its inputs; empty: none.
  virtual std::string_view uses_results_of() const { return {}; }

  /// @returns how vehicles move at worst, as whoever looks at their scenes
  /// assumes it: what the service with `plans` says holds for all.
  virtual planners::rss_assumptions assumed() const { return {}; }

  offloading::service_options options;
};

using service_type_ptr = std::shared_ptr<service_type>;

/// @returns the service with its default options; null for an unknown name.
service_type_ptr make_service_type(std::string_view name);

/// @returns the names of all services, sorted.
std::vector<std::string_view> service_type_names();

} // namespace sofof::actors

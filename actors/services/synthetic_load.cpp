// Load as a service: inputs and results of a stated size and computing time,
// which tell nobody anything. For studies of cells, uplinks and servers, where
// a function that is not there yet, say on camera images, is to be weighed.
#include "actors/runtime/time.hpp"
#include "actors/services/service_type.hpp"
#include "actors/simulation/service_client.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace sofof::actors {

/// What is sent up or down: so many octets.
struct load_octets {
  std::vector<std::byte> octets;
};

void visit_fields(auto& v, load_octets& x) {
  v("octets", x.octets);
}

} // namespace sofof::actors

template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::actors::load_octets> = "load_octets";

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

messages::payload octets(std::int64_t count) {
  return messages::payload::of(
      load_octets{std::vector<std::byte>(static_cast<std::size_t>(count))});
}

/// Answers whatever comes with as many octets.
class load_function final : public offloading::service_function {
public:
  explicit load_function(std::int64_t result_octets)
      : result_{octets(result_octets)} {}

  offloading::service_output
  run(time_point, const messages::service_input& input) override {
    return input.what.as<load_octets>() ? result_ : messages::payload{};
  }

private:
  messages::payload result_; // of every cycle; copies share it
};

struct load_in_vehicle final : offloading::vehicle_service {
  explicit load_in_vehicle(std::int64_t n) : result_octets{n} {}
  std::shared_ptr<offloading::service_function> make_function() const override {
    return std::make_shared<load_function>(result_octets);
  }
  std::int64_t result_octets;
};

struct load_at_provider final : offloading::provider_service {
  explicit load_at_provider(std::int64_t n) : result_octets{n} {}
  std::shared_ptr<offloading::service_function>
  make_function(station_id) override {
    return std::make_shared<load_function>(result_octets);
  }
  std::int64_t result_octets;
};

// Sends an input every period.
using source_impl =
    messages::client_actor::extend<messages::reacts_to<messages::tick_atom>>;

struct source_state {
  static inline const char* name = "synthetic_load";

  source_impl::stateful_pointer<source_state> self;
  messages::payload input; // of every period; copies share it
  duration period{};
  messages::requester_manager_actor manager;

  void tick() {
    send_at(self, self, now(self) + period, messages::tick_atom_v);
    if (manager)
      self->send(manager, messages::service_input{
                              .session = {}, .at = now(self), .what = input});
  }
};

source_impl::behavior_type
load_source(source_impl::stateful_pointer<source_state> self,
            messages::payload input, duration period) {
  auto& state = self->state;
  state.self = self;
  state.input = std::move(input);
  state.period = period;
  self->send(self, messages::tick_atom_v);
  return {
      [](const messages::service_result&) {},
      [](const messages::source_change&) {},
      [self](const messages::requester_manager_actor& manager) {
        self->state.manager = manager;
      },
      [self](messages::tick_atom) { self->state.tick(); },
  };
}

class synthetic_load final : public service_type {
public:
  synthetic_load() {
    options.limits = {150ms, 300ms, 500ms};
    options.period = 100ms;
    options.input_period = 100ms;
    options.compute = {.run_time_mean = 60ms,
                       .run_time_sd = 5ms,
                       .run_time_max = 90ms,
                       .demand = {},
                       .input_octets = 50'000};
  }

  std::string_view name() const override { return "synthetic_load"; }

  void visit_options(option_visitor& s) override {
    s.moved("input_octets", "compute.input_octets");
    service_type::visit_options(s);
    s.field("result_octets", result_octets_, {0, most_octets});
  }

  // The world is nothing to it.
  offloading::service in(const service_world&) const override {
    return {.name = name(),
            .options = options,
            .in_vehicle =
                [n = result_octets_](const auto&) {
                  return std::make_shared<load_in_vehicle>(n);
                },
            .at_provider =
                [n = result_octets_](const auto&) {
                  return std::make_shared<load_at_provider>(n);
                }};
  }

  service_client spawn_client(const client_place& where) const override {
    return {where.system.spawn(load_source,
                               octets(options.compute.input_octets),
                               options.input_period)};
  }

private:
  static constexpr double most_octets = 1e7;

  std::int64_t result_octets_ = 1'000;
};

} // namespace

service_type_ptr service_synthetic_load() {
  return std::make_shared<synthetic_load>();
}

} // namespace sofof::actors

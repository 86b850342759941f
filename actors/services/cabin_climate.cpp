// Cabin climate as a service: a thermal model of the cabin is its client, the
// choice of heating or cooling power its function.
#include "actors/offloading/service_type.hpp"
#include "actors/runtime/time.hpp"
#include "messages/type_ids.hpp"
#include "planners/judges/climate_judge.hpp"
#include "world/vehicle/cabin.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

namespace sofof {

namespace {

using namespace std::chrono_literals;

/// Which power makes this cabin comfortable?
struct climate_request {
  double air_c = 0;
  double mass_c = 0;
  double outside_c = 0;
  double set_point_c = 0;
};

/// This one.
struct climate_power {
  double power_w = 0; ///< Negative cools.
};

void archive(auto& bytes, climate_request& x) {
  bytes(x.air_c, x.mass_c, x.outside_c, x.set_point_c);
}

void archive(auto& bytes, climate_power& x) {
  bytes(x.power_w);
}

} // namespace

template <>
inline constexpr std::string_view payload_name<climate_request> = "climate_ask";
template <>
inline constexpr std::string_view payload_name<climate_power> = "climate_power";

namespace {

struct climate_options {
  double outside_c = 5;
  double set_point_c = 21;
  double horizon_s = 60;
  cabin_params cabin;

  void fields(settings& s) {
    s.field("outside_c", outside_c, {-60, 60});
    s.field("set_point_c", set_point_c, {10, 30});
    s.field("horizon_s", horizon_s, {1, 3600});
    s.table("cabin", [this](settings& t) { cabin.fields(t); });
  }
};

class climate_function final : public service_function {
public:
  explicit climate_function(const climate_options& options)
      : options_{options} {}

  service_output run(time_point, const service_input& input) override {
    const auto ask = input.what.as<climate_request>();
    if (!ask)
      return {};
    return payload::of(climate_power{
        climate_power_w({ask->air_c, ask->mass_c}, ask->outside_c,
                        ask->set_point_c, options_.horizon_s, options_.cabin)});
  }

private:
  climate_options options_;
};

/// Compares a power with what the own function would do now.
class power_judge final : public result_judge {
public:
  explicit power_judge(const climate_options& options) : options_{options} {}

  judged_result judge(const payload& result, const service_input& latest,
                      time_point) override {
    const auto ask = latest.what.as<climate_request>();
    const auto answer = result.as<climate_power>();
    if (!ask)
      return {};
    if (!answer)
      return {{}, objection{"readable", 0, 1}};
    const judged_climate x{{ask->air_c, ask->mass_c},
                           ask->outside_c,
                           ask->set_point_c,
                           options_.horizon_s};
    if (const auto why = judge_climate(answer->power_w, x, options_.cabin))
      return {{}, why};
    left_ = {"comfort_w", climate_margin_w(answer->power_w, x, options_.cabin)};
    return {result, {}, {}, {&left_, 1}};
  }

private:
  climate_options options_;
  margin left_;
};

// The air in the car, warmed with whatever power came last.
using cabin_impl = client_actor::extend<reacts_to<tick_atom>>;

struct cabin_actor_state {
  static inline const char* name = "cabin";

  cabin_impl::stateful_pointer<cabin_actor_state> self;
  climate_options options;
  duration period{};
  requester_manager_actor manager;
  cabin_state air;
  double power_w = 0;

  void tick() {
    const auto t = now(self);
    send_at(self, self, t + period, tick_atom_v);
    air = step(air, power_w, options.outside_c, options.cabin,
               to_seconds(period));
    ask();
  }

  void ask() {
    if (manager)
      self->send(manager,
                 service_input{{},
                               now(self),
                               payload::of(climate_request{
                                   air.air_c, air.mass_c, options.outside_c,
                                   options.set_point_c})});
  }

  void on_result(const service_result& result) {
    if (const auto answer = result.what.as<climate_power>())
      power_w = answer->power_w;
  }
};

cabin_impl::behavior_type
cabin(cabin_impl::stateful_pointer<cabin_actor_state> self,
      climate_options options, duration period) {
  auto& state = self->state;
  state.self = self;
  state.options = options;
  state.period = period;
  state.air = {options.outside_c, options.outside_c};
  self->send(self, tick_atom_v);
  return {
      [self](const service_result& result) { self->state.on_result(result); },
      [](const source_change&) {},
      [self](const requester_manager_actor& manager) {
        self->state.manager = manager;
        self->state.ask();
      },
      [self](tick_atom) { self->state.tick(); },
  };
}

class cabin_climate final : public service_type {
public:
  cabin_climate() {
    common.limits = {2s, 5s};
    common.period = 1s;
    common.input_period = 1s;
    common.demand = 0.02;
    common.run_time_mean = 200us;
    common.run_time_sd = 50us;
    common.run_time_max = 1ms;
    common.task = {.gigacycles = 6e-4, .input_kbit = 1}; // 200 us at 3 GHz
  }

  std::string_view name() const override { return "cabin_climate"; }

  void fields(settings& s) override {
    service_type::fields(s);
    options_.fields(s);
  }

  std::shared_ptr<service_function>
  make_function(const service_setup&) const override {
    return std::make_shared<climate_function>(options_);
  }

  client_actor spawn_client(caf::actor_system& sys, const service_setup&,
                            const vehicle_actor&) const override {
    return sys.spawn(cabin, options_, common.period);
  }

  std::unique_ptr<result_judge>
  make_judge(const service_setup&) const override {
    return std::make_unique<power_judge>(options_);
  }

private:
  climate_options options_;
};

} // namespace

service_type_ptr make_cabin_climate() {
  return std::make_shared<cabin_climate>();
}

} // namespace sofof

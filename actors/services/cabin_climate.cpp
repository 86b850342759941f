// Cabin climate as a service: a thermal model of the cabin is its client, the
// choice of heating or cooling power its function.
#include "actors/services/climate/cabin.hpp"
#include "actors/services/service_type.hpp"
#include "actors/simulation/service_client.hpp"
#include "planners/judges/climate_judge.hpp"

#include <chrono>
#include <memory>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

class climate_function final : public offloading::service_function {
public:
  explicit climate_function(const climate_options& options)
      : options_{options} {}

  offloading::service_output
  run(time_point, const messages::service_input& input) override {
    const auto ask = input.what.as<climate_request>();
    if (!ask)
      return {};
    return messages::payload::of(climate_power{world::climate_power_w(
        {ask->air_c, ask->mass_c}, ask->outside_c, ask->set_point_c,
        options_.horizon_s, options_.cabin)});
  }

private:
  climate_options options_;
};

/// Compares a power with what the own function would do now.
class power_judge final : public offloading::result_judge {
public:
  explicit power_judge(const climate_options& options) : options_{options} {}

  offloading::judged_result judge(const messages::payload& result,
                                  const messages::service_input& latest,
                                  time_point) override {
    const auto ask = latest.what.as<climate_request>();
    const auto answer = result.as<climate_power>();
    if (!ask)
      return {};
    if (!answer)
      return {{}, objection{"readable", 0, 1}};
    const planners::judged_climate x{{ask->air_c, ask->mass_c},
                                     ask->outside_c,
                                     ask->set_point_c,
                                     options_.horizon_s};
    if (const auto why =
            planners::judge_climate(answer->power_w, x, options_.cabin))
      return {{}, why};
    left_ = {"comfort_w",
             planners::climate_margin_w(answer->power_w, x, options_.cabin)};
    return {result, {}, {}, {&left_, 1}};
  }

private:
  climate_options options_;
  margin left_;
};

class climate_in_vehicle final : public offloading::vehicle_service {
public:
  explicit climate_in_vehicle(const climate_options& options)
      : options_{options} {}

  std::shared_ptr<offloading::service_function> make_function() const override {
    return std::make_shared<climate_function>(options_);
  }
  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return std::make_unique<power_judge>(options_);
  }

private:
  climate_options options_;
};

class climate_at_provider final : public offloading::provider_service {
public:
  explicit climate_at_provider(const climate_options& options)
      : options_{options} {}

  std::shared_ptr<offloading::service_function>
  make_function(station_id) override {
    return std::make_shared<climate_function>(options_);
  }

private:
  climate_options options_;
};

class cabin_climate final : public service_type {
public:
  cabin_climate() {
    options.limits = {2s, 5s, 5s};
    options.period = 1s;
    options.input_period = 1s;
    options.compute = {.run_time_mean = 200us,
                       .run_time_sd = 50us,
                       .run_time_max = 1ms,
                       .demand = {},
                       .input_octets = 86}; // on the air, measured
  }

  std::string_view name() const override { return "cabin_climate"; }

  void visit_options(option_visitor& s) override {
    service_type::visit_options(s);
    climate_.visit_options(s);
  }

  // The world is nothing to it.
  offloading::service in(const service_world&) const override {
    return {.name = name(),
            .options = options,
            .in_vehicle =
                [climate = climate_](const auto&) {
                  return std::make_shared<climate_in_vehicle>(climate);
                },
            .at_provider =
                [climate = climate_](const auto&) {
                  return std::make_shared<climate_at_provider>(climate);
                }};
  }

  service_client spawn_client(const client_place& where) const override {
    return {spawn_cabin(where.system, climate_, options.period)};
  }

private:
  climate_options climate_;
};

} // namespace

service_type_ptr service_cabin_climate() {
  return std::make_shared<cabin_climate>();
}

} // namespace sofof::actors

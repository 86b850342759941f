// The smallest service there is, for tests of the framework.
#pragma once

#include "actors/offloading/service_type.hpp"
#include "tests/support/echo.hpp"

#include <memory>
#include <string>

namespace sofof::test {

/// Gives back its input, period by period. Its client is the vehicle's actor.
class echo_service : public service_type {
public:
  explicit echo_service(std::string name) : name_{std::move(name)} {
    using namespace std::chrono_literals;
    common.limits = {50ms, 100ms};
    common.period = 50ms;
    common.input_period = 100ms;
    common.run_time_mean = 5ms;
    common.run_time_max = 10ms;
  }

  std::string_view name() const override { return name_; }

  std::shared_ptr<service_function>
  make_function(const service_setup&) const override {
    struct function final : service_function {
      service_output run(time_point, const service_input& input) override {
        return input.what;
      }
    };
    return std::make_shared<function>();
  }

  client_actor spawn_client(caf::actor_system&, const service_setup&,
                            const vehicle_actor& vehicle) const override {
    return vehicle;
  }

  bool continues(const payload&, const payload& offered,
                 time_point) const override {
    const auto said = offered.as<echo>();
    return !said || said->number != echo::jump;
  }

  std::unique_ptr<result_judge>
  make_judge(const service_setup&) const override {
    struct sceptic final : result_judge {
      judged_result judge(const payload& result, const service_input&,
                          time_point) override {
        const auto said = result.as<echo>();
        if (said && said->number == echo::lie)
          return {{}, objection{"number", 2, 1}};
        if (said && said->number == echo::useless)
          return {{}, {}, objection{"use", 0, 1}};
        return {result};
      }
    };
    return std::make_unique<sceptic>();
  }

private:
  std::string name_;
};

/// An echo whose messages on the air are ITS messages, of the number and of
/// whether it takes over; at its end it says which side ends it.
class its_echo final : public echo_service {
public:
  using echo_service::echo_service;

  service_input on_air(const service_setup&, service_input input,
                       bool takes_over) const override {
    const auto said = input.what.as<echo>();
    input.what = said ? octets(said->number, takes_over) : payload{};
    input.in_use = {};
    return input;
  }
  payload termination_message(const service_setup& setup, const service_end&,
                              time_point, const cam* own) const override {
    return octets(setup.remote, own != nullptr);
  }

  static payload octets(std::uint64_t first, bool second) {
    return payload::of(its_pdu{
        {static_cast<std::byte>(first), static_cast<std::byte>(second)}});
  }
};

} // namespace sofof::test

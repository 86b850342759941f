// The smallest service there is, for tests of the framework.
#pragma once

#include "messages/protocol/its_pdu.hpp"
#include "offloading/service.hpp"
#include "tests/support/echo.hpp"

#include <memory>

namespace sofof::test {

struct echo_function final : offloading::service_function {
  offloading::service_output
  run(time_point, const messages::service_input& input) override {
    return input.what;
  }
};

/// Gives back its input. Its numbers can be refused, useless, or a jump.
struct echo_in_vehicle : offloading::vehicle_service {
  std::shared_ptr<offloading::service_function> make_function() const override {
    return std::make_shared<echo_function>();
  }

  bool continues(const messages::payload&, const messages::payload& offered,
                 time_point) const override {
    const auto said = offered.as<echo>();
    return !said || said->number != echo::jump;
  }

  std::unique_ptr<offloading::result_judge> make_judge() const override {
    struct sceptic final : offloading::result_judge {
      offloading::judged_result judge(const messages::payload& result,
                                      const messages::service_input&,
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
};

struct echo_at_provider : offloading::provider_service {
  std::shared_ptr<offloading::service_function>
  make_function(station_id) override {
    return std::make_shared<echo_function>();
  }
};

inline offloading::service_options echo_options() {
  using namespace std::chrono_literals;
  offloading::service_options options;
  options.limits = {50ms, 100ms};
  options.period = 50ms;
  options.input_period = 100ms;
  options.compute.run_time_mean = 5ms;
  options.compute.demand = 1;
  options.compute.run_time_max = 10ms;
  return options;
}

/// Gives back its input, period by period.
inline offloading::service echo_service(messages::service_name name) {
  return {.name = name,
          .options = echo_options(),
          .in_vehicle =
              [](const auto&) { return std::make_shared<echo_in_vehicle>(); },
          .at_provider =
              [](const auto&) { return std::make_shared<echo_at_provider>(); }};
}

/// What its messages on the air say: octets that can be told apart.
inline messages::payload its_octets(std::uint64_t first, bool second) {
  return messages::payload::of(messages::its_pdu{
      {static_cast<std::byte>(first), static_cast<std::byte>(second)}});
}

/// Says its number and whether it takes over; at its end, which side ends it.
struct its_echo_in_vehicle final : echo_in_vehicle {
  messages::service_input encode_input(messages::service_input input,
                                       bool takes_over) const override {
    const auto said = input.what.as<echo>();
    input.what =
        said ? its_octets(said->number, takes_over) : messages::payload{};
    input.in_use = {};
    return input;
  }
  messages::payload termination_message(const messages::service_end&,
                                        time_point,
                                        const messages::cam&) const override {
    return its_octets(0, true);
  }
};

struct its_echo_at_provider final : echo_at_provider {
  messages::payload termination_message(const messages::service_end&,
                                        time_point) override {
    return its_octets(1, false);
  }
};

/// An echo whose messages on the air are ITS messages.
inline offloading::service its_echo(messages::service_name name) {
  return {
      .name = name,
      .options = echo_options(),
      .in_vehicle =
          [](const auto&) { return std::make_shared<its_echo_in_vehicle>(); },
      .at_provider =
          [](const auto&) { return std::make_shared<its_echo_at_provider>(); }};
}

} // namespace sofof::test

// A service manager in a vehicle, whose clients and peers are probes.
#pragma once

#include "actors/offloading/service_manager.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <optional>
#include <utility>

namespace sofof::test {

/// Understands echoes alone, and believes as they do.
struct echo_judge final : offloading::result_judge {
  std::unique_ptr<offloading::result_judge> believes =
      echo_in_vehicle{}.make_judge();

  offloading::judged_result judge(const messages::payload& result,
                                  const messages::service_input& latest,
                                  time_point now) override {
    if (!result.as<echo>())
      return {};
    return believes->judge(result, latest, now);
  }
};

/// An echo that is told whether it says ITS messages on the air.
struct quiet_echo final : echo_in_vehicle {
  std::shared_ptr<echo_in_vehicle> speaks;

  messages::service_input encode_input(messages::service_input input,
                                       bool takes_over) const override {
    return speaks ? speaks->encode_input(std::move(input), takes_over)
                  : echo_in_vehicle::encode_input(std::move(input), takes_over);
  }
  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return std::make_unique<echo_judge>();
  }
};

/// A manager whose local service runs every 50 ms and takes 5 ms; its clients
/// and peers are probes.
struct managed_world : virtual_world {
  const messages::session_id running{1, 101, "echo", 7};
  const messages::session_id next_running{1, 101, "echo", 8};
  std::shared_ptr<quiet_echo> service = std::make_shared<quiet_echo>();
  probe<messages::client_actor> client = listen<messages::client_actor>();
  probe<messages::onboard_requester_actor> requester =
      listen<messages::onboard_requester_actor>();
  probe<messages::recorder_actor> recorder = listen<messages::recorder_actor>();
  probe<messages::provider_manager_actor> there =
      listen<messages::provider_manager_actor>();
  messages::requester_manager_actor manager;

  explicit managed_world(duration warm_standby = {})
      : manager{spawn(warm_standby)} {
    settle();
  }

  messages::requester_manager_actor spawn(duration warm_standby) {
    auto options = echo_options();
    options.warm_standby = warm_standby;
    actors::requester_manager_setup setup;
    setup.station = 101;
    setup.service = {"echo", options, service};
    setup.local.session = {0, 101, "echo", 0};
    setup.local.function = service->make_function();
    setup.local.period = 50ms;
    setup.local.finish = [](time_point start, std::uint64_t) {
      return start + 5ms;
    };
    setup.client = client.handle;
    setup.requester = requester.handle;
    setup.recorder = recorder.handle;
    return own(actors::spawn_requester_manager(system(), std::move(setup)));
  }

  void feed(std::uint64_t number) {
    tell(manager, messages::service_input{
                      {}, now(), messages::payload::of(echo{number})});
  }
  void accept(const messages::session_id& r) { tell(manager, r, there.handle); }
  void result(std::uint64_t cycle, duration latency = 10ms) {
    result_of(running, cycle, latency);
  }
  void result_of(const messages::session_id& r, std::uint64_t cycle,
                 duration latency = 10ms) {
    tell(manager,
         messages::service_result{r, cycle, now() - latency,
                                  messages::payload::of(echo{1000 + cycle})});
  }
  void uncertain_result(std::uint64_t cycle, duration doubt) {
    tell(manager,
         messages::service_result{running,
                                  cycle,
                                  now() - 10ms,
                                  messages::payload::of(echo{1000 + cycle}),
                                  {},
                                  doubt});
  }
  void end() { tell(manager, messages::service_end{running}); }

  /// Runs until the remote source is in use.
  void go_remote() {
    feed(1);
    run_for(1s);
    accept(running);
    result(1);
    REQUIRE(source() == true);
  }

  /// @returns whether the remote source is in use, if it ever changed.
  std::optional<bool> source() const {
    const auto changes = client->all<messages::source_change>();
    return changes.empty() ? std::nullopt
                           : std::optional{changes.back().remote};
  }
  std::size_t results(bool remote) const {
    std::size_t n = 0;
    for (const auto& r : client->all<messages::service_result>())
      n += r.session.is_remote() == remote;
    return n;
  }
};

} // namespace sofof::test

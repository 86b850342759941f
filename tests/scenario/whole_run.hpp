// A scenario played in virtual time, and trajectory planning to look into.
#pragma once

#include "actors/offloading/service_type.hpp"
#include "scenario/build.hpp"
#include "scenario/runtime.hpp"
#include "tests/support/memory_sink.hpp"

#include <memory>
#include <string_view>
#include <utility>

namespace sofof::test {

/// @returns the records of a whole run.
inline memory_sink play(const scenario& s) {
  auto records = std::make_shared<memory_sink>();
  const auto time = make_virtual_runtime();
  const auto actors = build(time->system(), s, records, time->clock(), true);
  time->run_until(time->now() + s.length);
  dismiss(actors, *time);
  return *records;
}

/// Trajectory planning with its default options.
class plain_planning : public service_type {
public:
  plain_planning() { common = real_->common; }

  std::string_view name() const override { return real_->name(); }

  std::shared_ptr<service_function>
  make_function(const service_setup& setup) const override {
    return real_->make_function(setup);
  }

  client_actor spawn_client(caf::actor_system& sys, const service_setup& setup,
                            const vehicle_actor& vehicle) const override {
    return real_->spawn_client(sys, setup, vehicle);
  }

  std::shared_ptr<provider_context>
  make_site(const service_setup& setup) const override {
    return real_->make_site(setup);
  }

  service_input on_air(const service_setup& setup, service_input input,
                       bool takes_over) const override {
    return real_->on_air(setup, std::move(input), takes_over);
  }

  payload termination_message(const service_setup& setup,
                              const service_end& end, time_point now,
                              const cam* own) const override {
    return real_->termination_message(setup, end, now, own);
  }

private:
  service_type_ptr real_ = make_service_kind("trajectory_planning");
};

} // namespace sofof::test

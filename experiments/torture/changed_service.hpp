// A service of the project with a change, for runs in which something is wrong.
#pragma once

#include "actors/offloading/broadcast_listener.hpp"
#include "actors/services/service_type.hpp"
#include "actors/simulation/service_client.hpp"

#include <functional>
#include <memory>
#include <string_view>
#include <utility>

namespace sofof::experiments::torture {

/// As the real one, but for what `change` makes of it in each run.
class changed_service final : public actors::service_type {
public:
  using change =
      std::function<void(offloading::service&, const actors::service_world&)>;

  changed_service(actors::service_type_ptr real, change how)
      : real_{std::move(real)}, how_{std::move(how)} {
    options = real_->options;
  }

  std::string_view name() const override { return real_->name(); }
  std::string_view follows() const override { return real_->follows(); }
  void visit_options(option_visitor& s) override { real_->visit_options(s); }
  offloading::service in(const actors::service_world& world) const override {
    auto service = real_->in(world);
    how_(service, world);
    return service;
  }
  actors::service_client
  spawn_client(const actors::client_place& where) const override {
    return real_->spawn_client(where);
  }
  std::shared_ptr<const actors::plan_client> plans() const override {
    return real_->plans();
  }
  planners::rss_assumptions assumed() const override {
    return real_->assumed();
  }

private:
  actors::service_type_ptr real_;
  change how_;
};

/// As the real one at a provider; for changes.
class real_at_provider : public actors::listening_service {
public:
  explicit real_at_provider(std::shared_ptr<offloading::provider_service> real)
      : real_{std::move(real)} {}

  std::shared_ptr<offloading::service_function>
  make_function(station_id vehicle) override {
    return real_->make_function(vehicle);
  }
  std::string_view objection(std::span<const point> route) const override {
    return real_->objection(route);
  }
  messages::payload termination_message(const messages::service_end& end,
                                        time_point now) override {
    return real_->termination_message(end, now);
  }
  actors::broadcast_listener* listener() override {
    return actors::listener_of(*real_);
  }

private:
  std::shared_ptr<offloading::provider_service> real_;
};

} // namespace sofof::experiments::torture

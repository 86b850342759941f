// The parts of a vehicle's side, and what each tells the others.
#include "offloading/vehicle_side.hpp"

#include <cassert>
#include <utility>

namespace sofof::offloading {

class vehicle_side::parts final : public requester_port {
public:
  parts(vehicle_side_setup setup, vehicle_port& port, time_point now)
      : port_{port} {
    requester_setup asks;
    asks.station = setup.station;
    asks.policy = std::move(setup.policy);
    asks.noise = setup.noise;
    asks.path_ahead = std::move(setup.path_ahead);
    for (auto& service : setup.services) {
      asks.services.push_back(service.requested);
      const auto name = service.requested.name;
      services_.emplace(name, std::make_unique<service_parts>(
                                  *this, setup.station, std::move(service)));
    }
    requester_.emplace(std::move(asks), *this, now);
    for (auto& [name, service] : services_)
      service->start();
    turns_.run(now);
  }

  void on_motion(const ego_state& ego) { requester_->on_motion(ego); }

  void on_input(const service_name& service, service_input input,
                time_point now) {
    if (const auto i = services_.find(service); i != services_.end())
      i->second->on_input(std::move(input));
    turns_.run(now);
  }

  void on_message(peer_id from, to_vehicle message, time_point now) {
    turns_.post(part_, [this, from, x = std::move(message)](time_point t) {
      std::visit([&](const auto& y) { handle(from, y, t); }, x);
    });
    turns_.run(now);
  }

  void on_lost(peer_id provider, time_point now) {
    tell_requester(
        [provider](requester& x, time_point t) { x.on_lost(provider, t); });
    turns_.run(now);
  }

  void on_timer(std::uint64_t number, time_point now) {
    turns_.wake(number);
    turns_.run(now);
  }

  void shut_down(time_point now) {
    tell_requester([](requester& x, time_point t) { x.shut_down(t); });
    turns_.run(now);
  }

private:
  struct service_parts;

  /// What the vehicle's own function wants.
  struct own_port final : cycle_port {
    service_parts& service;
    explicit own_port(service_parts& x) : service{x} {}
    void wake_at(time_point t, std::uint64_t number) override;
    void deliver_at(time_point t, service_result result) override;
  };

  /// A selector, its watchdog, and the vehicle's own function.
  struct service_parts final : selector_port {
    parts& all;
    service_name name;
    std::function<std::unique_ptr<result_judge>()> make_judge;
    turn_queue::part selects = turn_queue::make_part(),
                     watches = turn_queue::make_part(),
                     runs = turn_queue::make_part();
    source_selector selector;
    watchdog dog;
    std::uint64_t dog_timer = 0; // the one that counts
    own_port wants{*this};
    service_cycle own;

    service_parts(parts& owner, station_id station, onboard_service service)
        : all{owner}, name{service.requested.name}, make_judge{std::move(
                                                        service.make_judge)},
          selector{{station,
                    name,
                    {service.requested.needs.max_latency,
                     service.requested.needs.max_interarrival},
                    service.requested.needs.period,
                    service.input_period,
                    service.record_margins,
                    std::move(service.encode_input),
                    std::move(service.continues)},
                   *this},
          dog{{service.requested.needs.max_latency,
               service.requested.needs.max_interarrival}},
          own{{.running = {0, station, name, 0},
               .function = std::move(service.function),
               .period = service.requested.needs.period,
               .phase = service.phase,
               .finish = std::move(service.finish)},
              wants} {}

    template <class Function>
    void tell_selector(Function what) {
      all.turns_.post(selects,
                      [this, what = std::move(what)](time_point t) mutable {
                        what(selector, t);
                      });
    }
    template <class Function>
    void tell_own(Function what) {
      all.turns_.post(runs, [this, what = std::move(what)](
                                time_point t) mutable { what(own, t); });
    }

    void start() {
      for (const auto step :
           {lifecycle_step::configure, lifecycle_step::activate})
        tell_own(
            [step](service_cycle& x, time_point t) { x.on_step(step, t); });
    }
    void on_input(service_input input) {
      tell_selector(
          [input = std::move(input)](source_selector& x, time_point t) mutable {
            x.on_input(std::move(input), t);
          });
    }

    // -- what the selector wants ----------------------------------------------

    void feed_local(const service_input& input) override {
      tell_own([input](service_cycle& x, time_point t) mutable {
        x.on_input(std::move(input), t);
      });
    }
    void feed_remote(service_input input) override {
      all.port_.send(all.providers_.at(input.running), std::move(input));
    }
    void use(const service_result& result) override { all.port_.use(result); }
    void go_remote() override {
      tell_own([](service_cycle& x, time_point t) {
        x.on_step(lifecycle_step::deactivate, t);
      });
    }
    void go_local(service_input input) override {
      feed_local(input);
      tell_own([](service_cycle& x, time_point t) {
        x.on_step(lifecycle_step::activate, t);
      });
    }
    void announce_source(bool remote) override {
      all.port_.on_source(name, remote);
    }
    void report_first_data(const session_id& session) override {
      all.tell_requester([session](requester& x, time_point t) {
        x.on_first_data(session, t);
      });
    }
    void report(qos_violation violation) override {
      all.tell_requester(
          [violation = std::move(violation)](requester& x, time_point t) {
            x.on_violation(violation, t);
          });
    }

    void watch(const session_id& session, time_point last) override {
      all.turns_.post(watches, [this, session, last](time_point) {
        dog.arm(session, last);
        set_dog_timer();
      });
    }
    void watch_arrival(const arrival& result) override {
      all.turns_.post(watches, [this, result](time_point t) {
        if (auto late = dog.on_arrival(result, t))
          bark(std::move(*late));
      });
    }
    void watch_useless(const session_id& session,
                       const std::string& why) override {
      all.turns_.post(watches, [this, session, why](time_point) {
        dog.on_useless(session, why);
      });
    }
    void watch_end(const service_end& end) override {
      all.turns_.post(watches, [this, session = end.running](time_point) {
        if (dog.disarm(session))
          ++dog_timer;
      });
    }

    void set_dog_timer() {
      all.wake(watches, dog.deadline().value(),
               [this, number = ++dog_timer](time_point t) {
                 if (number != dog_timer)
                   return;
                 if (auto gap = dog.on_deadline(t))
                   bark(std::move(*gap));
                 else
                   set_dog_timer();
               });
    }
    void bark(qos_violation violation) {
      ++dog_timer;
      report(std::move(violation));
    }

    void record(sofof::record x) override { all.port_.record(std::move(x)); }

    void wake_at(time_point t, std::uint64_t number) override {
      all.wake(selects, t, [this, number](time_point now) {
        selector.on_timer(number, now);
      });
    }
  };

  template <class Function>
  void tell_requester(Function what) {
    turns_.post(part_, [this, what = std::move(what)](time_point t) {
      what(*requester_, t);
    });
  }

  // Something that a part handles then.
  void wake(const turn_queue::part& part, time_point t, turn_queue::turn what) {
    port_.wake_at(t, turns_.post_later(part, std::move(what)));
  }

  // -- what comes over the air
  // --------------------------------------------------

  void handle(peer_id from, const service_offer& x, time_point now) {
    requester_->on_offer(x, from, now);
  }
  void handle(peer_id from, const service_response& x, time_point now) {
    answering_ = from;
    requester_->on_response(x, now);
  }
  void handle(peer_id, const service_result& x, time_point now) {
    requester_->on_result(x, now);
  }
  void handle(peer_id, const service_end& x, time_point now) {
    requester_->on_end(x, now);
  }

  // -- what the requester wants
  // -------------------------------------------------

  void send(peer_id provider, const service_request& request) override {
    port_.send(provider, request);
  }
  void send(peer_id provider, const service_end& end) override {
    port_.send(provider, end);
  }
  void begin(const session_id& session) override {
    providers_[session] = answering_;
    auto& service = *services_.at(session.kind);
    service.tell_selector(
        [session, &service](source_selector& x, time_point t) {
          x.on_session(session, service.make_judge(), t);
        });
  }
  void forward(const service_result& result) override {
    services_.at(result.running.kind)
        ->tell_selector([result](source_selector& x, time_point t) {
          x.on_result(result, t);
        });
  }
  void end(const service_end& end) override {
    services_.at(end.running.kind)
        ->tell_selector([this, end](source_selector& x, time_point t) {
          x.on_end(end, t);
          providers_.erase(end.running);
        });
  }
  void set_standby(const service_name& service,
                   const std::optional<standby>& chosen) override {
    services_.at(service)->tell_selector(
        [chosen](source_selector& x, time_point t) {
          x.on_standby(chosen, t);
        });
  }
  void on_placement(bool) override {}
  void record(sofof::record x) override { port_.record(std::move(x)); }
  void wake_at(time_point t, std::uint64_t number) override {
    wake(part_, t,
         [this, number](time_point now) { requester_->on_timer(number, now); });
  }

  vehicle_port& port_;
  turn_queue turns_;
  turn_queue::part part_ = turn_queue::make_part(); // of the requester
  std::map<service_name, std::unique_ptr<service_parts>> services_;
  std::optional<requester> requester_;
  std::map<session_id, peer_id> providers_; // of the sessions
  peer_id answering_{};                     // whose response is handled
};

void vehicle_side::parts::own_port::wake_at(time_point t,
                                            std::uint64_t number) {
  service.all.wake(service.runs, t, [this, number](time_point now) {
    service.own.on_timer(number, now);
  });
}

void vehicle_side::parts::own_port::deliver_at(time_point t,
                                               service_result result) {
  service.all.wake(service.selects, t,
                   [this, result = std::move(result)](time_point now) {
                     service.selector.on_result(result, now);
                   });
}

vehicle_side::vehicle_side(vehicle_side_setup setup, vehicle_port& port,
                           time_point now)
    : parts_{std::make_unique<parts>(std::move(setup), port, now)} {}

vehicle_side::~vehicle_side() = default;

void vehicle_side::on_motion(const ego_state& ego) {
  parts_->on_motion(ego);
}

void vehicle_side::on_input(const service_name& service, service_input input,
                            time_point now) {
  parts_->on_input(service, std::move(input), now);
}

void vehicle_side::on_message(peer_id from, to_vehicle message,
                              time_point now) {
  parts_->on_message(from, std::move(message), now);
}

void vehicle_side::on_lost(peer_id provider, time_point now) {
  parts_->on_lost(provider, now);
}

void vehicle_side::on_timer(std::uint64_t number, time_point now) {
  parts_->on_timer(number, now);
}

void vehicle_side::shut_down(time_point now) {
  parts_->shut_down(now);
}

} // namespace sofof::offloading

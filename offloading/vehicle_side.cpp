// The parts of a vehicle's side, and what each tells the others.
#include "offloading/vehicle_side.hpp"

#include "offloading/service_cycle.hpp"
#include "offloading/timer_list.hpp"
#include "offloading/watchdog.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

namespace sofof::offloading {

class vehicle_side::parts final : public requester_port {
public:
  parts(vehicle_side_setup setup, vehicle_port& port, time_point now)
      : port_{port}, now_{now} {
    assert(setup.policy);
    for (const auto& service : setup.services)
      services_.push_back(
          std::make_unique<service_parts>(*this, setup, service));
    requester_.emplace(std::move(setup), *this, now);
    for (const auto& service : services_)
      service->start();
  }

  void on_motion(const messages::ego_state& ego) { requester_->on_motion(ego); }

  void on_input(const messages::service_name& service,
                const messages::service_input& input, time_point now) {
    begin_call(now);
    if (auto* known = find(service))
      known->selector.on_input(input, now);
    end_call();
  }

  void on_message(peer_id from, const to_vehicle& message, time_point now) {
    begin_call(now);
    std::visit([&](const auto& x) { handle(from, x); }, message);
    end_call();
  }

  void on_lost(peer_id provider, time_point now) {
    begin_call(now);
    requester_->on_lost(provider, now);
    end_call();
  }

  void on_timer(std::uint64_t number, time_point now) {
    begin_call(now);
    if (const auto due = timers_.claim(number))
      handle(*due);
    end_call();
  }

  void shut_down(time_point now) {
    begin_call(now);
    requester_->shut_down(now);
    end_call();
  }

private:
  struct service_parts;

  /// Under which response time the scene is safe, as a service finds it.
  struct scene_report {
    messages::service_name service;
    duration longest{};
  };

  enum class timer_of { requester, selector, watchdog, own, result };

  struct timer {
    timer_of of = timer_of::requester;
    service_parts* service = nullptr; // but for the requester's
    std::uint64_t number = 0;         // as its owner has numbered it
  };

  /// What the vehicle's own function wants.
  struct own_port final : cycle_port {
    service_parts& service;
    explicit own_port(service_parts& x) : service{x} {}
    void wake_at(time_point t, std::uint64_t number) override {
      service.wake_at(t, timer_of::own, number);
    }
    void deliver_at(time_point t, messages::service_result result) override {
      service.wake_at(t, timer_of::result,
                      service.results.add(std::move(result)));
    }
  };

  /// A selector, its watchdog, and the vehicle's own function.
  struct service_parts final : selector_port {
    parts& all;
    messages::service_name name;
    source_selector selector;
    watchdog qos;
    std::uint64_t watchdog_timer = 0; // the one that counts
    own_port wants{*this};
    service_cycle own;
    timer_list<messages::service_result> results; // of its cycles
    std::vector<std::pair<messages::session_id, peer_id>> feeds; // its sessions

    service_parts(parts& owner, const vehicle_side_setup& setup,
                  const onboard_service& service)
        : all{owner}, name{service.name}, selector{{setup.station, service,
                                                    setup.record_margins,
                                                    setup.trace,
                                                    setup.policy->needs_scene(),
                                                    setup.computer},
                                                   *this},
          qos{service.options.limits}, own{cycle(setup, service), wants} {}

    cycle_setup cycle(const vehicle_side_setup& setup,
                      const onboard_service& service) {
      auto made = own_cycle(service, setup.station, setup.noise);
      made.finish = [this](time_point start, std::uint64_t number) {
        return all.port_.finish(name, start, number);
      };
      return made;
    }

    void start() {
      own.on_step(messages::lifecycle_step::configure, all.now_);
      own.on_step(messages::lifecycle_step::activate, all.now_);
    }

    void wake_at(time_point t, timer_of of, std::uint64_t number) {
      all.wake_at(t, {of, this, number});
    }

    // -- what the requester wants ---------------------------------------------

    void begin(const messages::session_id& session, peer_id provider) {
      feeds.emplace_back(session, provider);
      selector.on_session(session, all.now_);
    }
    void end(const messages::service_end& end) {
      selector.on_end(end, all.now_);
      std::erase_if(feeds,
                    [&](const auto& fed) { return fed.first == end.session; });
    }

    // -- what the selector wants ----------------------------------------------

    void feed_local(const messages::service_input& input) override {
      own.on_input(input, all.now_);
    }
    void feed_remote(messages::service_input input) override {
      const auto to =
          std::ranges::find(feeds, input.session,
                            &std::pair<messages::session_id, peer_id>::first);
      assert(to != feeds.end());
      all.port_.send(to->second, std::move(input));
    }
    void use(const messages::service_result& result) override {
      all.port_.use(result);
    }
    void go_remote() override {
      own.on_step(messages::lifecycle_step::deactivate, all.now_);
    }
    void go_local(messages::service_input input) override {
      run_along(std::move(input));
    }
    void run_along(messages::service_input input) override {
      own.on_input(input, all.now_);
      own.on_step(messages::lifecycle_step::activate, all.now_);
    }
    void rest() override { go_remote(); }
    void announce_source(bool remote) override {
      all.port_.on_source(name, remote);
    }
    void report_first_data(const messages::session_id& session) override {
      all.reports_.emplace_back(session);
    }
    void report(messages::qos_violation violation) override {
      all.reports_.emplace_back(std::move(violation));
    }

    void report_safe_response(duration longest) override {
      all.reports_.emplace_back(scene_report{name, longest});
    }

    void watch(const messages::session_id& session, time_point last) override {
      qos.arm(session, last);
      set_watchdog_timer();
    }
    void watch_arrival(const messages::arrival& result) override {
      if (auto late = qos.on_arrival(result, all.now_))
        report_once(std::move(*late));
    }
    void watch_useless(const messages::session_id& session,
                       const messages::implausibility& found) override {
      qos.on_useless(session, found);
    }
    void watch_limits(const messages::qos_limits& limits) override {
      qos.limit(limits);
    }
    void watch_end(const messages::service_end& end) override {
      if (qos.disarm(end.session))
        ++watchdog_timer;
    }

    void set_watchdog_timer() {
      wake_at(qos.deadline().value(), timer_of::watchdog, ++watchdog_timer);
    }
    void on_watchdog_timer(std::uint64_t number) {
      if (number != watchdog_timer)
        return;
      if (auto gap = qos.on_deadline(all.now_))
        report_once(std::move(*gap));
      else
        set_watchdog_timer();
    }
    void report_once(messages::qos_violation violation) {
      ++watchdog_timer;
      report(std::move(violation));
    }

    void record(messages::record&& x) override {
      all.port_.record(std::move(x));
    }

    void wake_at(time_point t, std::uint64_t number) override {
      wake_at(t, timer_of::selector, number);
    }
  };

  service_parts* find(const messages::service_name& service) {
    const auto i = std::ranges::find_if(
        services_, [&](const auto& known) { return known->name == service; });
    return i == services_.end() ? nullptr : i->get();
  }
  service_parts& at(const messages::service_name& service) {
    auto* known = find(service);
    assert(known);
    return *known;
  }

  // -- calls --------------------------------------------------------------

  void begin_call(time_point now) {
    assert(now >= now_);
    assert(reports_.empty());
    now_ = now;
  }

  // What selectors and watchdogs have found is reported to the requester at the
  // end of a call; it may lead to more.
  void end_call() {
    for (std::size_t k = 0; k < reports_.size(); ++k) {
      const auto found = std::move(reports_[k]);
      std::visit([this](const auto& x) { handle(x); }, found);
    }
    reports_.clear();
  }

  void handle(const messages::session_id& given_first_data) {
    requester_->on_first_data(given_first_data, now_);
  }
  void handle(const scene_report& found) {
    requester_->on_safe_response(found.service, found.longest, now_);
  }
  void handle(const messages::qos_violation& violation) {
    requester_->on_violation(violation, now_);
  }

  void wake_at(time_point t, const timer& what) {
    port_.wake_at(t, timers_.add(what));
  }

  void handle(const timer& due) {
    assert(due.service || due.of == timer_of::requester);
    switch (due.of) {
      case timer_of::requester:
        return requester_->on_timer(due.number, now_);
      case timer_of::selector:
        return due.service->selector.on_timer(due.number, now_);
      case timer_of::watchdog:
        return due.service->on_watchdog_timer(due.number);
      case timer_of::own:
        return due.service->own.on_timer(due.number, now_);
      case timer_of::result:
        return due.service->selector.on_result(
            due.service->results.claim(due.number).value(), now_);
    }
  }

  // -- what comes over the air --------------------------------------------

  void handle(peer_id from, const messages::service_offer& x) {
    requester_->on_offer(x, from, now_);
  }
  void handle(peer_id from, const messages::service_response& x) {
    if (!requester_->is_peer_of(x.provider, from))
      return;
    answering_ = from;
    requester_->on_response(x, now_);
  }
  void handle(peer_id from, const messages::session_digest& x) {
    requester_->on_digest(x, from, now_);
  }
  void handle(peer_id from, const messages::service_result& x) {
    if (requester_->is_peer_of(x.session.provider, from))
      requester_->on_result(x, now_);
  }
  void handle(peer_id from, const messages::service_end& x) {
    if (requester_->is_peer_of(x.session.provider, from))
      requester_->on_end(x, now_);
  }

  // -- what the requester wants -------------------------------------------

  void send(peer_id provider,
            const messages::service_request& request) override {
    port_.send(provider, request);
  }
  void send(peer_id provider, const messages::service_end& end) override {
    port_.send(provider, end);
  }
  void begin(const messages::session_id& session) override {
    at(session.service).begin(session, answering_);
  }
  void forward(const messages::service_result& result) override {
    at(result.session.service).selector.on_result(result, now_);
  }
  void end(const messages::service_end& end) override {
    at(end.session.service).end(end);
  }
  void set_standby(const messages::service_name& service,
                   const std::optional<messages::standby>& chosen) override {
    at(service).selector.on_standby(chosen, now_);
  }
  void foresee_home(const messages::service_name& service) override {
    at(service).selector.on_home_is_near(now_);
  }
  void on_placement(bool) override {}
  void record(messages::record&& x) override { port_.record(std::move(x)); }
  void wake_at(time_point t, std::uint64_t number) override {
    wake_at(t, {timer_of::requester, nullptr, number});
  }

  vehicle_port& port_;
  time_point now_; // of the latest call
  timer_list<timer> timers_;
  std::vector<std::unique_ptr<service_parts>> services_;
  std::optional<requester> requester_;
  /// First data, violations and times that it has not heard of yet.
  std::vector<
      std::variant<messages::session_id, messages::qos_violation, scene_report>>
      reports_;
  peer_id answering_{}; // whose response is handled
};

vehicle_side::vehicle_side(vehicle_side_setup setup, vehicle_port& port,
                           time_point now)
    : parts_{std::make_unique<parts>(std::move(setup), port, now)} {}

vehicle_side::~vehicle_side() = default;

void vehicle_side::on_motion(const messages::ego_state& ego) {
  parts_->on_motion(ego);
}

void vehicle_side::on_input(const messages::service_name& service,
                            const messages::service_input& input,
                            time_point now) {
  parts_->on_input(service, input, now);
}

void vehicle_side::on_message(peer_id from, const to_vehicle& message,
                              time_point now) {
  parts_->on_message(from, message, now);
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

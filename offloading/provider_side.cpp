// The parts of a provider's side, and what each tells the others.
#include "offloading/provider_side.hpp"

#include "base/protocol.hpp"

#include <cassert>
#include <optional>
#include <utility>

namespace sofof::offloading {

class provider_side::parts final : public provider_port {
public:
  parts(provider_setup setup, provider_side_port& port) : port_{port} {
    for (const auto& service : setup.services)
      periods_.emplace(service.name, service.period);
    provider_.emplace(std::move(setup), *this);
  }

  template <class Function>
  void tell(Function what, time_point now) {
    turns_.post(part_, [this, what = std::move(what)](time_point t) {
      what(*provider_, t);
    });
    turns_.run(now);
  }

  void on_message(peer_id from, to_provider message, time_point now) {
    std::visit([&](auto& x) { accept(from, std::move(x), now); }, message);
    turns_.run(now);
  }

  void on_timer(std::uint64_t number, time_point now) {
    turns_.wake(number);
    turns_.run(now);
  }

private:
  /// The function of one session.
  struct session_parts final : cycle_port,
                               std::enable_shared_from_this<session_parts> {
    parts& all;
    session_id session;
    peer_id requester;
    turn_queue::part feeds = turn_queue::make_part(),
                     runs = turn_queue::make_part();
    bool fed = false, ended = false;
    std::optional<service_cycle> cycle;

    session_parts(parts& owner, const session_start& start)
        : all{owner}, session{start.session}, requester{start.requester} {}

    void wake_at(time_point t, std::uint64_t number) override {
      all.wake(runs, t, [me = shared_from_this(), number](time_point now) {
        me->cycle->on_timer(number, now);
      });
    }
    void deliver_at(time_point t, service_result result) override {
      all.wake(feeds, t,
               [me = shared_from_this(),
                result = std::move(result)](time_point) mutable {
                 if (!me->ended)
                   me->all.port_.send(me->requester, std::move(result));
               });
    }
  };
  using session_ptr = std::shared_ptr<session_parts>;

  session_ptr find(const session_id& session) const {
    const auto i = sessions_.find(session);
    return i == sessions_.end() ? nullptr : i->second;
  }

  void wake(const turn_queue::part& part, time_point t, turn_queue::turn what) {
    port_.wake_at(t, turns_.post_later(part, std::move(what)));
  }

  void step(const session_ptr& to, lifecycle_step step) {
    turns_.post(to->runs,
                [to, step](time_point t) { to->cycle->on_step(step, t); });
  }

  // -- what comes over the air
  // --------------------------------------------------

  void accept(peer_id from, service_request request, time_point) {
    turns_.post(part_, [this, from, x = std::move(request)](time_point t) {
      provider_->on_request(x, from, t);
    });
  }
  void accept(peer_id, service_end end, time_point) {
    turns_.post(part_, [this, x = std::move(end)](time_point t) {
      provider_->on_end(x, t);
    });
  }
  // Only the requester of a session feeds it.
  void accept(peer_id from, service_input input, time_point) {
    const auto to = find(input.running);
    if (to && to->requester == from)
      turns_.post(to->feeds,
                  [this, to, x = std::move(input)](time_point) mutable {
                    feed(to, std::move(x));
                  });
  }

  void feed(const session_ptr& to, service_input input) {
    if (to->ended)
      return;
    turns_.post(to->runs, [to, x = std::move(input)](time_point t) mutable {
      to->cycle->on_input(std::move(x), t);
    });
    if (!std::exchange(to->fed, true))
      step(to, lifecycle_step::activate);
  }

  // -- what the provider wants
  // --------------------------------------------------

  void send(peer_id requester, const service_offer& offer) override {
    port_.send(requester, offer);
  }
  void send(peer_id requester, const service_response& response) override {
    port_.send(requester, response);
  }
  void send(peer_id requester, const service_end& end) override {
    port_.send(requester, end);
  }
  void meet(peer_id) override {}
  void leave(peer_id) override {}

  void start(const session_start& start) override {
    assert(!find(start.session));
    const auto begun = std::make_shared<session_parts>(*this, start);
    auto setup = port_.make_function(start);
    setup.running = start.session;
    setup.period = periods_.at(start.session.kind);
    setup.phase = start.phase;
    setup.keeps_phase = start.keeps_phase;
    begun->cycle.emplace(std::move(setup), *begun);
    sessions_.emplace(start.session, begun);
    step(begun, lifecycle_step::configure);
    turns_.post(begun->feeds, [this, begun](time_point t) {
      wake(begun->feeds, t + protocol::start_timeout,
           [this, begun](time_point) { check(begun); });
    });
  }

  // The response was lost on its way, or the vehicle has changed its mind.
  void check(const session_ptr& session) {
    if (session->fed || session->ended)
      return;
    turns_.post(part_, [this, id = session->session](time_point t) {
      provider_->on_function_lost(id, end_reason::no_data, t);
    });
  }

  void end(const service_end& end) override {
    const auto ended = find(end.running);
    assert(ended);
    sessions_.erase(end.running);
    turns_.post(ended->feeds, [this, ended](time_point) {
      ended->ended = true;
      step(ended, lifecycle_step::deactivate);
      step(ended, lifecycle_step::shut_down);
    });
  }

  void record(sofof::record x) override { port_.record(std::move(x)); }

  void wake_at(time_point t, std::uint64_t number) override {
    wake(part_, t,
         [this, number](time_point now) { provider_->on_timer(number, now); });
  }

  provider_side_port& port_;
  turn_queue turns_;
  turn_queue::part part_ = turn_queue::make_part(); // of the provider
  std::map<service_name, duration> periods_;
  std::map<session_id, session_ptr> sessions_;
  std::optional<provider> provider_;
};

provider_side::provider_side(provider_setup setup, provider_side_port& port)
    : parts_{std::make_unique<parts>(std::move(setup), port)} {}

provider_side::~provider_side() = default;

void provider_side::on_cam(const cam& c, peer_id from, time_point now) {
  parts_->tell([c, from](provider& x, time_point t) { x.on_cam(c, from, t); },
               now);
}

void provider_side::on_message(peer_id from, to_provider message,
                               time_point now) {
  parts_->on_message(from, std::move(message), now);
}

void provider_side::on_lost(peer_id requester, time_point now) {
  parts_->tell(
      [requester](provider& x, time_point t) { x.on_lost(requester, t); }, now);
}

void provider_side::on_timer(std::uint64_t number, time_point now) {
  parts_->on_timer(number, now);
}

void provider_side::shut_down(time_point now) {
  parts_->tell([](provider& x, time_point t) { x.shut_down(t); }, now);
}

} // namespace sofof::offloading

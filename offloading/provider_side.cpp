// The parts of a provider's side, and what each tells the others.
#include "offloading/provider_side.hpp"

#include "base/protocol.hpp"
#include "offloading/timer_list.hpp"

#include <cassert>
#include <map>
#include <optional>
#include <utility>

namespace sofof::offloading {

class provider_side::parts final : public provider_port {
public:
  parts(provider_setup setup, provider_side_port& port) : port_{port} {
    for (const auto& service : setup.services)
      services_.emplace(service.name, service);
    provider_.emplace(std::move(setup), *this);
  }

  void on_cam(const messages::cam& c, peer_id from, time_point now) {
    begin_call(now);
    provider_->on_cam(c, from, now);
  }

  void on_message(peer_id from, const to_provider& message, time_point now) {
    begin_call(now);
    std::visit([&](const auto& x) { handle(from, x); }, message);
  }

  void on_lost(peer_id requester, time_point now) {
    begin_call(now);
    provider_->on_lost(requester, messages::end_reason::peer_lost, now);
  }

  void on_timer(std::uint64_t number, time_point now) {
    begin_call(now);
    if (const auto due = timers_.claim(number))
      handle(*due);
  }

  void shut_down(time_point now) {
    begin_call(now);
    provider_->shut_down(now);
  }

private:
  enum class timer_of { provider, function, result, first_input };

  struct timer {
    timer_of of = timer_of::provider;
    std::uint32_t session = 0; // its counter, but for the provider's
    std::uint64_t number = 0;  // as its owner has numbered it
  };

  /// The function of one session.
  struct session_parts final : cycle_port {
    parts& all;
    messages::session_id session;
    peer_id requester;
    bool fed = false;
    service_cycle cycle;
    timer_list<messages::service_result> results; // of its cycles

    session_parts(parts& owner, const session_start& start, cycle_setup setup)
        : all{owner}, session{start.session}, requester{start.requester},
          cycle{std::move(setup), *this} {}

    void wake_at(time_point t, timer_of of, std::uint64_t number) {
      all.wake_at(t, {of, session.counter, number});
    }
    void wake_at(time_point t, std::uint64_t number) override {
      wake_at(t, timer_of::function, number);
    }
    void deliver_at(time_point t, messages::service_result result) override {
      if (t > all.now_)
        wake_at(t, timer_of::result, results.add(std::move(result)));
      else
        all.port_.send(requester, std::move(result));
    }
  };

  /// @returns null for a session that has ended, or that there never was.
  session_parts* find(const messages::session_id& session) {
    const auto i = sessions_.find(session.counter);
    const auto runs = i != sessions_.end() && i->second.session == session;
    return runs ? &i->second : nullptr;
  }

  // -- calls --------------------------------------------------------------

  void begin_call(time_point now) {
    assert(now >= now_);
    now_ = now;
  }

  void wake_at(time_point t, const timer& what) {
    port_.wake_at(t, timers_.add(what));
  }

  void handle(const timer& due) {
    if (due.of == timer_of::provider)
      provider_->on_timer(due.number, now_);
    else if (const auto i = sessions_.find(due.session); i != sessions_.end())
      handle(i->second, due);
  }

  void handle(session_parts& session, const timer& due) {
    assert(session.session.counter == due.session);
    assert(due.of != timer_of::provider);
    switch (due.of) {
      case timer_of::provider:
        break;
      case timer_of::function:
        return session.cycle.on_timer(due.number, now_);
      case timer_of::result:
        return port_.send(session.requester,
                          session.results.claim(due.number).value());
      case timer_of::first_input:
        // The response was lost on its way, or the vehicle has changed its
        // mind.
        if (!session.fed)
          // A copy: the session is erased in this call.
          provider_->on_function_lost(messages::session_id{session.session},
                                      messages::end_reason::no_data, now_);
    }
  }

  // -- what comes over the air --------------------------------------------

  void handle(peer_id from, const messages::service_request& request) {
    provider_->on_request(request, from, now_);
  }
  // Only the requester of a session ends it.
  void handle(peer_id from, const messages::service_end& end) {
    const auto* to = find(end.session);
    if (to && to->requester == from)
      provider_->on_end(end, now_);
  }
  // Only the requester of a session feeds it.
  void handle(peer_id from, const messages::service_input& input) {
    auto* to = find(input.session);
    if (!to || to->requester != from)
      return;
    to->cycle.on_input(input, now_);
    if (!std::exchange(to->fed, true))
      to->cycle.on_step(messages::lifecycle_step::activate, now_);
  }

  // -- what the provider wants --------------------------------------------

  void send(peer_id requester, const messages::service_offer& offer) override {
    port_.send(requester, offer);
  }
  void send(peer_id requester,
            const messages::session_digest& digest) override {
    port_.send(requester, digest);
  }
  void send(peer_id requester,
            const messages::service_response& response) override {
    port_.send(requester, response);
  }
  void send(peer_id requester, const messages::service_end& end) override {
    port_.send(requester, end);
  }
  void meet(peer_id) override {}
  void leave(peer_id) override {}

  void start(const session_start& start) override {
    assert(start.session.is_remote());
    auto setup = cycle_of(services_.at(start.session.service), start);
    setup.finish = [this, session = start.session](time_point t,
                                                   std::uint64_t cycle) {
      return port_.finish(session, t, cycle);
    };
    const auto [i, is_new] = sessions_.try_emplace(start.session.counter, *this,
                                                   start, std::move(setup));
    assert(is_new);
    i->second.cycle.on_step(messages::lifecycle_step::configure, now_);
    i->second.wake_at(now_ + protocol::start_timeout, timer_of::first_input, 0);
  }
  void end(const messages::service_end& end) override {
    assert(find(end.session));
    sessions_.erase(end.session.counter);
  }

  void record(messages::record&& x) override { port_.record(std::move(x)); }

  void wake_at(time_point t, std::uint64_t number) override {
    wake_at(t, {timer_of::provider, 0, number});
  }

  provider_side_port& port_;
  time_point now_ = time_point::min(); // of the latest call
  timer_list<timer> timers_;
  std::map<messages::service_name, offered_service> services_;
  std::map<std::uint32_t, session_parts> sessions_; // by their counters
  std::optional<provider> provider_;
};

provider_side::provider_side(provider_setup setup, provider_side_port& port)
    : parts_{std::make_unique<parts>(std::move(setup), port)} {}

provider_side::~provider_side() = default;

void provider_side::on_cam(const messages::cam& c, peer_id from,
                           time_point now) {
  parts_->on_cam(c, from, now);
}

void provider_side::on_message(peer_id from, const to_provider& message,
                               time_point now) {
  parts_->on_message(from, message, now);
}

void provider_side::on_lost(peer_id requester, time_point now) {
  parts_->on_lost(requester, now);
}

void provider_side::on_timer(std::uint64_t number, time_point now) {
  parts_->on_timer(number, now);
}

void provider_side::shut_down(time_point now) {
  parts_->shut_down(now);
}

} // namespace sofof::offloading

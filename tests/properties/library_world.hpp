// One vehicle and its providers, over faulty links, without any actor.
#pragma once

#include "base/protocol.hpp"
#include "channel/link_direction.hpp"
#include "channel/provider_compute.hpp"
#include "channel/server_queue.hpp"
#include "messages/protocol/octets.hpp"
#include "messages/v2x/cam_content.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/geonet.hpp"
#include "offloading/provider_side.hpp"
#include "offloading/vehicle_side.hpp"
#include "tests/properties/ledger.hpp"
#include "tests/support/echo_service.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace sofof::test {

/// What happens, in the order of time and of these calls; few things at once.
/// @tparam Event  A variant.
template <class Event>
class agenda {
public:
  time_point now() const { return now_; }

  /// @tparam Kind  Of event; made of `parts`.
  template <class Kind, class... Parts>
  void at(time_point t, Parts&&... parts) {
    if (!free_)
      free_ = &entries_.emplace_back();
    auto* made = std::exchange(free_, free_->next);
    made->at = std::max(t, now_);
    made->what.template emplace<Kind>(std::forward<Parts>(parts)...);
    auto** place = &next_;
    while (*place && (*place)->at <= made->at)
      place = &(*place)->next;
    made->next = std::exchange(*place, made);
  }

  /// @param handle  Takes an event; may call `at`.
  template <class Function>
  void run_until(time_point end, Function handle) {
    while (next_ && next_->at <= end) {
      auto* due = std::exchange(next_, next_->next);
      now_ = due->at;
      handle(due->what);
      due->next = std::exchange(free_, due);
    }
    now_ = end;
  }

private:
  struct entry {
    time_point at;
    Event what;
    entry* next = nullptr; // in the order of time, or of those that are free
  };

  time_point now_;
  std::deque<entry> entries_; // they stay where they are
  entry* next_ = nullptr;
  entry* free_ = nullptr;
};

/// The car moves on.
struct tick {};

struct vehicle_timer {
  std::uint64_t number = 0;
};

struct provider_timer {
  std::size_t provider = 0;
  std::uint64_t start = 0; // of the provider, which may have started again
  std::uint64_t number = 0;
};

/// A provider gets something.
template <class Message>
struct up_arrival {
  std::size_t provider = 0;
  Message message;
};

/// The vehicle gets something of a provider.
struct down_arrival {
  std::size_t provider = 0;
  offloading::to_vehicle message;
};

using event =
    std::variant<tick, vehicle_timer, provider_timer, up_arrival<messages::cam>,
                 up_arrival<offloading::to_provider>, down_arrival>;

inline std::size_t octets_of_cam() {
  static const auto size = [] {
    const messages::georeference where;
    const auto message = messages::make_cam(shuttle{}.ego({}).own, {}, where);
    return messages::encoded(message).octets.size() + messages::geonet_octets;
  }();
  return size;
}

/// As network_link has it.
class library_link {
public:
  library_link(agenda<event>& time, const channel::channel_draws& draws,
               channel::link_faults faults)
      : time_{time}, up_{draws, channel::direction::up, nullptr},
        down_{draws, channel::direction::down, nullptr}, faults_{std::move(
                                                             faults)} {}

  /// @param to  The place of the provider.
  template <class Message>
  void up(std::uint64_t number, std::size_t octets, std::size_t to,
          Message&& message) {
    using arrival = up_arrival<std::remove_cvref_t<Message>>;
    carry<arrival>(up_, channel::message_class::other, number, octets, to,
                   std::forward<Message>(message));
  }
  void down(channel::message_class kind, std::uint64_t number,
            std::size_t octets, std::size_t from,
            offloading::to_vehicle&& message) {
    carry<down_arrival>(down_, kind, number, octets, from, std::move(message));
  }
  /// Knows the sessions from what passes.
  void look_at(const offloading::to_vehicle& message) {
    if (const auto* response =
            std::get_if<messages::service_response>(&message))
      for (const auto& v : response->verdicts)
        if (v.accepted)
          sessions_.push_back(v.session);
    if (const auto* end = std::get_if<messages::service_end>(&message))
      std::erase(sessions_, end->session);
  }
  /// @returns whether it is carried: not the input of a session that has ended.
  bool look_at(const offloading::to_provider& message) {
    if (const auto* end = std::get_if<messages::service_end>(&message))
      std::erase(sessions_, end->session);
    const auto* input = std::get_if<messages::service_input>(&message);
    return !input
           || std::ranges::find(sessions_, input->session) != sessions_.end();
  }
  std::uint64_t time_number() const {
    return static_cast<std::uint64_t>(time_.now().time_since_epoch().count());
  }

private:
  template <class Arrival, class Message>
  void carry(channel::link_direction& direction, channel::message_class kind,
             std::uint64_t number, std::size_t octets, std::size_t provider,
             Message&& message) {
    const auto t = direction.arrival(time_.now(), kind, number, octets);
    if (!t)
      return;
    const auto fate = faults_.of(carried_++);
    if (fate.lost)
      return;
    if (fate.copy_after) // first: at the same time they are alike
      time_.at<Arrival>(*t + *fate.copy_after, provider, message);
    time_.at<Arrival>(*t + fate.extra_delay, provider,
                      std::forward<Message>(message));
  }

  agenda<event>& time_;
  channel::link_direction up_, down_;
  channel::link_faults faults_;
  std::uint64_t carried_ = 0;
  std::vector<messages::session_id> sessions_;
};

struct library_world {
  static constexpr std::string_view kind = "library";
  static constexpr offloading::peer_id vehicle_peer{1};
  static inline const messages::service_name one{"one"}, two{"two"};

  struct provider_node final : offloading::provider_side_port {
    library_world& world;
    std::size_t number;
    channel::provider_compute computers;
    channel::server_queue workers;
    random_stream draws_of_results;
    library_link link;
    bool alive = false;
    std::uint64_t starts = 0;
    std::unique_ptr<offloading::provider_side> side;

    provider_node(library_world& w, std::size_t k)
        : world{w}, number{k}, computers{channel::compute_measured_with(
                                   w.profile->name)},
          workers{static_cast<unsigned>(computers.workers)},
          draws_of_results{channel::result_draws(
              random_stream{w.seed, "network"}, shuttle::station,
              static_cast<std::uint32_t>(k))},
          link{w.time, draws(),
               channel::link_faults{random_stream{w.seed, "faults"}.part(k + 1),
                                    w.faults}} {
      start(static_cast<provider_id>(k + 1));
    }

    void start(provider_id id) {
      alive = true;
      ++starts;
      offloading::provider_setup setup;
      setup.id = id;
      setup.area = area_of_provider(static_cast<int>(number));
      for (const auto& name : {one, two})
        setup.services.push_back(at_provider(world.of.service(name), {}));
      setup.policy = world.of.provider_policy();
      setup.computer = {static_cast<std::size_t>(computers.workers),
                        computers.mean_s(), computers.deviation_s()};
      setup.map = {world.world, &world.world->map};
      setup.noise = random_stream{world.seed, "network"};
      setup.trace = true;
      side =
          std::make_unique<offloading::provider_side>(std::move(setup), *this);
    }

    channel::channel_draws draws() const {
      return {world.profile, random_stream{world.seed, "network"},
              shuttle::station, static_cast<std::uint32_t>(number)};
    }
    offloading::peer_id peer() const { return offloading::peer_id{number + 1}; }

    void send(offloading::peer_id, offloading::to_vehicle message) override {
      link.look_at(message);
      const auto* result = std::get_if<messages::service_result>(&message);
      const auto octets = std::visit(
          [](const auto& x) { return messages::octets_of(x); }, message);
      const auto digest =
          std::holds_alternative<messages::session_digest>(message);
      link.down(result   ? channel::message_class::result
                : digest ? channel::message_class::digest
                         : channel::message_class::other,
                result ? result->cycle : link.time_number(), octets, number,
                std::move(message));
    }
    offloading::cycle_work finish(const messages::session_id&, time_point start,
                                  std::uint64_t cycle) override {
      return workers.finish(start,
                            computers.computing_time(draws_of_results, cycle));
    }
    void record(messages::record&& x) override { world.keep(x); }
    void wake_at(time_point t, std::uint64_t number_of_timer) override {
      world.time.at<provider_timer>(t, number, starts, number_of_timer);
    }
  };

  struct vehicle_node final : offloading::vehicle_port {
    library_world& world;
    explicit vehicle_node(library_world& w) : world{w} {}

    offloading::cycle_work finish(const messages::service_name&,
                                  time_point start, std::uint64_t) override {
      return start + echo_options().compute.run_time_mean;
    }

    void send(offloading::peer_id to,
              offloading::to_provider message) override {
      const auto k = static_cast<std::size_t>(to) - 1;
      auto& p = *world.providers.at(k);
      if (!p.link.look_at(message))
        return;
      const auto octets = std::visit(
          [](const auto& x) { return messages::octets_of(x); }, message);
      p.link.up(p.link.time_number(), octets, k, std::move(message));
    }
    void use(const messages::service_result& result) override {
      world.diary->on_result(result);
    }
    void on_source(const messages::service_name& service,
                   bool remote) override {
      world.diary->on_source(service, remote);
    }
    void record(messages::record&& x) override { world.keep(x); }
    void wake_at(time_point t, std::uint64_t number) override {
      world.time.at<vehicle_timer>(t, number);
    }
  };

  std::uint64_t seed;
  channel::link_fault_options faults;
  conduct of;
  std::shared_ptr<const channel::channel_profile> profile;
  world::streets_ptr world = one_long_street();
  agenda<event> time;
  std::shared_ptr<ledger> book = std::make_shared<ledger>();
  std::shared_ptr<client_diary> diary = std::make_shared<client_diary>();
  std::vector<std::unique_ptr<provider_node>> providers;
  vehicle_node node{*this};
  shuttle car;
  bool alive = true;
  std::unique_ptr<offloading::vehicle_side> side;

  library_world(std::uint64_t seed, channel::link_fault_options faults,
                int provider_count, std::string_view channel = "paper_5g",
                const conduct& how = {})
      : seed{seed}, faults{faults}, of{how}, profile{of.on(channel)} {
    for (int k = 0; k < provider_count; ++k)
      providers.push_back(
          std::make_unique<provider_node>(*this, static_cast<std::size_t>(k)));
    offloading::vehicle_side_setup setup;
    setup.station = shuttle::station;
    setup.policy = of.policy();
    setup.noise = random_stream{seed, "vehicle"};
    setup.path_ahead = path_ahead;
    setup.trace = true;
    for (const auto& name : {one, two})
      setup.services.push_back(in_vehicle(of.service(name), {}));
    side = std::make_unique<offloading::vehicle_side>(std::move(setup), node,
                                                      time.now());
    handle(tick{});
  }

  void keep(const messages::record& x) {
    book->on_record(x);
    diary->on_record(x);
  }

  void handle(tick) {
    using namespace std::chrono_literals;
    if (!alive)
      return;
    const auto t = time.now();
    time.at<tick>(t + 50ms);
    car.step();
    if (car.sends_cam())
      send_cam(car.ego(t));
    if (car.said == 1)
      return; // its services are not there yet
    const messages::service_input said{
        {}, t, messages::payload::of(echo{car.said})};
    for (const auto* name : {&one, &two})
      side->on_input(*name, said, t);
  }
  void handle(const vehicle_timer& x) {
    if (alive)
      side->on_timer(x.number, now());
  }
  void handle(const provider_timer& x) {
    if (auto& p = *providers[x.provider]; p.alive && p.starts == x.start)
      p.side->on_timer(x.number, now());
  }
  // CAMs of a vehicle that is gone are not decoded any more.
  void handle(const up_arrival<messages::cam>& x) {
    if (auto& p = *providers[x.provider]; p.alive && alive)
      p.side->on_cam(x.message, vehicle_peer, now());
  }
  void handle(const up_arrival<offloading::to_provider>& x) {
    if (auto& p = *providers[x.provider]; p.alive)
      p.side->on_message(vehicle_peer, x.message, now());
  }
  void handle(const down_arrival& x) {
    if (alive)
      side->on_message(providers[x.provider]->peer(), x.message, now());
  }

  void send_cam(const messages::ego_state& ego) {
    constexpr std::uint64_t cam_message = 2;
    side->on_motion(ego);
    for (std::size_t k = 0; k < providers.size(); ++k) {
      auto& link = providers[k]->link;
      link.up(link.time_number() ^ cam_message << 56, octets_of_cam(), k,
              ego.own);
    }
  }

  time_point now() const { return time.now(); }
  void run_for(duration d) {
    time.run_until(time.now() + d, [this](const event& next) {
      std::visit([this](const auto& x) { handle(x); }, next);
    });
  }

  /// Runs on, and checks every 10 ms that the newest result is fresh.
  void run_and_check(duration d) {
    using namespace std::chrono_literals;
    for (const auto end = now() + d; now() < end;) {
      run_for(10ms);
      diary->check_fresh(now());
    }
  }

  void dismiss() {
    dismiss_vehicle();
    for (auto& p : providers)
      if (std::exchange(p->alive, false))
        p->side->shut_down(now());
  }
  void dismiss_vehicle() {
    if (!alive)
      return;
    side->shut_down(now());
    crash_vehicle();
  }

  void crash_provider() {
    auto& dead = *providers.front();
    dead.alive = false;
    side->on_lost(dead.peer(), now());
  }
  /// No connection tells that it is gone.
  void silence_provider(std::size_t k = 0) { providers.at(k)->alive = false; }
  /// It knows nothing of before, and has another number.
  void restart_provider() {
    constexpr provider_id::rep later = 100;
    auto& again = *providers.front();
    again.start(static_cast<provider_id>(later + again.starts));
  }
  void crash_vehicle() {
    alive = false;
    for (auto& p : providers)
      if (p->alive)
        p->side->on_lost(vehicle_peer, now());
  }
};

} // namespace sofof::test

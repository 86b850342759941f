// Who has been let in.
#include "actors/remote/admissions.hpp"

#include "actors/remote/provider_endpoint.hpp"
#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"
#include "base/protocol.hpp"
#include "base/text/printable.hpp"
#include "network/flow/sampled_log.hpp"
#include "network/flow/token_bucket.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sofof::actors {

namespace {

constexpr std::size_t most_connections_of_one = 16;
/// How often a name may come in, and how many of them are remembered.
constexpr double arrivals_s = 1;
constexpr double arrivals_at_once = 32;
constexpr std::size_t most_names = 1000;

/// A peer that comes and goes all the time fills no journal.
constexpr double news_per_second = 0.1;
constexpr double news_at_once = 40;
/// Between two lines of the log about who was refused.
constexpr duration refusal_period = std::chrono::seconds{1};

/// A peer that has been let in.
struct admitted_peer {
  messages::provider_endpoint_actor endpoint;
  std::string name;
  std::set<station_id> stations;
};

bool share_one(const std::set<station_id>& a, const std::set<station_id>& b) {
  return std::ranges::any_of(a, [&b](auto x) { return b.contains(x); });
}

/// @returns a number for the owner of a certificate: not 0, and no station's.
sender_id sender_of(const std::string& name) {
  constexpr auto no_station = sender_id::rep{1} << 63;
  return std::hash<std::string>{}(name) | no_station;
}

using admissions_impl = admissions_actor::extend<
    messages::reacts_to<messages::tick_atom, messages::handshake_actor>>;

struct admissions_state {
  static inline const char* name = "admissions";

  admissions_impl::stateful_pointer<admissions_state> self;
  std::shared_ptr<const acceptor_setup> setup;
  std::vector<admitted_peer> peers;
  std::map<std::string, network::token_bucket> arrivals; // by name
  network::token_bucket chatter{news_per_second, news_at_once};
  network::sampled_log refusals{refusal_period};

  caf::result<messages::peer_welcome, messages::provider_endpoint_actor>
  on_admission(const messages::admission& given) {
    const auto* who = given.get();
    if (!who)
      return caf::make_error(caf::sec::invalid_argument);
    if (!may_come(who->name))
      return refuse(fmt::format("{} comes in too often", who->name));
    const std::set<station_id> stations{who->hello.stations.begin(),
                                        who->hello.stations.end()};
    replace(who->name, stations);
    const auto there =
        std::ranges::count(peers, who->name, &admitted_peer::name);
    if (static_cast<std::size_t>(there) >= most_connections_of_one)
      return refuse(
          fmt::format("the certificate of {} has {} connections already, the "
                      "most it may have",
                      who->name, there));
    const auto endpoint = spawn_provider_endpoint(
        self->system(), {setup->provider, who->peer, stations, setup->clock,
                         messages::etsi::its_clock{who->hello.epoch_unix_ms},
                         setup->recorder, sender_of(who->name), setup->pace});
    self->monitor(endpoint);
    peers.push_back({endpoint, who->name, stations});
    publish(stations, true);
    return {messages::peer_welcome{setup->id, setup->clock.epoch_unix_ms()},
            endpoint};
  }

  /// Ends what speaks for one of these stations by the same certificate.
  void replace(const std::string& who, const std::set<station_id>& stations) {
    std::erase_if(peers, [&](const admitted_peer& other) {
      const auto is_replaced =
          other.name == who && share_one(other.stations, stations);
      if (is_replaced)
        self->send_exit(other.endpoint, caf::exit_reason::user_shutdown);
      return is_replaced;
    });
  }

  caf::error refuse(const std::string& why) {
    on_refusal(why);
    return caf::make_error(caf::sec::runtime_error, why);
  }

  bool may_come(const std::string& who) {
    if (arrivals.size() >= most_names)
      arrivals.clear();
    return arrivals.try_emplace(who, arrivals_s, arrivals_at_once)
        .first->second.try_spend(now(self));
  }

  void on_down(const caf::actor_addr& who) {
    if (who == setup->provider.address()) {
      // There is nothing left to be let in to.
      self->quit(caf::exit_reason::user_shutdown);
      return;
    }
    std::erase_if(peers, [&](const admitted_peer& x) {
      const auto is = x.endpoint.address() == who;
      if (is)
        publish(x.stations, false);
      return is;
    });
  }

  void publish(const std::set<station_id>& stations, bool is_here) {
    if (chatter.try_spend(now(self)))
      setup->on_peer(stations, is_here);
  }

  void on_refusal(const std::string& why) {
    const auto t = now(self);
    if (auto line = refusals.add(printable(why), t))
      send_record(
          self, setup->recorder,
          messages::event_record{.at = t,
                                 .what = messages::event_type::peer_refused,
                                 .provider = setup->id,
                                 .detail = std::move(*line)});
  }
};

admissions_impl::behavior_type
admissions(admissions_impl::stateful_pointer<admissions_state> self,
           std::shared_ptr<const acceptor_setup> setup) {
  self->state.self = self;
  self->state.setup = std::move(setup);
  self->monitor(self->state.setup->provider);
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.on_down(down.source); });
  return {
      [self](const messages::admission& given) {
        return self->state.on_admission(given);
      },
      [self](const std::string& why) { self->state.on_refusal(why); },
      [self](const messages::handshake_actor& opened) {
        send_after(self, self, protocol::handshake_timeout,
                   messages::tick_atom_v, opened);
      },
      [self](messages::tick_atom, const messages::handshake_actor& opened) {
        self->send_exit(opened, caf::exit_reason::user_shutdown);
      },
  };
}

} // namespace

admissions_actor spawn_admissions(caf::actor_system& sys,
                                  std::shared_ptr<const acceptor_setup> setup) {
  return sys.spawn(admissions, std::move(setup));
}

} // namespace sofof::actors

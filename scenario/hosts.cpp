// A scenario on several hosts: providers here, vehicles there.
#include "scenario/hosts.hpp"

#include "actors/remote/acceptor.hpp"
#include "actors/remote/provider_connection.hpp"
#include "actors/runtime/supervisor.hpp"
#include "base/input_error.hpp"
#include "network/tls/tls_connector.hpp"
#include "scenario/host_parts.hpp"
#include "scenario/registry.hpp"
#include "scenario/runtime.hpp"
#include "scenario/secure_listener.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>

namespace sofof::scenario {

namespace {

/// Where a provider is that a registry may know.
const network::network_address nobody_yet{"127.0.0.1", 0};

/// On this machine alone a peer is heard as if it were so many.
constexpr std::size_t most_unknown_stations = 256;

/// @param listener  Tells of itself, too.
std::function<void(recording::exposition&)>
figures_with(const std::shared_ptr<network::key_ring>& keys,
             const secure_listener& listener) {
  return [of_keys = figures_of(keys), &listener](recording::exposition& to) {
    to.family("sofof_handshakes_refused", recording::exposition::kind::counter,
              "TLS connections that were refused.");
    to.sample({}, listener.refused_handshakes());
    if (of_keys)
      of_keys(to);
  };
}

/// @returns what writes down and shows what becomes of a registry.
registry_listener listener_of(std::shared_ptr<news_board> board,
                              const runtime& time,
                              messages::recorder_actor recorder) {
  return recording_listener(
      [board = std::move(board)](std::string line) {
        board->log(std::move(line));
      },
      time, std::move(recorder));
}

using redirection = std::function<void(const network::network_address&)>;

/// Lets a connection go through TLS.
/// @param connectors  Gets one that outlives the connection.
/// @returns what makes later attempts lead elsewhere.
redirection
secure(actors::provider_connection_setup& setup,
       const network::network_address& at,
       std::vector<std::unique_ptr<network::tls_connector>>& connectors,
       const std::shared_ptr<network::key_ring>& keys, network_runtime& time) {
  const auto own = keys->now();
  auto& connector =
      *connectors.emplace_back(std::make_unique<network::tls_connector>(
          &own, network::connector_options{.remote = at,
                                           .provider = setup.provider}));
  keys->add_user([&connector](const network::credentials& fresh) {
    connector.renew(fresh);
  });
  setup.connect =
      [&time,
       &connector]() -> std::variant<messages::acceptor_actor, std::string> {
    auto acceptor = time.connect(connector.port());
    const auto why = connector.last_error();
    if (std::holds_alternative<std::string>(acceptor) && !why.empty())
      return why;
    return acceptor;
  };
  setup.hang_up = [&connector] { connector.hang_up(); };
  prove_by(keys, setup);
  return [&connector](const auto& to) { connector.lead_to(to); };
}

/// Lets a connection lead to a port of this machine.
/// @returns what makes later attempts lead to another one.
redirection connect_here(actors::provider_connection_setup& setup,
                         const network::network_address& at,
                         network_runtime& time) {
  const auto port = std::make_shared<std::atomic<std::uint16_t>>(at.port);
  setup.connect = [&time, port] { return time.connect(*port); };
  return [port](const auto& to) { *port = to.port; };
}

/// Lets nobody ask a registry who outlives this.
struct end_of_asking {
  std::optional<discovery>& of;
  ~end_of_asking() {
    if (of)
      of->end();
  }
};

/// Asks whether a hello comes by the connection of whoever has signed it.
/// @param tls  Whom that connection has established.
actors::peer_finding examine(const network::credentials& own,
                             const messages::peer_hello& hello,
                             const std::string& nonce,
                             const std::optional<network::peer_identity>& tls) {
  auto found = examine_signature(own, hello, nonce);
  const auto by = tls ? network::describe(*tls) : "nobody";
  if (!found.refusal && found.name != by)
    return {{},
            fmt::format("its hello is signed for {}, but its connection is "
                        "that of {}",
                        found.name, by)};
  return found;
}

} // namespace

run_outcome provide(const scenario_definition& s, const provide_options& what,
                    run_options options, const std::atomic<bool>& interrupted,
                    std::ostream& console) {
  const auto place = find_provider(s, what.name, "--name");
  const auto& name = s.providers[place].name;
  check_lives(s.providers[place]);
  const auto keys = load_keys(what.listen, what.keys, "--listen",
                              [&](const network::credentials& own) {
                                check_identity(own, what.keys, name);
                              });
  std::optional<register_options> registry;
  if (what.registry)
    registry = complete_registration(*what.registry, what.listen, name);
  secure_listener listener{keys, what.listen};
  const auto time = make_network_runtime(what.clock);
  const auto board = std::make_shared<news_board>();
  std::optional<announcement> entry;
  options = options_of_host(std::move(options), "provide", name);
  options.more_figures = figures_with(keys, listener);
  options.news = news_of(board, what, keys);
  const auto here = share_of_provider(place, *time);
  const auto open = [&](const world_actors& actors) {
    auto setup = acceptor_of(s, place, what.own_map, *time, board);
    setup.examine = [keys, &time = *time](const messages::peer_hello& hello,
                                          const std::string& nonce,
                                          const caf::node_id& process) {
      return keys
                 ? examine(keys->now(), hello, nonce, time.identity_of(process))
                 : believe(hello);
    };
    setup.provider = actors.providers.front();
    setup.id = provider_at(static_cast<std::uint32_t>(place + 1), here.start);
    setup.recorder = actors.recorder;
    actors::filter_setup filter;
    if (keys)
      filter.identify = [&listener](std::uint16_t port) {
        return listener.peers().find(port);
      };
    filter.stations = most_unknown_stations;
    filter.recorder = setup.recorder;
    filter.on_refusal = [board](const std::string& why) { board->log(why); };
    time->filter(std::move(filter));
    const auto acceptor =
        actors::spawn_acceptor(time->system(), std::move(setup));
    actors::watch(actors.supervisor, caf::actor_cast<caf::actor>(acceptor),
                  "the acceptor");
    const auto at =
        listener.open(*time, acceptor, [board](const std::string& why) {
          board->log("refused: " + why);
        });
    console << fmt::format("provider {} listens on {}{}", name,
                           network::print_address(at),
                           keys ? "" : ", for this machine alone")
            << std::endl;
    if (registry)
      entry.emplace(*registry, at, what.protocol, name, keys != nullptr,
                    listener_of(board, *time, actors.recorder));
  };
  options.when_ending = [&entry] {
    if (entry)
      entry->end();
  };
  const auto outcome =
      run_part(s, options, here, *time, interrupted, console, open);
  entry.reset();
  for (const auto& line : board->take())
    console << line << std::endl;
  return outcome;
}

run_outcome drive(const scenario_definition& s, const drive_options& what,
                  run_options options, const std::atomic<bool>& interrupted,
                  std::ostream& console) {
  auto here = share_of_vehicles(s, what.stations);
  const auto stations = connected_stations(s, here);
  std::shared_ptr<network::key_ring> keys;
  // Outlive what uses them.
  std::vector<std::unique_ptr<network::tls_connector>> connectors;
  std::optional<discovery> registry;
  if (what.registry)
    registry.emplace(s, what);
  const auto time = make_network_runtime(what.clock);
  const end_of_asking at_the_end{registry};
  const auto board = std::make_shared<news_board>();
  options = options_of_host(std::move(options), "drive", "cars");
  actors::filter_setup filter;
  filter.stations = stations.size();
  filter.on_refusal = [board](const std::string& why) { board->log(why); };
  time->filter(std::move(filter));
  for (const auto& to : wanted_providers(s, what)) {
    const auto place = find_provider(s, to.name, "--provider NAME=HOST:PORT");
    if (std::ranges::find(here.remotes, place,
                          &process_share::remote_provider::place)
        != here.remotes.end())
      throw input_error(fmt::format("--provider: {} is given twice; a provider "
                                    "has one address",
                                    s.providers[place].name));
    const auto at = to.at.value_or(nobody_yet);
    if (!keys)
      keys = load_keys(at, what.keys, "--provider",
                       [&](const network::credentials& own) {
                         check_identity(own, what.keys, stations);
                       });
    auto setup = connection_to(s, place, what, stations, board);
    setup.address = [text = network::print_address(at)] { return text; };
    setup.clock = time->clock();
    auto lead_to = keys ? secure(setup, at, connectors, keys, *time)
                        : connect_here(setup, at, *time);
    if (!to.at)
      look_up(setup, *registry, std::move(lead_to));
    here.remotes.push_back(
        {place, [&time = *time, setup, &registry,
                 board](const messages::recorder_actor& recorder) {
           auto with = setup;
           with.recorder = recorder;
           if (registry)
             registry->begin(listener_of(board, time, recorder));
           return actors::spawn_provider_connection(time.system(),
                                                    std::move(with));
         }});
  }
  options.news = news_of(board, what, keys);
  options.more_figures = figures_of(keys);
  const auto outcome = run_part(s, options, here, *time, interrupted, console);
  for (const auto& connector : connectors)
    connector->hang_up(); // attempts end now
  return outcome;
}

} // namespace sofof::scenario

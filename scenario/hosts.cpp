// A scenario on several hosts: providers here, vehicles there.
#include "scenario/hosts.hpp"

#include "actors/remote/acceptor.hpp"
#include "actors/remote/provider_connection.hpp"
#include "actors/runtime/supervisor.hpp"
#include "base/input_error.hpp"
#include "network/tls/tls_connector.hpp"
#include "scenario/host_parts.hpp"
#include "scenario/runtime.hpp"
#include "scenario/secure_listener.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <ostream>
#include <utility>

namespace sofof::scenario {

namespace {

/// On this machine alone a peer is heard as if it were so many.
constexpr std::size_t most_unknown_stations = 256;

/// Lets a connection go through TLS.
/// @param connector  Outlives the connection.
void secure(actors::provider_connection_setup& setup,
            network::tls_connector& connector,
            const std::shared_ptr<network::key_ring>& keys,
            network_runtime& time) {
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
}

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
  secure_listener listener{keys, what.listen};
  const auto time = make_network_runtime(what.clock);
  const auto board = std::make_shared<news_board>();
  options = options_of_host(std::move(options), "provide", name);
  options.more_figures = [of_keys = figures_of(keys),
                          &listener](recording::exposition& to) {
    to.family("sofof_handshakes_refused", recording::exposition::kind::counter,
              "TLS connections that were refused.");
    to.sample({}, listener.refused_handshakes());
    if (of_keys)
      of_keys(to);
  };
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
  };
  return run_part(s, options, here, *time, interrupted, console, open);
}

run_outcome drive(const scenario_definition& s, const drive_options& what,
                  run_options options, const std::atomic<bool>& interrupted,
                  std::ostream& console) {
  check_stations(s, what.stations);
  process_share here;
  here.drives = [stations = what.stations](station_id x) {
    return stations.empty() || stations.contains(x);
  };
  here.provides = [](std::size_t) { return false; };
  const auto stations = connected_stations(s, here);
  std::shared_ptr<network::key_ring> keys;
  // Outlive what uses them.
  std::vector<std::unique_ptr<network::tls_connector>> connectors;
  const auto time = make_network_runtime(what.clock);
  const auto board = std::make_shared<news_board>();
  options = options_of_host(std::move(options), "drive", "cars");
  actors::filter_setup filter;
  filter.stations = stations.size();
  filter.on_refusal = [board](const std::string& why) { board->log(why); };
  time->filter(std::move(filter));
  for (const auto& to : what.providers) {
    const auto place = find_provider(s, to.name, "--provider NAME=HOST:PORT");
    if (std::ranges::find(here.remotes, place,
                          &process_share::remote_provider::place)
        != here.remotes.end())
      throw input_error(fmt::format("--provider: {} is given twice; a provider "
                                    "has one address",
                                    s.providers[place].name));
    if (!keys)
      keys = load_keys(to.at, what.keys, "--provider",
                       [&](const network::credentials& own) {
                         check_identity(own, what.keys, stations);
                       });
    auto setup = connection_to(s, place, what, stations, board);
    setup.address = network::print_address(to.at);
    setup.clock = time->clock();
    if (keys) {
      const auto own = keys->now();
      connectors.push_back(std::make_unique<network::tls_connector>(
          &own, network::connector_options{.remote = to.at,
                                           .provider = setup.provider}));
      secure(setup, *connectors.back(), keys, *time);
    } else {
      setup.connect = [&time = *time, port = to.at.port] {
        return time.connect(port);
      };
    }
    here.remotes.push_back(
        {place,
         [&time = *time, setup](const messages::recorder_actor& recorder) {
           auto with = setup;
           with.recorder = recorder;
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

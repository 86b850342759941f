// A scenario on several hosts: providers here, vehicles there.
#include "scenario/hosts.hpp"

#include "actors/remote/acceptor.hpp"
#include "actors/remote/provider_connection.hpp"
#include "actors/runtime/supervisor.hpp"
#include "base/fingerprint.hpp"
#include "base/input_error.hpp"
#include "base/text/printable.hpp"
#include "network/keys/certificate.hpp"
#include "network/keys/key_ring.hpp"
#include "network/keys/nonce.hpp"
#include "network/tls/tls_connector.hpp"
#include "scenario/build.hpp"
#include "scenario/news_board.hpp"
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

/// Vehicles are on their own at first: a hundred first plans keep a computer
/// busy for a while, and nobody should be judged by results of that time.
constexpr duration first_rest = std::chrono::seconds{1};

/// Where a provider is that a registry may know.
const network::network_address nobody_yet{"127.0.0.1", 0};

/// On this machine alone a peer is heard as if it were so many.
constexpr std::size_t most_unknown_stations = 256;

/// @returns what a run asks for news, which also reads the keys again when
/// they have changed.
std::function<std::vector<std::string>()>
news_of(std::shared_ptr<news_board> board, const host_options& what,
        std::shared_ptr<network::key_ring> keys) {
  return [board = std::move(board), keys = std::move(keys),
          changed = what.keys_have_changed] {
    if (keys && changed && changed->exchange(false))
      board->log(keys->read_again());
    return board->take();
  };
}

/// @param keys  May be null: then there is nothing to tell.
std::function<void(recording::exposition&)>
figures_of(std::shared_ptr<network::key_ring> keys) {
  if (!keys)
    return {};
  return [keys = std::move(keys)](recording::exposition& to) {
    const auto own =
        network::certificate_from_pem(keys->now().certificate_pem());
    to.family("sofof_certificate_expiry_timestamp_seconds",
              recording::exposition::kind::gauge,
              "Last second of the own certificate, since 1970.", "seconds");
    to.sample({}, static_cast<double>(network::last_second_of(*own)));
  };
}

/// @param listener  Tells of itself, too.
std::function<void(recording::exposition&)>
figures_of(const std::shared_ptr<network::key_ring>& keys,
           const secure_listener& listener) {
  return [of_keys = figures_of(keys), &listener](recording::exposition& to) {
    to.family("sofof_handshakes_refused", recording::exposition::kind::counter,
              "TLS connections that were refused.");
    to.sample({}, listener.refused_handshakes());
    if (of_keys)
      of_keys(to);
  };
}

/// Makes a run that of a process which talks to others.
void set_up(run_options& options, std::string_view role) {
  options.realtime = true;
  options.when_unwritable = recording::write_failure::ends_the_files;
  options.network = "real";
  options.role = role;
}

/// What both sides must have in common: the map, or only its frame, and the
/// services.
std::uint64_t fingerprint_of_world(const scenario_definition& s, bool own_map) {
  auto text = s.map_text;
  if (own_map) {
    const auto& at = s.world->map.origin();
    text = fmt::format("{} {} {} {} {}", at.utm_e_m, at.utm_n_m, at.utm_zone,
                       at.lat_deg, at.lon_deg);
  } else if (s.grid) {
    scenario_definition streets; // and nothing else
    streets.grid = true;
    streets.grid_params = s.grid_params;
    text = to_toml(streets);
  }
  for (const auto& type : s.services) {
    text += '\n';
    text += type->name();
  }
  return fingerprint(text);
}

std::string names_of(const scenario_definition& s) {
  std::string names;
  for (const auto& p : s.providers)
    names += (names.empty() ? "" : ", ") + p.name;
  return names.empty() ? "none" : names;
}

/// @returns the place of a provider in the scenario, counting from 0.
std::size_t find_provider(const scenario_definition& s, std::string_view name,
                          std::string_view option) {
  if (name.empty() && s.providers.size() == 1)
    return 0;
  if (name.empty())
    throw input_error(fmt::format("the scenario has {} providers; say with {} "
                                  "which one is meant: {}",
                                  s.providers.size(), option, names_of(s)));
  const auto i = std::ranges::find(s.providers, name, &provider_options::name);
  if (i == s.providers.end())
    throw input_error(fmt::format("the scenario has no provider '{}'; choose "
                                  "with {} among {}",
                                  name, option, names_of(s)));
  return static_cast<std::size_t>(i - s.providers.begin());
}

/// On this machine alone nobody proves anything, and any stations are a peer.
actors::peer_finding believe(const messages::peer_hello& hello) {
  const std::set<station_id> all{hello.stations.begin(), hello.stations.end()};
  return {
      network::describe(network::peer_identity{{all.begin(), all.end()}, {}}),
      {}};
}

/// @param tls  Whom TLS has established.
actors::peer_finding examine(const network::credentials& own,
                             const messages::peer_hello& hello,
                             const std::string& nonce,
                             const std::optional<network::peer_identity>& tls) {
  const auto& provider = own.identity().provider;
  const auto proved = own.prove(
      hello.certificate, messages::proof_of(nonce, provider, hello.stations),
      hello.signature);
  if (!proved.who)
    return {{}, proved.refusal};
  if (tls != proved.who)
    return {
        {},
        fmt::format("its hello is signed for {}, but its connection is that "
                    "of {}",
                    network::describe(*proved.who),
                    tls ? network::describe(*tls) : "nobody")};
  for (const auto station : hello.stations)
    if (!proved.who->has(station))
      return {{},
              fmt::format("its certificate is for {}, not for station {}",
                          network::describe(*proved.who), station)};
  return {network::describe(*proved.who), {}};
}

void check_identity(const network::credentials& own, const std::string& folder,
                    const std::string& provider) {
  if (own.identity().provider != provider)
    throw input_error(fmt::format(
        "the certificate in {} is for {}, not for provider {}; issue one with "
        "`sofof keys issue`",
        folder, network::describe(own.identity()), provider));
}

void check_identity(const network::credentials& own, const std::string& folder,
                    const std::vector<station_id>& stations) {
  for (const auto station : stations)
    if (!own.identity().has(station))
      throw input_error(fmt::format(
          "the certificate in {} is for {}, not for station {}; choose others "
          "with --station, or issue one with `sofof keys issue`",
          folder, network::describe(own.identity()), station));
}

void check_stations(const scenario_definition& s,
                    const std::set<station_id>& wanted) {
  std::set<station_id> missing = wanted;
  for (const auto& fleet : s.fleets)
    for (std::int64_t k = 0; k < fleet.count; ++k)
      missing.erase(static_cast<station_id>(fleet.first_station + k));
  if (!missing.empty())
    throw input_error(fmt::format("the scenario has no station {}; see its "
                                  "fleets for those it has",
                                  *missing.begin()));
}

std::vector<station_id> connected_stations(const scenario_definition& s,
                                           const process_share& here) {
  std::vector<station_id> all;
  for (const auto& fleet : s.fleets)
    for (std::int64_t k = 0; fleet.connected && k < fleet.count; ++k)
      if (const auto x = static_cast<station_id>(fleet.first_station + k);
          here.drives(x))
        all.push_back(x);
  std::ranges::sort(all);
  return all;
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

/// @returns the moment of a start, in ms since 1970.
std::uint64_t start_of(const runtime& time) {
  const auto now = std::chrono::floor<std::chrono::milliseconds>(
      time.clock().unix_time(time.now()));
  return static_cast<std::uint64_t>(now.count());
}

/// @returns whom a provider lets in; what is of its actors is filled in later.
actors::acceptor_setup acceptor_of(const scenario_definition& s,
                                   std::size_t place, bool own_map,
                                   std::shared_ptr<network::key_ring> keys,
                                   network_runtime& time,
                                   const std::shared_ptr<news_board>& board) {
  actors::acceptor_setup setup;
  setup.name = s.providers[place].name;
  setup.world = fingerprint_of_world(s, own_map);
  setup.clock = time.clock();
  setup.draw_nonce = &network::draw_nonce;
  setup.examine = [keys = std::move(keys), &time](
                      const messages::peer_hello& hello,
                      const std::string& nonce, const caf::node_id& process) {
    return keys ? examine(keys->now(), hello, nonce, time.identity_of(process))
                : believe(hello);
  };
  setup.on_peer = [board](const std::set<station_id>& all, bool is_here) {
    board->log(
        network::describe(network::peer_identity{{all.begin(), all.end()}, {}})
        + (is_here ? " connected" : " disconnected"));
  };
  return setup;
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
  setup.prove = [keys, provider = setup.provider](messages::peer_hello& hello,
                                                  const std::string& nonce) {
    const auto own = keys->now();
    hello.certificate = own.certificate_pem();
    hello.signature =
        own.sign(messages::proof_of(nonce, provider, hello.stations));
  };
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

/// @returns the connection to one provider, as far as it is like that to any.
actors::provider_connection_setup
connection_to(const scenario_definition& s, std::size_t place,
              const drive_options& what,
              const std::vector<station_id>& stations,
              const std::shared_ptr<news_board>& board) {
  actors::provider_connection_setup setup;
  setup.provider = s.providers[place].name;
  setup.stations = stations;
  setup.world = fingerprint_of_world(s, what.own_map);
  setup.rest = first_rest;
  setup.protocol = what.protocol;
  setup.noise = random_stream{static_cast<std::uint64_t>(s.seed), "uplink"}
                    .part(place)
                    .part(stations.empty() ? 0 : stations.front().value());
  setup.prove = [](messages::peer_hello&, const std::string&) {};
  setup.on_connected = [board] { board->connected(); };
  setup.on_refusal = [board](const std::string& why) { board->refuse(why); };
  setup.on_news = [board](const std::string& news) { board->log(news); };
  return setup;
}

} // namespace

run_outcome provide(const scenario_definition& s, const provide_options& what,
                    run_options options, const std::atomic<bool>& interrupted,
                    std::ostream& console) {
  const auto place = find_provider(s, what.name, "--name");
  const auto& name = s.providers[place].name;
  if (s.providers[place].fails_at)
    throw input_error(fmt::format("provider {} has fails_at, which is for runs "
                                  "of one process; remove it, and end this "
                                  "process instead",
                                  name));
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
  set_up(options, "provide");
  options.more_figures = figures_of(keys, listener);
  options.whose = name;
  options.news = news_of(board, what, keys);
  process_share here;
  here.drives = [](station_id) { return false; };
  here.provides = [place](std::size_t k) { return k == place; };
  here.serves_others = true;
  here.start = start_of(*time);
  const auto open = [&](const world_actors& actors) {
    auto setup = acceptor_of(s, place, what.own_map, keys, *time, board);
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
  std::optional<discovery> registry;
  if (what.registry)
    registry.emplace(s, what);
  const auto time = make_network_runtime(what.clock);
  const end_of_asking at_the_end{registry};
  const auto board = std::make_shared<news_board>();
  set_up(options, "drive");
  options.whose = "cars";
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

// What providers and vehicles on hosts of their own have in common.
#include "scenario/host_parts.hpp"

#include "base/fingerprint.hpp"
#include "base/input_error.hpp"
#include "network/keys/certificate.hpp"
#include "network/keys/nonce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sofof::scenario {

namespace {

/// Vehicles are on their own at first: a hundred first plans keep a computer
/// busy for a while, and nobody should be judged by results of that time.
constexpr duration first_rest = std::chrono::seconds{1};

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
    if (!p.carrier)
      names += (names.empty() ? "" : ", ") + p.name;
  return names.empty() ? "none" : names;
}

/// @returns the moment of a start, in ms since 1970.
std::uint64_t start_of(const runtime& time) {
  const auto now = std::chrono::floor<std::chrono::milliseconds>(
      time.clock().unix_time(time.now()));
  return static_cast<std::uint64_t>(now.count());
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

} // namespace

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

std::size_t find_provider(const scenario_definition& s, std::string_view name,
                          std::string_view option) {
  const auto standing = std::ranges::count_if(
      s.providers, [](const auto& p) { return !p.carrier; });
  if (name.empty() && standing == 1)
    return 0; // those that ride are the last
  if (name.empty() && standing == 0)
    throw input_error("the scenario has no [[provider]], which alone runs on a "
                      "host of its own");
  if (name.empty())
    throw input_error(fmt::format("the scenario has {} providers; say with {} "
                                  "which one is meant: {}",
                                  standing, option, names_of(s)));
  const auto i = std::ranges::find(s.providers, name, &provider_options::name);
  if (i == s.providers.end())
    throw input_error(fmt::format("the scenario has no provider '{}'; choose "
                                  "with {} among {}",
                                  name, option, names_of(s)));
  if (i->carrier)
    throw input_error(fmt::format("provider {} rides with vehicle {} and runs "
                                  "where that does, as part of `sofof drive`",
                                  name, i->carrier->station));
  return static_cast<std::size_t>(i - s.providers.begin());
}

actors::peer_finding believe(const messages::peer_hello& hello) {
  const std::set<station_id> all{hello.stations.begin(), hello.stations.end()};
  return {
      network::describe(network::peer_identity{{all.begin(), all.end()}, {}}),
      {}};
}

actors::peer_finding examine_signature(const network::credentials& own,
                                       const messages::peer_hello& hello,
                                       const std::string& nonce) {
  const auto& provider = own.identity().provider;
  const auto proved = own.prove(
      hello.certificate, messages::proof_of(nonce, provider, hello.stations),
      hello.signature);
  if (!proved.who)
    return {{}, proved.refusal};
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

void check_lives(const provider_options& provider) {
  if (provider.fails_at)
    throw input_error(fmt::format("provider {} has fails_at, which is for runs "
                                  "of one process; remove it, and end this "
                                  "process instead",
                                  provider.name));
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

run_options options_of_host(run_options options, std::string_view role,
                            std::string whose) {
  options.realtime = true;
  options.when_unwritable = recording::write_failure::ends_the_files;
  options.network = "real";
  options.role = role;
  options.whose = std::move(whose);
  return options;
}

process_share share_of_provider(std::size_t place, const runtime& time) {
  process_share here;
  here.drives = [](station_id) { return false; };
  here.provides = [place](std::size_t k) { return k == place; };
  here.serves_others = true;
  here.start = start_of(time);
  return here;
}

process_share share_of_vehicles(const scenario_definition& s,
                                const std::set<station_id>& wanted) {
  check_stations(s, wanted);
  process_share here;
  here.drives = [wanted](station_id x) {
    return wanted.empty() || wanted.contains(x);
  };
  here.provides = [](std::size_t) { return false; };
  return here;
}

actors::acceptor_setup acceptor_of(const scenario_definition& s,
                                   std::size_t place, bool own_map,
                                   const runtime& time,
                                   const std::shared_ptr<news_board>& board) {
  actors::acceptor_setup setup;
  setup.name = s.providers[place].name;
  setup.world = fingerprint_of_world(s, own_map);
  setup.clock = time.clock();
  setup.draw_nonce = &network::draw_nonce;
  setup.on_peer = [board](const std::set<station_id>& all, bool is_here) {
    board->log(
        network::describe(network::peer_identity{{all.begin(), all.end()}, {}})
        + (is_here ? " connected" : " disconnected"));
  };
  return setup;
}

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

void prove_by(const std::shared_ptr<network::key_ring>& keys,
              actors::provider_connection_setup& setup) {
  setup.prove = [keys, provider = setup.provider](messages::peer_hello& hello,
                                                  const std::string& nonce) {
    const auto own = keys->now();
    hello.certificate = own.certificate_pem();
    hello.signature =
        own.sign(messages::proof_of(nonce, provider, hello.stations));
  };
}

} // namespace sofof::scenario

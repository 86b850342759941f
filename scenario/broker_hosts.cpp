// A scenario on several hosts that an AMQP broker connects.
#include "scenario/broker_hosts.hpp"

#include "actors/broker/provider_side.hpp"
#include "actors/broker/vehicle_side.hpp"
#include "actors/runtime/supervisor.hpp"
#include "actors/simulation/foreign_air.hpp"
#include "network/keys/nonce.hpp"
#include "scenario/datagram_air.hpp"
#include "scenario/host_parts.hpp"
#include "scenario/secure_listener.hpp"

#include <fmt/format.h>

#include <cstring>
#include <ostream>
#include <utility>

namespace sofof::scenario {

namespace {

/// Clock exchanges over a broker cost it as much as CAMs do.
constexpr actors::heartbeat_pace broker_pace{std::chrono::milliseconds{500},
                                             std::chrono::seconds{2}};

std::shared_ptr<network::key_ring> keys_for(const broker_options& broker,
                                            const std::string& folder,
                                            network::key_ring::user check) {
  return load_keys(broker.url.at, folder, "--broker", std::move(check));
}

std::int64_t draw_link() {
  const auto nonce = network::draw_nonce();
  std::int64_t link = 0;
  std::memcpy(&link, nonce.data(), std::min(nonce.size(), sizeof link));
  return link;
}

std::function<void(const std::string&)>
news_to(const std::shared_ptr<news_board>& board) {
  return [board](const std::string& line) { board->log(line); };
}

std::function<void(recording::exposition&)>
figures_of_both(const std::shared_ptr<network::key_ring>& keys,
                const std::shared_ptr<broker_connection>& connection) {
  return [of_keys = figures_of(keys), connection](recording::exposition& to) {
    connection->write_figures(to);
    if (of_keys)
      of_keys(to);
  };
}

/// Closes a connection before those end that it tells; these may still send.
struct connection_closer {
  std::shared_ptr<broker_connection> connection;
  ~connection_closer() { connection->close(); }
};

actors::provider_side_setup
provider_setup(const scenario_definition& s, std::size_t place,
               const messages::acceptor_actor& acceptor,
               const std::shared_ptr<broker_connection>& connection) {
  return {.acceptor = acceptor,
          .name = s.providers[place].name,
          .station = provider_station(static_cast<std::uint32_t>(place)),
          .user = connection->user(),
          .send = [connection](const auto& x) { connection->send(x); }};
}

/// @returns who hears stations that no process of this scenario has.
std::shared_ptr<actors::foreign_air>
ear_of_provider(const scenario_definition& s, const world_actors& actors,
                runtime& time) {
  return std::make_shared<actors::foreign_air>(
      time.system(),
      actors::foreign_air_setup{
          actors.providers, {}, reader_of(s, time), stations_of(s)});
}

/// @returns who hears claims of vehicles of other processes.
std::shared_ptr<actors::foreign_air>
ear_of_vehicles(const scenario_definition& s, const world_actors& actors,
                const process_share& here, runtime& time) {
  auto own = stations_of(s);
  std::erase_if(own, [&here](station_id x) { return !here.drives(x); });
  return std::make_shared<actors::foreign_air>(
      time.system(), actors::foreign_air_setup{
                         {}, actors.air, reader_of(s, time), std::move(own)});
}

actors::vehicle_side_setup
vehicles_setup(const std::vector<station_id>& all, const broker_options& broker,
               const std::shared_ptr<broker_connection>& connection) {
  actors::vehicle_side_setup setup;
  setup.station = all.empty() ? station_id{0} : all.front();
  setup.user = connection->user();
  if (!setup.user.empty() && !broker.trusted)
    setup.is_sent_by = [](const std::string& user,
                          const std::string& provider) {
      return user == network::describe({{}, provider});
    };
  setup.send = [connection](const auto& x) { connection->send(x); };
  setup.draw_link = &draw_link;
  return setup;
}

} // namespace

run_outcome provide_by_broker(const scenario_definition& s,
                              const provide_options& what,
                              const broker_options& broker, run_options options,
                              const std::atomic<bool>& interrupted,
                              std::ostream& console) {
  const auto place = find_provider(s, what.name, "--name");
  const auto& name = s.providers[place].name;
  check_lives(s.providers[place]);
  const auto keys =
      keys_for(broker, what.keys, [&](const network::credentials& own) {
        check_identity(own, what.keys, name);
      });
  const auto time = make_network_runtime(what.clock);
  const auto board = std::make_shared<news_board>();
  options = options_of_host(std::move(options), "provide", name);
  options.news = news_of(board, what, keys);
  const auto here = share_of_provider(place, *time);
  const auto connection = std::make_shared<broker_connection>(
      broker, keys, *time,
      actors::wire::selector_of_provider(
          provider_station(static_cast<std::uint32_t>(place))),
      news_to(board));
  const connection_closer closer{connection};
  options.more_figures = figures_of_both(keys, connection);
  const auto open = [&](const world_actors& actors) {
    auto setup = acceptor_of(s, place, what.own_map, *time, board);
    setup.examine = [keys](const messages::peer_hello& hello,
                           const std::string& nonce, const caf::node_id&) {
      return keys ? examine_signature(keys->now(), hello, nonce)
                  : believe(hello);
    };
    setup.pace = broker_pace;
    setup.provider = actors.providers.front();
    setup.id = provider_at(static_cast<std::uint32_t>(place + 1), here.start);
    setup.recorder = actors.recorder;
    const auto acceptor =
        actors::spawn_acceptor(time->system(), std::move(setup));
    actors::watch(actors.supervisor, caf::actor_cast<caf::actor>(acceptor),
                  "the acceptor");
    auto of_side = provider_setup(s, place, acceptor, connection);
    of_side.on_foreign = [ear =
                              ear_of_provider(s, actors, *time)](auto message) {
      ear->on_message(std::move(message));
    };
    auto side = std::make_shared<actors::provider_side>(time->system(),
                                                        std::move(of_side));
    connection->open([side](const auto& x) { side->on_envelope(x); },
                     [side] { side->lose(); });
    console << fmt::format("provider {} serves over the broker {}", name,
                           print_broker(broker.url))
            << std::endl;
  };
  return run_part(s, options, here, *time, interrupted, console, open);
}

run_outcome drive_by_broker(const scenario_definition& s,
                            const drive_options& what,
                            const broker_options& broker, run_options options,
                            const std::atomic<bool>& interrupted,
                            std::ostream& console) {
  auto here = share_of_vehicles(s, what.stations);
  const auto stations = connected_stations(s, here);
  const auto keys =
      keys_for(broker, what.keys, [&](const network::credentials& own) {
        check_identity(own, what.keys, stations);
      });
  const auto time = make_network_runtime(what.clock);
  const auto board = std::make_shared<news_board>();
  options = options_of_host(std::move(options), "drive", "cars");
  const auto connection = std::make_shared<broker_connection>(
      broker, keys, *time, actors::wire::selector_of_vehicles(stations),
      news_to(board));
  const connection_closer closer{connection};
  options.more_figures = figures_of_both(keys, connection);
  const auto side = std::make_shared<actors::vehicle_side>(
      time->system(), vehicles_setup(stations, broker, connection));
  for (std::size_t place = 0; place < s.providers.size(); ++place) {
    if (s.providers[place].carrier)
      continue;
    auto setup = connection_to(s, place, what, stations, board);
    setup.address = [text = print_broker(broker.url)] { return text; };
    setup.clock = time->clock();
    setup.pace = broker_pace;
    if (keys)
      prove_by(keys, setup);
    setup.connect = [side, connection, name = setup.provider]()
        -> std::variant<messages::acceptor_actor, std::string> {
      if (auto why = connection->why_not())
        return fmt::format("the broker cannot be reached: {}", *why);
      return side->proxy_for(name);
    };
    here.remotes.push_back(
        {place, [&time = *time, setup](const auto& recorder) {
           auto with = setup;
           with.recorder = recorder;
           return actors::spawn_provider_connection(time.system(),
                                                    std::move(with));
         }});
  }
  options.news = news_of(board, what, keys);
  here.tell_others = [side](const messages::its_pdu& message) {
    if (const auto from = message.station())
      side->tell(*from, message);
  };
  const auto open = [&](const world_actors& actors) {
    connection->open(
        [side, ear = ear_of_vehicles(s, actors, here, *time)](const auto& x) {
          if (const auto* told = std::get_if<actors::wire::broadcast>(&x.what))
            ear->on_message(told->message);
          else
            side->on_envelope(x);
        },
        [side] { side->lose(); });
  };
  return run_part(s, options, here, *time, interrupted, console, open);
}

} // namespace sofof::scenario

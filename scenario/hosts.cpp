// A scenario on several hosts: providers here, vehicles there.
#include "scenario/hosts.hpp"

#include "actors/remote/gate.hpp"
#include "actors/remote/uplink.hpp"
#include "scenario/input_error.hpp"
#include "world/fingerprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <mutex>
#include <ostream>
#include <utility>

namespace sofof {

namespace {

/// What actors say to people; the console's thread asks for it.
class news_board {
public:
  void tell(std::string line) {
    const std::lock_guard lock{mutex_};
    lines_.push_back(std::move(line));
  }
  void refuse(const std::string& why) {
    const std::lock_guard lock{mutex_};
    refusal_ = why;
  }

  /// @throws input_error once we have been refused.
  std::vector<std::string> take() {
    const std::lock_guard lock{mutex_};
    if (refusal_)
      throw input_error(*refusal_);
    return std::exchange(lines_, {});
  }

private:
  std::mutex mutex_;
  std::vector<std::string> lines_;
  std::optional<std::string> refusal_;
};

/// What both sides must have in common: the map and the services.
std::uint64_t fingerprint_of_world(const scenario& s) {
  auto text = s.grid ? to_toml(s) : s.map_text;
  for (const auto& kind : s.services) {
    text += '\n';
    text += kind->name();
  }
  return fingerprint(text);
}

std::string names_of(const scenario& s) {
  std::string names;
  for (const auto& p : s.providers)
    names += (names.empty() ? "" : ", ") + p.name;
  return names.empty() ? "none" : names;
}

/// @returns the place of a provider in the scenario, counting from 0.
std::size_t find_provider(const scenario& s, std::string_view name,
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

/// Nobody outside may hear or say anything in plain words.
void check_secured(const host_port& at, const std::string& keys,
                   std::string_view option) {
  if (keys.empty() && !at.is_loopback())
    throw input_error(fmt::format(
        "{} {}:{} is not on this machine alone, and connections beyond it must "
        "be secured; make certificates with `sofof keys` and name their folder "
        "with --keys",
        option, at.host, at.port));
}

void check_stations(const scenario& s, const std::set<station_id>& wanted) {
  std::set<station_id> missing = wanted;
  for (const auto& fleet : s.fleets)
    for (std::int64_t k = 0; k < fleet.count; ++k)
      missing.erase(static_cast<station_id>(fleet.first_station + k));
  if (!missing.empty())
    throw input_error(fmt::format("the scenario has no station {}; see its "
                                  "fleets for those it has",
                                  *missing.begin()));
}

std::vector<station_id> connected_stations(const scenario& s,
                                           const part& here) {
  std::vector<station_id> all;
  for (const auto& fleet : s.fleets)
    for (std::int64_t k = 0; fleet.connected && k < fleet.count; ++k)
      if (const auto x = static_cast<station_id>(fleet.first_station + k);
          here.drives(x))
        all.push_back(x);
  std::ranges::sort(all);
  return all;
}

} // namespace

bool host_port::is_loopback() const {
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

host_port to_host_port(std::string_view text) {
  const auto colon = text.rfind(':');
  const auto refuse = [text]() -> host_port {
    throw input_error(fmt::format("'{}' is no HOST:PORT, like 10.0.0.5:4711 or "
                                  "[::1]:4711",
                                  text));
  };
  if (colon == std::string_view::npos)
    return refuse();
  auto host = text.substr(0, colon);
  const auto bracketed = host.starts_with('[') && host.ends_with(']');
  if (bracketed)
    host = host.substr(1, host.size() - 2);
  if (host.empty() || (!bracketed && host.find(':') != std::string_view::npos))
    return refuse();
  host_port found{std::string{host}, 0};
  const auto digits = text.substr(colon + 1);
  const auto* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, found.port);
  if (error != std::errc{} || stop != end)
    return refuse();
  return found;
}

run_outcome provide(const scenario& s, const provide_options& what,
                    run_options options, const std::atomic<bool>& interrupted,
                    std::ostream& console) {
  const auto place = find_provider(s, what.name, "--name");
  const auto& name = s.providers[place].name;
  check_secured(what.listen, what.keys, "--listen");
  const auto time = make_network_runtime(what.clock);
  const auto board = std::make_shared<news_board>();
  options.realtime = true;
  options.network = "real";
  options.news = [board] { return board->take(); };
  part here;
  here.drives = [](station_id) { return false; };
  here.provides = [place](std::size_t k) { return k == place; };
  here.start =
      static_cast<std::uint64_t>(std::chrono::floor<std::chrono::milliseconds>(
                                     time->clock().unix_time(time->now()))
                                     .count());
  const auto open = [&](const world_actors& actors) {
    gate_setup setup;
    setup.provider = actors.providers.front();
    setup.boot = boot_of(static_cast<std::uint32_t>(place + 1), here.start);
    setup.name = name;
    setup.world = fingerprint_of_world(s);
    setup.clock = time->clock();
    setup.recorder = actors.recorder;
    setup.draw_nonce = [] { return std::string{}; };
    setup.doubt = [](const peer_hello&,
                     const std::string&) -> std::optional<std::string> {
      return std::nullopt;
    };
    const auto port = time->publish(
        spawn_gate(time->system(), std::move(setup)), what.listen.port);
    console << fmt::format("provider {} listens on {}:{}", name,
                           what.listen.host, port)
            << std::endl;
  };
  return run_part(s, options, here, *time, interrupted, console, open);
}

run_outcome drive(const scenario& s, const drive_options& what,
                  run_options options, const std::atomic<bool>& interrupted,
                  std::ostream& console) {
  check_stations(s, what.stations);
  const auto time = make_network_runtime(what.clock);
  const auto board = std::make_shared<news_board>();
  options.realtime = true;
  options.network = "real";
  options.news = [board] { return board->take(); };
  part here;
  here.drives = [stations = what.stations](station_id x) {
    return stations.empty() || stations.contains(x);
  };
  here.provides = [](std::size_t) { return false; };
  const auto stations = connected_stations(s, here);
  for (const auto& to : what.providers) {
    const auto place = find_provider(s, to.name, "--provider NAME=HOST:PORT");
    check_secured(to.at, what.keys, "--provider");
    uplink_setup setup;
    setup.provider = s.providers[place].name;
    setup.address = fmt::format("{}:{}", to.at.host, to.at.port);
    setup.stations = stations;
    setup.world = fingerprint_of_world(s);
    setup.clock = time->clock();
    setup.protocol = what.protocol;
    setup.noise = random_stream{static_cast<std::uint64_t>(s.seed), "uplink"}
                      .part(place)
                      .part(stations.empty() ? 0 : stations.front());
    setup.connect = [&time = *time, port = to.at.port] {
      return time.connect(port);
    };
    setup.prove = [](peer_hello&, const std::string&) {};
    setup.on_refusal = [board](const std::string& why) { board->refuse(why); };
    setup.on_news = [board](const std::string& news) { board->tell(news); };
    here.remotes.push_back(
        {place, [&time = *time, setup](const recorder_actor& recorder) {
           auto with = setup;
           with.recorder = recorder;
           return spawn_uplink(time.system(), std::move(with));
         }});
  }
  return run_part(s, options, here, *time, interrupted, console);
}

} // namespace sofof

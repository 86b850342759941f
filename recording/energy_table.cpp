// Uses times powers, to the nanojoule.
#include "recording/energy_table.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sofof::recording {

namespace {

std::int64_t in_nj(double energy_j) {
  return std::llround(1e9 * energy_j);
}

/// How long results of vehicles' own functions took, in what the configuration
/// says; by service.
std::map<std::string, double> measured_shares(const split_ledger& done,
                                              const energy_terms& terms) {
  std::map<std::string, std::pair<double, double>> sums; // measured, configured
  for (const auto& [who, splits] : done.uses())
    for (const auto& [where, use] : splits)
      for (std::size_t k = 0; k < use.services.size(); ++k) {
        const auto& name = terms.chains[who.chain][k];
        const auto cost = terms.costs.find({who.station, name});
        if (cost == terms.costs.end())
          continue;
        auto& [measured_s, configured_s] = sums[name];
        measured_s += to_seconds(use.services[k].computing);
        configured_s += static_cast<double>(use.services[k].computed)
                        * to_seconds(cost->second.run_time);
      }
  std::map<std::string, double> shares;
  for (const auto& [name, sum] : sums)
    shares[name] = sum.second > 0 ? sum.first / sum.second : 1;
  return shares;
}

class pricing {
public:
  pricing(const energy_terms& terms, const split_ledger& done)
      : terms_{terms}, shares_{measured_shares(done, terms)} {}

  /// @returns what the services of a vehicle's chain took in one split.
  std::vector<energy_row> rows_of(const chain_user& who, const split& where,
                                  const split_use& use) const {
    std::vector<energy_row> rows;
    const auto power = terms_.vehicles.find(who.station);
    const auto& chain = terms_.chains[who.chain];
    const auto at_home = std::ranges::all_of(
        where, [](const std::string& place) { return place.empty(); });
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const auto cost = terms_.costs.find({who.station, chain[k]});
      if (power == terms_.vehicles.end() || cost == terms_.costs.end())
        continue;
      energy_row row{.station = who.station,
                     .chain = who.chain,
                     .where = where,
                     .service = chain[k],
                     .place = where[k],
                     .use = use.services[k],
                     .driven = use.driven,
                     .distance_m = use.distance_m};
      const auto own_s = to_seconds(row.use.computing);
      row.home_s =
          at_home ? own_s : computed_in(use.driven, chain[k], cost->second);
      row.resting_s = row.place.empty() ? 0 : row.home_s;
      row.resting_share = power->second.resting_share;
      price(row, power->second, cost->second.result_j);
      rows.push_back(std::move(row));
    }
    return rows;
  }

  /// @returns what a provider computed for results that nobody got.
  energy_row left_at(const std::string& provider, std::size_t chain,
                     const std::string& service, duration served) const {
    energy_row row{.chain = chain, .service = service, .place = provider};
    row.use.served[provider] = served;
    price(row, {}, 0);
    return row;
  }

private:
  /// @returns what a function would compute in that time, s.
  double computed_in(duration time, const std::string& service,
                     const service_cost& cost) const {
    if (cost.period <= duration{0})
      return 0;
    return to_seconds(time) / to_seconds(cost.period)
           * to_seconds(cost.run_time) * shares_.at(service);
  }

  void price(energy_row& row, const world::vehicle_power& power,
             double result_j) const {
    const auto& use = row.use;
    row.spent = exact_energy::of(world::energy_of(
        {.computing_s = to_seconds(use.computing),
         .resting_s = row.resting_s,
         .octets_up = static_cast<double>(use.octets_up),
         .octets_down = static_cast<double>(use.octets_down),
         .framework_j = static_cast<double>(use.results) * result_j},
        power, {}));
    for (const auto& [provider, time] : use.served) {
      const auto found = terms_.servers.find(provider);
      if (found != terms_.servers.end())
        row.spent += exact_energy::of(world::energy_of(
            {.served_s = to_seconds(time)}, power, found->second));
    }
    row.home_nj = in_nj(row.home_s * power.computing_w);
  }

  const energy_terms& terms_;
  std::map<std::string, double> shares_;
};

/// What providers computed, but for what vehicles got.
void add_left(energy_table& to, const pricing& prices,
              const energy_terms& terms, const load_table& load,
              duration length) {
  std::map<std::pair<std::string, std::string>, duration> got;
  for (const auto& row : to.rows)
    for (const auto& [provider, time] : row.use.served)
      got[{provider, row.service}] += time;
  for (const auto& server : load.servers) {
    if (server.of.busy_by.empty())
      continue;
    const auto found = terms.servers.find(server.provider);
    auto idle = length * server.of.servers;
    for (std::size_t c = 0; c < terms.chains.size(); ++c)
      for (const auto& service : terms.chains[c]) {
        const auto busy = server.of.busy_for(service, length);
        idle -= busy;
        const auto left = busy - got[{server.provider, service}];
        if (left > duration{0})
          to.rows.push_back(prices.left_at(server.provider, c, service, left));
      }
    if (found != terms.servers.end())
      to.unused_server_j +=
          found->second.idle_w * to_seconds(std::max(idle, duration{0}));
  }
}

} // namespace

exact_energy exact_energy::of(const world::energy_parts& x) {
  return {in_nj(x.computing_j),  in_nj(x.resting_j),   in_nj(x.framework_j),
          in_nj(x.sending_j),    in_nj(x.receiving_j), in_nj(x.server_busy_j),
          in_nj(x.server_idle_j)};
}

exact_energy& exact_energy::operator+=(const exact_energy& x) {
  computing_nj += x.computing_nj;
  resting_nj += x.resting_nj;
  framework_nj += x.framework_nj;
  sending_nj += x.sending_nj;
  receiving_nj += x.receiving_nj;
  server_busy_nj += x.server_busy_nj;
  server_idle_nj += x.server_idle_nj;
  return *this;
}

std::optional<double> energy_balance::saved_j_per_km() const {
  constexpr double m_per_km = 1e3;
  if (distance_m <= 0)
    return std::nullopt;
  return joules(saved_nj()) * m_per_km / distance_m;
}

std::optional<double> energy_balance::break_even_w() const {
  world::energy_use own;
  own.computing_s = own_s;
  return world::break_even_w(home_s, own,
                             {.framework_j = joules(spent.framework_nj),
                              .sending_j = joules(spent.sending_nj),
                              .receiving_j = joules(spent.receiving_nj),
                              .server_busy_j = joules(spent.server_busy_nj),
                              .server_idle_j = joules(spent.server_idle_nj)},
                             0);
}

energy_balance& energy_balance::operator+=(const energy_balance& x) {
  driven += x.driven;
  distance_m += x.distance_m;
  spent += x.spent;
  home_nj += x.home_nj;
  home_s += x.home_s;
  own_s += x.own_s;
  is_known = is_known || x.is_known;
  return *this;
}

duration energy_row::served() const {
  duration sum{};
  for (const auto& [provider, time] : use.served)
    sum += time;
  return sum;
}

energy_balance energy_row::balance() const {
  return {.spent = spent,
          .home_nj = home_nj,
          .home_s = home_s,
          .own_s = to_seconds(use.computing) + resting_share * resting_s,
          .is_known = station.has_value()};
}

energy_table energy_of(const split_ledger& done, const energy_terms& terms,
                       const load_table& load, duration length) {
  const pricing prices{terms, done};
  energy_table all;
  std::optional<station_id> latest;
  for (const auto& [who, splits] : done.uses())
    for (const auto& [where, use] : splits) {
      const auto rows = prices.rows_of(who, where, use);
      if (rows.empty())
        continue;
      auto& sum = all.splits[{who.chain, where}];
      sum.driven += use.driven;
      sum.distance_m += use.distance_m;
      for (const auto& row : rows) {
        sum += row.balance();
        all.rows.push_back(row);
      }
      all.vehicles += latest != who.station;
      latest = who.station;
    }
  add_left(all, prices, terms, load, length);
  for (const auto& row : all.rows)
    all.all += row.balance();
  return all;
}

} // namespace sofof::recording

// Vehicles at a crossing that tell each other what they claim, over an air that
// loses and delays, while somebody proposes drives.
#pragma once

#include "planners/crossing/claim_book.hpp"
#include "tests/support/dice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <vector>

namespace sofof::test {

/// A body that stands on one of some places, far from each other.
inline planners::claimed_drive stay_on(int place, time_point from,
                                       time_point to) {
  constexpr duration step = std::chrono::milliseconds{100};
  planners::claimed_drive drive{from, step, {}};
  for (auto t = from; t <= to; t += step)
    drive.bodies.push_back({{100.0 * place, 0}, 0, 5, 2});
  return drive;
}

struct air_quality {
  double loss = 0;        ///< Share of messages; in bursts, of time.
  double burst_s = 0;     ///< Mean length of a time without any; 0: by chance.
  double longest_ms = 40; ///< Under way, uniformly from 1 ms on.
  double clock_error_ms = 5;
};

/// Each vehicle tells all others every 100 ms, at a phase of its own.
class crossing_air {
public:
  static constexpr duration step = std::chrono::milliseconds{10};
  static constexpr duration apart = std::chrono::milliseconds{500};

  crossing_air(std::size_t vehicles, air_quality air, std::uint64_t seed)
      : air_{air}, dice_{seed} {
    const planners::claim_book::rules rules{
        .clock_error =
            from_seconds(air.clock_error_ms / 1000) + duration{1000}};
    for (std::size_t i = 0; i < vehicles; ++i) {
      books_.emplace_back(station_id{static_cast<std::uint32_t>(101 + i)},
                          rules);
      clocks_.push_back(from_seconds(
          dice_.between(-air.clock_error_ms, air.clock_error_ms) / 1000));
      phases_.push_back(static_cast<int>(dice_.between(0, 10)));
    }
    silent_until_.resize(vehicles * vehicles);
    clear_until_.resize(vehicles * vehicles);
  }

  std::size_t size() const { return books_.size(); }
  planners::claim_book& book(std::size_t i) { return books_[i]; }
  time_point now() const { return now_; }
  time_point clock(std::size_t i) const { return now_ + clocks_[i]; }
  bool is_lost() { return dice_.between(0, 1) < air_.loss; }
  dice& random() { return dice_; }

  std::vector<station_id> all() const {
    std::vector<station_id> stations;
    for (std::size_t i = 0; i < size(); ++i)
      stations.emplace_back(static_cast<std::uint32_t>(101 + i));
    return stations;
  }

  /// Lets 10 ms pass.
  void go_on() {
    now_ += step;
    ++steps_;
    for (std::size_t i = 0; i < size(); ++i) {
      books_[i].pass_time(clock(i));
      if (steps_ % 10 == phases_[i])
        send(i, books_[i].tell(clock(i)));
    }
    std::erase_if(under_way_, [&](const letter& x) {
      if (x.arrives > now_)
        return false;
      books_[x.to].on_report(clock(x.to), x.what, true);
      return true;
    });
  }

  /// @returns whether two vehicles rely on claims that overlap.
  bool has_overlap() const {
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (books_[i].is() == planners::claim_book::state::bound
            && books_[k].is() == planners::claim_book::state::bound
            && planners::overlap(*books_[i].own(), *books_[k].own(), apart))
          return true;
    return false;
  }

private:
  struct letter {
    std::size_t to;
    time_point arrives;
    planners::crossing_claim what;
  };

  void send(std::size_t from, const planners::crossing_claim& what) {
    for (std::size_t to = 0; to < size(); ++to)
      if (to != from && !loses(from, to))
        under_way_.push_back(
            {to, now_ + from_seconds(dice_.between(1, air_.longest_ms) / 1000),
             what});
  }

  /// In bursts, times with and without messages are exponential.
  bool loses(std::size_t from, std::size_t to) {
    if (air_.burst_s <= 0 || air_.loss <= 0)
      return is_lost();
    const auto lasts = [&](double mean_s) {
      return from_seconds(-mean_s * std::log(dice_.between(1e-9, 1)));
    };
    auto& silent = silent_until_[from * size() + to];
    auto& clear = clear_until_[from * size() + to];
    while (clear <= now_) {
      silent = clear
               + (clear == time_point{} && !is_lost() ? duration{}
                                                      : lasts(air_.burst_s));
      clear = silent + lasts(air_.burst_s * (1 - air_.loss) / air_.loss);
    }
    return now_ < silent;
  }

  air_quality air_;
  dice dice_;
  time_point now_;
  int steps_ = 0;
  std::vector<planners::claim_book> books_;
  std::vector<duration> clocks_;
  std::vector<int> phases_;
  std::vector<time_point> silent_until_, clear_until_; // of each to each
  std::vector<letter> under_way_;
};

} // namespace sofof::test

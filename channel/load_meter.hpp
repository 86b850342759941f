// How much servers were asked for over time, and how long jobs waited. What is
// remembered of a long run grows coarser, not longer.
#pragma once

#include "base/statistics.hpp"
#include "base/time.hpp"
#include "channel/time_rows.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::channel {

/// What was asked of some equal servers.
struct load_figures {
  /// A part of the time.
  struct bin {
    std::uint64_t jobs = 0;  ///< That arrived in it.
    duration asked{};        ///< Servers' time that these need.
    duration waited{};       ///< By these, until a server took them.
    duration longest_wait{}; ///< Of one of these.
    duration busy{};         ///< Servers' time that was used in this bin.

    bin& operator+=(const bin& other);
  };
  static constexpr duration width = std::chrono::milliseconds{100};
  /// Loads are told as the most in such a time, and as full above this share.
  static constexpr duration peak_length = std::chrono::milliseconds{500};
  static constexpr double full_share = 0.9;
  /// What was used for one thing, bin by bin after what is longer ago.
  struct use {
    duration before{};
    std::vector<duration> bins;
  };

  unsigned servers = 1;
  time_rows<bin> rows;   ///< What is longer ago than a minute.
  duration bins_from{};  ///< Here these end, and `bins` begin, since the start.
  std::vector<bin> bins; ///< As far as there was work.
  duration most_asked{}; ///< In any `peak_length` that begins before these.
  duration full{};       ///< How long of that time servers were full.
  /// Servers' time that was used, by what for.
  std::map<std::string, use, std::less<>> busy_by;
  distribution waits; ///< Of all jobs.

  /// @returns the sum of the bins that begin in [from, to), since the start; of
  /// those in `rows`, all of a row count where it begins.
  bin between(duration from, duration to) const;

  /// @returns whether servers were full, if that was asked of them in half a
  /// second.
  bool is_full(duration asked) const;

  /// @returns servers' time that was used for that, in the bins that begin
  /// before `to`, since the start; not before `bins_from`.
  duration busy_for(std::string_view what, duration to) const;
};

/// Adds up the jobs of some equal servers: workers, or the airtime of a radio
/// cell. Safe to share between threads.
class load_meter {
public:
  /// @param servers  At least 1.
  /// @param start    Bin 0 begins then.
  load_meter(unsigned servers, time_point start);

  /// A job arrives; one from before the start counts from there.
  /// @param wait  Until a server takes it, >= 0.
  /// @param work  What it takes there, >= 0.
  /// @param what  What it is for: a service; empty if nobody asks.
  void add(time_point arrives, duration wait, duration work,
           std::string_view what = {});

  load_figures read() const;

private:
  std::size_t number_of(time_point t) const;
  load_figures::bin& at(time_point t);
  void use(time_point from, time_point until, std::string_view what);
  void put_into_rows(time_point now);
  void note_peaks();

  time_point start_;
  mutable std::mutex mutex_;
  load_figures all_;
};

} // namespace sofof::channel

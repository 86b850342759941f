// Tries seed after seed, on several cores, and keeps what it finds.
#include "experiments/torture/torture.hpp"

#include "base/files/output_file.hpp"
#include "base/input_error.hpp"
#include "base/stopwatch.hpp"
#include "experiments/sweep/work_folder.hpp"
#include "experiments/torture/draw.hpp"
#include "experiments/torture/seed_log.hpp"
#include "experiments/torture/seed_table.hpp"
#include "experiments/torture/shrink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <list>
#include <ostream>
#include <poll.h>
#include <vector>

namespace sofof::experiments::torture {

namespace fs = std::filesystem;

namespace {

constexpr auto findings_name = "findings", unfinished_name = ".unfinished",
               shrunk_name = "shrunk.toml";
constexpr int look_period_ms = 200;

std::string log_name(const std::optional<shard>& part) {
  return part ? fmt::format("seeds-{}-of-{}.csv", part->number, part->of)
              : "seeds.csv";
}

fs::path made(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed)
    refuse_to_write(fmt::format("the folder {} cannot be made: {}; choose {}",
                                folder.string(), failed.message(),
                                output_file::other_folder),
                    failed.value());
  return folder;
}

bool breaks(const verdict& v, const std::string& promise) {
  return std::ranges::find(v.broken, promise, &broken_promise::promise)
         != v.broken.end();
}

bool loads(const std::string& text) {
  try {
    load({text});
    return true;
  } catch (const input_error&) {
    return false;
  }
}

std::string sentences_of(const verdict& v) {
  std::string all;
  for (const auto& [promise, what] : v.broken)
    all += fmt::format("{}: {}\n", promise, what);
  return all;
}

class torturer {
public:
  torturer(const torture_options& how, const std::atomic<bool>& interrupted,
           std::ostream& console)
      : how_{how}, interrupted_{interrupted}, console_{console},
        log_{made(how.out), log_name(how.part), how.program},
        work_{made(how.out / unfinished_name)}, shown_{console, how.show},
        next_{how.first}, seconds_{seconds_so_far()} {}

  torture_outcome work() {
    finish_shrinking();
    while (!interrupted_) {
      while (trials_.size() < how_.jobs && start_next())
        ;
      if (trials_.empty())
        break;
      listen();
      shown_.show([&] { return line(); }, watch_.elapsed_s());
    }
    shown_.clear();
    done_.interrupted = interrupted_;
    trials_.clear();
    done_.findings = findings_so_far();
    console_ << table_of(log_, how_.out / findings_name);
    return done_;
  }

private:
  struct running {
    running(std::uint64_t seed, const fs::path& folder)
        : seed{seed}, run{{draw(seed)}, folder} {}

    std::uint64_t seed;
    trial run;
  };

  /// Of this shard alone: each has to make its part.
  double seconds_so_far() const {
    double sum = 0;
    for (const auto& [seed, one] : log_.seeds())
      if (is_ours(seed))
        sum += one.counts[counted::driven_s];
    return sum;
  }

  /// Of one seed that is tried again, that one alone.
  std::size_t findings_so_far() const {
    std::size_t count = 0;
    for (const auto& [seed, one] : log_.seeds())
      count += !one.broken.empty()
               && (!how_.again || (how_.first <= seed && seed <= how_.last));
    return count;
  }

  bool is_ours(std::uint64_t seed) const {
    return (!how_.part || seed % how_.part->of == how_.part->number - 1)
           && (how_.with.empty()
               || draw(seed).find(how_.with) != std::string::npos);
  }

  bool has_enough() const {
    const auto parts = how_.part ? static_cast<double>(how_.part->of) : 1;
    return how_.hours && seconds_ >= *how_.hours * hour_s / parts;
  }

  /// @returns whether there was one.
  bool start_next() {
    if (has_enough())
      return false;
    while (next_ <= how_.last
           && (!is_ours(next_) || (!how_.again && log_.knows(next_))))
      ++next_;
    if (next_ > how_.last)
      return false;
    trials_.emplace_back(next_, place_of(next_));
    ++next_;
    return true;
  }

  fs::path place_of(std::uint64_t seed) const {
    return work_.path() / fmt::format("{}", seed);
  }

  void listen() {
    std::vector<pollfd> pipes;
    for (const auto& t : trials_)
      pipes.push_back({t.run.pipe(), POLLIN, 0});
    if (poll(pipes.data(), pipes.size(), look_period_ms) <= 0)
      return;
    auto t = trials_.begin();
    for (const auto& p : pipes) {
      const auto found = p.revents != 0 ? t->run.poll_verdict() : std::nullopt;
      const auto seed = t->seed;
      t = found ? trials_.erase(t) : std::next(t);
      if (found)
        keep(seed, *found);
    }
  }

  void keep(std::uint64_t seed, const verdict& v) {
    log_.add(seed, v);
    seconds_ += v.counts[counted::driven_s];
    ++done_.tried;
    if (!v.is_good())
      keep_finding(seed, v);
  }

  void keep_finding(std::uint64_t seed, const verdict& v) {
    const auto folder = made(place_of_finding(seed));
    const auto drawn = draw(seed);
    write_file(folder / "drawn.toml", drawn);
    write_file(folder / "broken.txt", sentences_of(v));
    shown_.clear();
    console_ << fmt::format("seed {} breaks {}: {}\n  repeat it: sofof torture "
                            "--seed {} --out {}\n",
                            seed, v.broken.front().promise,
                            v.broken.front().what, seed, how_.out.string())
             << std::flush;
    make_small(drawn, v.broken.front().promise, folder);
  }

  // Of findings whose shrinking was interrupted.
  void finish_shrinking() {
    for (const auto& [seed, one] : log_.seeds()) {
      const auto folder = place_of_finding(seed);
      if (interrupted_ || one.broken.empty() || !is_ours(seed)
          || !fs::exists(folder / "drawn.toml")
          || fs::exists(folder / shrunk_name))
        continue;
      console_ << fmt::format("seed {} breaks {}\n", seed, one.broken);
      make_small(draw(seed), one.broken.substr(0, one.broken.find(' ')),
                 folder);
    }
  }

  void make_small(const std::string& drawn, const std::string& promise,
                  const fs::path& folder) {
    const auto small = smaller(drawn, promise);
    if (interrupted_)
      return;
    const auto file = folder / shrunk_name;
    try_apart({small.text}, work_.path() / "shrink", folder / "run");
    write_file(file, small.text);
    console_ << fmt::format(
        "  in short:  sofof torture {}, {} lines, after {} tries{}\n"
        "  its results: {}\n",
        file.string(), std::ranges::count(small.text, '\n'), small.tries,
        small.tries < how_.most_tries ? "" : ", no more of which were made",
        (folder / "run").string())
             << std::flush;
  }

  fs::path place_of_finding(std::uint64_t seed) const {
    return how_.out / findings_name / fmt::format("{}", seed);
  }

  shrunk smaller(const std::string& drawn, const std::string& promise) const {
    return shrink(
        drawn,
        [&](const std::string& text) {
          return !interrupted_ && loads(text)
                 && breaks(try_apart({text}, work_.path() / "shrink"), promise);
        },
        how_.most_tries);
  }

  std::string line() const {
    return fmt::format("seed {}  {:.1f} vehicle hours  {} findings", next_ - 1,
                       seconds_ / hour_s, findings_so_far());
  }

  const torture_options& how_;
  const std::atomic<bool>& interrupted_;
  std::ostream& console_;
  seed_log log_;
  work_folder work_;
  recording::progress shown_;
  stopwatch watch_;
  std::list<running> trials_;
  std::uint64_t next_;
  double seconds_; ///< Of vehicles.
  torture_outcome done_;
};

} // namespace

torture_outcome try_seeds(const torture_options& how,
                          const std::atomic<bool>& interrupted,
                          std::ostream& console) {
  return torturer{how, interrupted, console}.work();
}

torture_outcome try_scenario(const tried_scenario& what, const fs::path& out,
                             std::ostream& console) {
  load(what); // says what is wrong
  const work_folder work{made(made(out) / unfinished_name)};
  const auto found = try_apart(what, work.path() / "one", out / "run");
  console << (found.is_good() ? "no promise is broken\n" : sentences_of(found))
          << "its results: " << (out / "run").string() << '\n';
  return {1, found.is_good() ? 0u : 1u, false};
}

} // namespace sofof::experiments::torture

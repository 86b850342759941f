// Runs that a worker on another host carries out.
#include "scenario/sweep/far_site.hpp"

#include "actors/remote/far_bench.hpp"
#include "network/credentials.hpp"
#include "network/tls_dialer.hpp"
#include "policies/back_off.hpp"
#include "scenario/front.hpp"
#include "scenario/input_error.hpp"
#include "scenario/sweep/order_files.hpp"
#include "scenario/sweep/result_files.hpp"
#include "world/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

namespace sofof {

namespace {

/// More than any worker has; what it says is a stranger's word.
constexpr std::uint32_t most_slots = 1024;

/// What all sites of a sweep share.
struct outside {
  std::optional<credentials> own;
  std::vector<std::unique_ptr<tls_dialer>> dialers; // outlive what uses them
  std::unique_ptr<network_runtime> time;
  worker_introduction introduction;
};

class far_site final : public run_site {
public:
  /// @param dialer  Leads to the worker; null: it is on this machine.
  far_site(std::shared_ptr<outside> out, const network_address& at,
           tls_dialer* dialer)
      : out_{std::move(out)}, name_{"worker " + print_address(at)},
        port_{dialer ? dialer->port() : at.port}, dialer_{dialer},
        noise_{0, name_}, thread_{[this] { keep_in_touch(); }} {}

  ~far_site() override {
    {
      const std::lock_guard lock{mutex_};
      stops_ = true;
      changed_.notify_all();
    }
    if (dialer_)
      dialer_->hang_up(); // an attempt ends now
    thread_.join();
  }
  far_site(const far_site&) = delete;
  far_site& operator=(const far_site&) = delete;

  /// Returns when the worker has answered, or has not.
  /// @throws input_error when it refuses us.
  void await_answer() {
    std::unique_lock lock{mutex_};
    changed_.wait(lock, [this] { return attempts_ > 0; });
    if (is_given_up_)
      throw input_error{last_news_ + "."};
  }

  std::size_t slots() const override {
    const std::lock_guard lock{mutex_};
    return slots_;
  }

  std::vector<std::string> news() override {
    const std::lock_guard lock{mutex_};
    return std::exchange(news_, {});
  }

  void carry_out(const scenario& s, const std::filesystem::path& folder,
                 const std::atomic<bool>& interrupted) override {
    const auto [gate, visit] = where();
    try {
      far_bench bench{out_->time->system(), gate, out_->introduction};
      for (auto& piece : order_of(s))
        bench.add(std::move(piece));
      bench.begin();
      if (await_end(bench, interrupted))
        fetch(bench, folder, interrupted);
    } catch (const worker_lost& why) {
      lose(visit, why.what());
    } catch (const worker_refuses& why) {
      give_up(why.what());
    }
    const std::lock_guard lock{mutex_};
    pauses_.succeeded();
  }

private:
  // -- a run ----------------------------------------------------------------

  /// @returns the worker's gate, and which of our connections it belongs to.
  std::pair<gate_actor, std::uint64_t> where() const {
    const std::lock_guard lock{mutex_};
    if (slots_ == 0)
      throw site_lost{name_ + " has gone"};
    return {gate_, visit_};
  }

  /// @returns false when it was interrupted.
  static bool await_end(far_bench& bench,
                        const std::atomic<bool>& interrupted) {
    while (!interrupted) {
      const auto report = bench.look();
      if (!report.failure.empty())
        throw std::runtime_error{report.failure};
      if (report.ended)
        return true;
    }
    return false;
  }

  static void fetch(far_bench& bench, const std::filesystem::path& folder,
                    const std::atomic<bool>& interrupted) {
    result_files files{folder};
    while (!interrupted) {
      const auto piece = bench.next();
      const auto why = piece.file.empty() ? files.finish() : files.take(piece);
      if (why)
        throw worker_refuses{*why};
      if (piece.file.empty())
        return;
    }
  }

  /// @param visit  When it was lost; there may have been a new one since then.
  [[noreturn]] void lose(std::uint64_t visit, std::string_view why) {
    const std::lock_guard lock{mutex_};
    if (visit == visit_ && slots_ > 0) {
      slots_ = 0;
      gate_ = nullptr;
      if (dialer_)
        dialer_->hang_up(); // the next attempt begins anew
      changed_.notify_all();
    }
    last_news_ = fmt::format("{} is lost: {}", name_, why);
    throw site_lost{last_news_};
  }

  [[noreturn]] void give_up(std::string_view why) {
    const std::lock_guard lock{mutex_};
    slots_ = 0;
    gate_ = nullptr;
    is_given_up_ = true;
    last_news_ = fmt::format("{} is given up: {}", name_, why);
    throw site_lost{last_news_};
  }

  // -- the connection -------------------------------------------------------

  void keep_in_touch() {
    std::unique_lock lock{mutex_};
    while (!stops_) {
      if (slots_ > 0 || is_given_up_) {
        changed_.wait(lock);
        continue;
      }
      const auto pause = pauses_.next_wait(noise_.uniform(attempts_));
      if (changed_.wait_for(lock, pause, [this] { return stops_; }))
        return;
      lock.unlock();
      attempt();
      lock.lock();
      ++attempts_;
      changed_.notify_all();
    }
  }

  void attempt() {
    try {
      const auto gate = connect();
      const far_bench bench{out_->time->system(), gate, out_->introduction};
      const auto slots = std::clamp(bench.slots(), 1U, most_slots);
      const std::lock_guard lock{mutex_};
      gate_ = gate;
      slots_ = slots;
      ++visit_;
      tell(fmt::format("{} takes {} runs at a time", name_, slots));
    } catch (const worker_lost& why) {
      const std::lock_guard lock{mutex_};
      tell(fmt::format("no connection to {} yet: {}", name_, why.what()));
    } catch (const worker_refuses& why) {
      const std::lock_guard lock{mutex_};
      is_given_up_ = true;
      tell(fmt::format("{} refuses: {}", name_, why.what()));
    }
  }

  gate_actor connect() const {
    auto found = out_->time->connect(port_);
    if (auto* gate = std::get_if<gate_actor>(&found))
      return std::move(*gate);
    const auto why = dialer_ ? dialer_->last_error() : "";
    throw worker_lost{why.empty() ? std::get<std::string>(found) : why};
  }

  void tell(const std::string& line) {
    if (line != last_news_)
      news_.push_back(line);
    last_news_ = line;
  }

  const std::shared_ptr<outside> out_;
  const std::string name_;
  const std::uint16_t port_; ///< On this machine.
  tls_dialer* const dialer_;
  const random_stream noise_; ///< For the pauses between attempts.

  mutable std::mutex mutex_; ///< Of all below.
  std::condition_variable changed_;
  std::uint32_t slots_ = 0; ///< 0 while there is no connection.
  gate_actor gate_;
  std::uint64_t visit_ = 0;
  bool is_given_up_ = false;
  bool stops_ = false;
  back_off pauses_;
  std::uint64_t attempts_ = 0;
  std::vector<std::string> news_;
  std::string last_news_;

  std::thread thread_; // last, as it needs all of the above
};

worker_introduction introduction_of(const far_site_options& what,
                                    const std::optional<credentials>& own) {
  const auto prove = [&own](worker_hello& hello, const std::string& nonce) {
    if (!own)
      return;
    hello.certificate = own->certificate_pem();
    hello.signature = own->sign(proof_of_orders(nonce));
  };
  return {what.protocol, what.program, prove};
}

} // namespace

std::vector<std::shared_ptr<run_site>>
connect_to_workers(const far_site_options& what) {
  const auto out = std::make_shared<outside>();
  for (const auto& at : what.workers)
    if (auto keys = load_keys(at, what.keys, "--workers"); keys && !out->own)
      out->own = std::move(keys);
  out->introduction = introduction_of(what, out->own);
  for (const auto& at : what.workers)
    if (out->own)
      out->dialers.push_back(std::make_unique<tls_dialer>(
          &*out->own, dialer_options{.remote = at, .provider = {}}));
  out->time = make_network_runtime(what.clock);
  std::vector<std::shared_ptr<far_site>> sites;
  for (std::size_t i = 0; i < what.workers.size(); ++i)
    sites.push_back(std::make_shared<far_site>(
        out, what.workers[i], out->own ? out->dialers[i].get() : nullptr));
  for (const auto& site : sites)
    site->await_answer();
  return {sites.begin(), sites.end()};
}

} // namespace sofof

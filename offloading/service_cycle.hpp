// When a service's function runs: its life cycle, its periods, its numbers.
#pragma once

#include "base/random.hpp"
#include "messages/protocol/lifecycle.hpp"
#include "offloading/coming_result.hpp"
#include "offloading/cycle_work.hpp"
#include "offloading/service.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace sofof::offloading {

/// What runs, and when.
struct cycle_setup {
  messages::session_id session;               ///< Stamped on every result.
  std::shared_ptr<service_function> function; ///< Not null.
  duration period{};                          ///< > 0.
  duration phase{}; ///< Cycles start at phase + k · period; in [0, period).
  /// @returns when the cycle that starts now will be done, not before `start`:
  /// a model of the computer in virtual time; what the clock says, where time
  /// is real and the cycle has been computed by then.
  std::function<cycle_work(time_point start, std::uint64_t cycle)> finish;
  /// If there is one, what `finish` says may become later, as where functions
  /// interrupt each other, and the function has one cycle at a time.
  /// @returns when the cycle under way is done, as far as is known now.
  std::function<time_point(time_point now)> review{};
  /// Whether the first cycle waits for its phase too, and is not run at once.
  bool keeps_phase = false;
  /// Whether a cycle is run for each input, and in no period without one.
  bool per_input = false;
  /// In virtual time: who computes cycles until they are done; their results do
  /// not depend on its helpers. Null: cycles are computed when they start.
  std::shared_ptr<job_pool> pool{};
};

/// @returns the cycle of a vehicle's own function, with a phase that is drawn;
/// `finish` is left to be filled in.
/// @param noise  Of the vehicle.
cycle_setup own_cycle(const onboard_service& service, station_id vehicle,
                      const random_stream& noise);

/// What a cycle makes others do. Nothing of this calls the cycle back.
class cycle_port {
public:
  virtual ~cycle_port() = default;

  /// `on_timer` is due then, with this number.
  virtual void wake_at(time_point t, std::uint64_t number) = 0;
  /// The result of a cycle, which is done then.
  virtual void deliver_at(time_point t, messages::service_result result) = 0;
  /// The same, of a cycle that a pool computes; by default it is waited for.
  virtual void deliver_at(time_point t, coming_result result);
};

/// Runs one function period by period, in a life cycle as ROS 2 nodes have it.
/// * It begins unconfigured. Active, it runs a cycle at once and then on its
///   grid (or on its grid only), always from the newest input; without any
///   input it waits.
/// * While it stands by, or if each input has one result, it runs one cycle for
///   each input, at once, but at most one more than the grid has by then. For
///   an input that says `at_once` it may be three ahead, and is run besides the
///   grid, too; then the grid waits until it has caught up with it.
/// * A cycle that takes longer than a period does not delay the next one in
///   virtual time (`finish` says when each is done, a wait for a worker
///   included); where time is real, it does, and what the grid had meanwhile
///   is left out. Inputs are never queued.
/// * Where what `finish` says may become later (`review`), a function has one
///   cycle at a time: the next one begins when that is done, from the newest
///   input then.
/// * Cycles are numbered by the grid, so that their noise does not depend on
///   when the service was started; after two in one period they are one ahead.
///
/// No clock and no I/O: every call says what time it is, never less than
/// before.
class service_cycle {
public:
  /// @param port  Outlives the cycle.
  service_cycle(cycle_setup setup, cycle_port& port);
  ~service_cycle();
  service_cycle(const service_cycle&) = delete;
  service_cycle& operator=(const service_cycle&) = delete;

  /// The life cycle takes this step; one that is not possible is ignored.
  void on_step(messages::lifecycle_step step, time_point now);

  /// The next cycles start from this, unless they have a newer one; a function
  /// that does not run observes it.
  void on_input(const messages::service_input& input, time_point now);

  /// The time that `wake_at` was given with this number has come.
  void on_timer(std::uint64_t number, time_point now);

  messages::lifecycle_state state() const { return state_; }

private:
  /// The timer of the cycle under way; those of the next one begin with 1.
  static constexpr std::uint64_t completion = 0;

  bool is_consistent() const;
  bool waits_for_input() const;
  void begin(time_point now);
  void stop_timer();
  void await_next(time_point now);
  void run(time_point now, bool is_besides = false);
  void compute(begun_cycle cycle, coming_result& result);
  void end_last() const;
  void look_after(time_point now);

  std::uint64_t grid_number(time_point t) const;

  cycle_setup setup_;
  cycle_port& port_;
  messages::lifecycle_state state_ = messages::lifecycle_state::unconfigured;
  messages::service_input newest_;
  std::uint64_t timer_ = 0; // the one that counts
  bool has_timer_ = false;
  std::uint64_t after_any_ = 0;            // number after the latest cycle,
  std::uint64_t after_off_grid_ = 0;       // and after the latest off the grid
  std::shared_ptr<coming_output> last_;    // if a pool computes
  std::optional<coming_result> under_way_; // if there is a `review`
  time_point begun_;                       // when that was
  bool is_due_ = false;                    // the next cycle, once that is done
  bool is_due_besides_ = false;            // besides the grid
};

} // namespace sofof::offloading

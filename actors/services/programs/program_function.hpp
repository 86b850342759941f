// A function that another program computes.
#pragma once

#include "actors/offloading/measured_times.hpp"
#include "actors/services/programs/program_octets.hpp"
#include "base/process/kept_program.hpp"
#include "messages/protocol/record.hpp"
#include "offloading/service_function.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace sofof::actors {

/// Of which session, and whom it tells that the program has died or is back.
struct program_session {
  messages::event_record about; ///< What each of its events says.
  std::function<void(messages::event_record)> report;
  std::function<void()> besides{}; ///< Called with each input; may be empty.
  std::size_t most_input_octets = 0;
  /// Computing times of cycles, in turn; empty: none was measured.
  std::shared_ptr<const std::vector<duration>> run_times{};
  bool is_virtual = false; ///< The time of the run.
  /// On the wall clock: nobody has a use for results of older inputs, so the
  /// program is not given them.
  duration oldest_input = duration::max();
};

/// One process for each function, with the life cycle of the function. Where
/// the program is not there, cycles give nothing.
class program_function final : public offloading::service_function,
                               public measured_times {
public:
  program_function(kept_setup what, program_session whose);

  offloading::service_output run(time_point now,
                                 const messages::service_input& input) override;

  /// While it rests, too, a death is found and a new process started; in
  /// virtual time only when it has to compute, or chance would decide when.
  void observe(time_point now, const messages::service_input& input) override;

  void on_step(messages::lifecycle_step step, time_point now) override;

  bool blocks() const override { return true; }

  std::optional<duration> measured(std::uint64_t cycle) const override;

private:
  void report(program_news news);

  program_session whose_;
  time_point now_; // of the latest call
  kept_program program_;
};

} // namespace sofof::actors

// A worker's end of a connection: one run for somebody on another host.
#pragma once

#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace sofof {

/// A run that somebody else wants. Its workbench alone calls these, one after
/// the other; what they throw is told to who ordered it.
class ordered_run {
public:
  /// Nobody waits for it any more: it ends soon, and nothing is left of it.
  virtual ~ordered_run() = default;

  /// Takes part of a file of the order, before it begins.
  /// @returns why not, in a sentence without its full stop.
  virtual std::optional<std::string> add(const file_piece& piece) = 0;

  /// @param on_end  Called once, from any thread.
  virtual void begin(std::function<void()> on_end) = 0;

  virtual run_report report() = 0;

  /// @returns the next part of the results, `longest_piece` at most; an empty
  /// one when there is no more.
  virtual file_piece next() = 0;
};

/// What workbenches are made of. The functions are called from their threads.
struct workbench_setup {
  std::string program;     ///< Whoever orders must be the same.
  std::uint32_t slots = 1; ///< Runs that are carried out at a time.
  std::function<std::unique_ptr<ordered_run>()> make_run;
  /// @returns a number that nobody can guess, new every time.
  std::function<std::string()> draw_nonce;
  /// @returns why somebody must not order runs; nothing if he may.
  std::function<std::optional<std::string>(const worker_hello&,
                                           const std::string& nonce)>
      doubt;
  /// Told who was refused, and why.
  std::function<void(const std::string&)> on_refusal;
};

/// Waits for an introduction, then carries out one run for whoever it came
/// from. Ends with the gate, when its peer does, when it has been silent for
/// protocol::silence_limit, and when it does not introduce itself in time.
workbench_actor spawn_workbench(caf::actor_system& sys, const gate_actor& gate,
                                std::shared_ptr<const workbench_setup> setup,
                                std::string nonce);

} // namespace sofof

// The asking side of a workbench on another host.
#pragma once

#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>
#include <caf/scoped_actor.hpp>

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace sofof {

/// A worker has gone or is silent.
class worker_lost : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A worker does not want us, or cannot work. It will not do the next time.
class worker_refuses : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// How we introduce ourselves.
struct worker_introduction {
  std::uint32_t protocol = remote_protocol;
  std::string program;
  /// Adds the proof that we may order runs, where one is needed.
  std::function<void(worker_hello&, const std::string& nonce)> prove;
};

/// One run, step by step, on the thread that asks. Whoever waits for the run
/// asks `look` again and again: the worker takes silence for an end. Every
/// member throws `worker_lost` when no answer comes for
/// protocol::silence_limit, and `worker_refuses`, with sentences that go on
/// after a name and lack their full stop.
class far_bench {
public:
  /// Introduces us.
  far_bench(caf::actor_system& sys, const gate_actor& gate,
            const worker_introduction& who);

  /// @returns how many runs the worker carries out at a time.
  std::uint32_t slots() const { return slots_; }

  /// Sends part of a file of the order.
  void add(file_piece piece);

  /// Lets the run begin.
  void begin();

  /// @returns after a life sign's period, or as soon as the run has ended.
  run_report look();

  /// @returns the next part of the results, once it has; empty at the end.
  file_piece next();

private:
  /// @param limit  To wait for the answer.
  template <class Answer, class Actor, class... Ts>
  Answer ask(const Actor& whom, duration limit, Ts&&... xs);

  caf::scoped_actor self_;
  workbench_actor bench_;
  std::uint32_t slots_ = 0;
};

} // namespace sofof

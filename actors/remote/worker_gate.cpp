// Where others reach a worker.
#include "actors/remote/worker_gate.hpp"

#include "actors/remote/greeting.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <cstddef>
#include <exception>
#include <utility>

namespace sofof {

namespace {

/// Beyond those that runs are carried out at and wait at.
constexpr std::size_t spare_benches = 64;

struct worker_gate_state {
  static inline const char* name = "worker_gate";

  gate_actor::stateful_pointer<worker_gate_state> self;
  std::shared_ptr<const workbench_setup> setup;
  std::size_t benches = 0;

  /// @returns a number to sign, and where to do so; nothing if that cannot be.
  std::pair<std::string, caf::strong_actor_ptr> make_bench() {
    if (benches >= 2 * setup->slots + spare_benches)
      return {};
    try {
      auto nonce = setup->draw_nonce();
      const auto bench =
          spawn_workbench(self->system(), gate_actor{self}, setup, nonce);
      self->monitor(bench);
      ++benches;
      return {std::move(nonce), caf::actor_cast<caf::strong_actor_ptr>(bench)};
    } catch (const std::exception& problem) {
      setup->on_refusal(problem.what());
      return {};
    }
  }
};

gate_actor::behavior_type
worker_gate(gate_actor::stateful_pointer<worker_gate_state> self,
            workbench_setup setup) {
  self->state.self = self;
  self->state.setup = std::make_shared<const workbench_setup>(std::move(setup));
  self->set_down_handler(
      [self](const caf::down_msg&) { --self->state.benches; });
  self->set_default_handler(caf::drop); // from who is no peer of ours
  return {
      [self](std::uint32_t protocol, std::uint64_t types) {
        return greet(protocol, types,
                     [self] { return self->state.make_bench(); });
      },
  };
}

} // namespace

gate_actor spawn_worker_gate(caf::actor_system& sys, workbench_setup setup) {
  return sys.spawn(worker_gate, std::move(setup));
}

} // namespace sofof

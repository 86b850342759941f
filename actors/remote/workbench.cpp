// A worker's end of a connection: one run for somebody on another host.
#include "actors/remote/workbench.hpp"

#include "actors/remote/origin.hpp"
#include "actors/remote/printable.hpp"
#include "actors/time.hpp"
#include "world/protocol.hpp"

#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <caf/typed_response_promise.hpp>
#include <fmt/format.h>

#include <exception>
#include <utility>

namespace sofof {

namespace {

using workbench_impl = workbench_actor::extend<takes<tick_atom>,
                                               // The run has ended.
                                               takes<tick_atom, look_atom>>;

struct workbench_state {
  static inline const char* name = "workbench";

  workbench_impl::stateful_pointer<workbench_state> self;
  gate_actor gate;
  std::shared_ptr<const workbench_setup> setup;
  std::string nonce;
  // -- once somebody has introduced himself
  caf::strong_actor_ptr peer;
  std::unique_ptr<ordered_run> run;
  bool has_begun = false;
  caf::typed_response_promise<run_report> question; // that waits for an answer
  time_point heard;

  // A gate lives long, and does not forget by itself who watched it.
  ~workbench_state() {
    if (gate)
      self->demonitor(gate);
  }

  void start() {
    // It dies with the gate, but the gate not with it.
    self->monitor(gate);
    heard = now(self);
    tick();
  }

  void tick() {
    const auto limit =
        peer ? protocol::silence_limit : protocol::introduction_timeout;
    if (now(self) - heard > limit)
      return self->quit();
    answer();
    send_after(self, self, protocol::life_sign_period, tick_atom_v);
  }

  void lost(const caf::actor_addr& who) {
    if (who == gate.address() || (peer && who == peer->address()))
      self->quit();
  }

  // -- introduction ---------------------------------------------------------

  // Whoever knows our number can speak to us, and ends nothing by that.
  caf::result<std::uint32_t> take(const worker_hello& hello) {
    if (peer)
      return out_of_turn();
    if (const auto why = objection(hello)) {
      setup->on_refusal(*why);
      return refusal(caf::sec::invalid_argument, *why);
    }
    peer = self->current_sender();
    heard = now(self);
    self->monitor(peer);
    return careful<std::uint32_t>([this] {
      run = setup->make_run();
      return setup->slots;
    });
  }

  std::optional<std::string> objection(const worker_hello& hello) const {
    if (!self->current_sender())
      return "it has no end of its own";
    if (hello.program != setup->program)
      return fmt::format("the worker is sofof {}, who asks is sofof {}; start "
                         "the same build on both sides",
                         setup->program, printable(hello.program));
    return setup->doubt(hello, nonce);
  }

  // -- orders ---------------------------------------------------------------

  /// A run can fail for reasons of this host's; the disk is full, say.
  template <class Answer, class Act>
  caf::result<Answer> careful(Act act) {
    try {
      return act();
    } catch (const std::exception& problem) {
      self->quit();
      return refusal(caf::sec::runtime_error, problem.what());
    }
  }

  static caf::error refusal(caf::sec code, std::string why) {
    return caf::make_error(code, std::move(why));
  }
  static caf::error out_of_turn() {
    return refusal(caf::sec::invalid_argument, "nobody waits for this now");
  }

  bool may_speak() {
    const auto may = run && self->current_sender() == peer;
    if (may)
      heard = now(self);
    return may;
  }

  caf::result<void> add(const file_piece& piece) {
    if (!may_speak() || has_begun)
      return out_of_turn();
    return careful<void>([&]() -> caf::result<void> {
      if (const auto why = run->add(piece))
        return refusal(caf::sec::invalid_argument, *why);
      return caf::unit;
    });
  }

  caf::result<void> begin() {
    if (!may_speak() || has_begun)
      return out_of_turn();
    has_begun = true;
    return careful<void>([this]() -> caf::result<void> {
      run->begin([me = workbench_impl{self}] {
        // In its own name, for nobody from elsewhere is believed.
        caf::send_as(me, me, tick_atom_v, look_atom_v);
      });
      return caf::unit;
    });
  }

  caf::result<run_report> look() {
    if (!may_speak() || !has_begun)
      return out_of_turn();
    answer();
    question = self->make_response_promise<run_report>();
    if (run->report().ended)
      answer();
    return question;
  }

  void answer() {
    if (question.pending())
      question.deliver(run->report());
  }

  caf::result<file_piece> next() {
    if (!may_speak() || !run->report().ended)
      return out_of_turn();
    return careful<file_piece>([this] { return run->next(); });
  }
};

workbench_impl::behavior_type
workbench(workbench_impl::stateful_pointer<workbench_state> self,
          gate_actor gate, std::shared_ptr<const workbench_setup> setup,
          std::string nonce) {
  self->state.self = self;
  self->state.gate = std::move(gate);
  self->state.setup = std::move(setup);
  self->state.nonce = std::move(nonce);
  self->state.start();
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.lost(down.source); });
  self->set_default_handler(caf::drop); // from who is no peer of ours
  return {
      [self](const worker_hello& hello) { return self->state.take(hello); },
      [self](const file_piece& piece) { return self->state.add(piece); },
      [self](begin_atom) { return self->state.begin(); },
      [self](look_atom) { return self->state.look(); },
      [self](next_atom) { return self->state.next(); },
      [self](tick_atom) {
        if (is_from_here(self))
          self->state.tick();
      },
      [self](tick_atom, look_atom) {
        if (is_from_here(self))
          self->state.answer();
      },
  };
}

} // namespace

workbench_actor spawn_workbench(caf::actor_system& sys, const gate_actor& gate,
                                std::shared_ptr<const workbench_setup> setup,
                                std::string nonce) {
  return sys.spawn(workbench, gate, std::move(setup), std::move(nonce));
}

} // namespace sofof

// Tests of a worker's gate and its workbenches: who is worked for, and until
// when.
#include "actors/remote/workbench.hpp"

#include "actors/remote/type_block.hpp"
#include "actors/remote/worker_gate.hpp"
#include "tests/support/virtual_world.hpp"
#include "world/protocol.hpp"

#include <caf/event_based_actor.hpp>
#include <doctest/doctest.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::test;

namespace {

/// What has become of a run.
struct run_log {
  std::vector<std::string> files;
  std::function<void()> on_end; ///< Once it has begun.
  run_report report;
  bool disk_is_full = false;
  bool is_gone = false;
};

class scripted_run : public ordered_run {
public:
  explicit scripted_run(std::shared_ptr<run_log> log) : log_{std::move(log)} {}
  ~scripted_run() override { log_->is_gone = true; }

  std::optional<std::string> add(const file_piece& piece) override {
    if (log_->disk_is_full)
      throw std::runtime_error{"the disk is full"};
    if (piece.file == "../passwd")
      return "no order has a file of that name";
    log_->files.push_back(piece.file);
    return std::nullopt;
  }
  void begin(std::function<void()> on_end) override {
    log_->on_end = std::move(on_end);
  }
  run_report report() override { return log_->report; }
  file_piece next() override { return {"summary.json", "{}"}; }

private:
  std::shared_ptr<run_log> log_;
};

struct bench_world : virtual_world {
  /// What an actor on another host was answered.
  template <class T>
  struct answer {
    std::optional<T> value;
    std::string error;
  };

  std::shared_ptr<run_log> run = std::make_shared<run_log>();
  int runs = 0;
  std::vector<std::string> refusals;
  std::optional<std::string> doubt;
  const std::uint64_t types = fingerprint_of_types();
  gate_actor gate = own(spawn_worker_gate(system(), setup()));
  caf::actor peer = someone();

  workbench_setup setup() {
    workbench_setup s;
    s.program = "1 abc";
    s.slots = 3;
    s.make_run = [this] {
      ++runs;
      return std::make_unique<scripted_run>(run);
    };
    s.draw_nonce = [] { return std::string{"number"}; };
    s.doubt = [this](const worker_hello&, const std::string& nonce) {
      CHECK(nonce == "number");
      return doubt;
    };
    s.on_refusal = [this](const std::string& why) { refusals.push_back(why); };
    return s;
  }

  /// Asks what it is told to ask.
  caf::actor someone() {
    return own(system().spawn([](caf::event_based_actor*) -> caf::behavior {
      return {[](tick_atom) {}};
    }));
  }

  workbench_actor knock(std::uint32_t protocol, std::uint64_t their_types) {
    auto found = std::make_shared<caf::strong_actor_ptr>();
    system().spawn([=, this](caf::event_based_actor* self) {
      self->request(gate, caf::infinite, protocol, their_types)
          .then([found](std::uint32_t p, std::uint64_t, const std::string&,
                        const caf::strong_actor_ptr& in) {
            CHECK(p == remote_protocol);
            *found = in;
          });
    });
    settle();
    return caf::actor_cast<workbench_actor>(*found);
  }
  workbench_actor knock() { return knock(remote_protocol, types); }

  /// Asks a bench in the name of `who`.
  template <class T, class... Ts>
  std::shared_ptr<answer<T>> ask(const caf::actor& who,
                                 const workbench_actor& bench, Ts... xs) {
    auto found = std::make_shared<answer<T>>();
    auto* self = caf::actor_cast<caf::event_based_actor*>(who);
    auto waiting = self->request(bench, caf::infinite, xs...);
    const auto fail = [found](const caf::error& error) {
      found->error = error.context().match_elements<std::string>()
                         ? error.context().get_as<std::string>(0)
                         : to_string(error);
    };
    if constexpr (std::is_same_v<T, bool>) // void
      waiting.then([found] { found->value = true; }, fail);
    else
      waiting.then([found](const T& x) { found->value = x; }, fail);
    settle();
    return found;
  }
  std::shared_ptr<answer<std::uint32_t>> enter(const workbench_actor& bench) {
    return ask<std::uint32_t>(peer, bench, worker_hello{"1 abc", {}, {}});
  }

  /// A bench where a run has begun.
  workbench_actor at_work() {
    auto bench = knock();
    enter(bench);
    CHECK(ask<bool>(peer, bench, file_piece{"config.toml", "x"})->value);
    CHECK(ask<bool>(peer, bench, begin_atom_v)->value);
    REQUIRE(run->on_end);
    return bench;
  }
};

} // namespace

TEST_CASE_FIXTURE(bench_world, "who speaks another version gets no workbench") {
  CHECK(!knock(remote_protocol + 1, types));
  CHECK(!knock(remote_protocol, types + 1));
  CHECK(knock());
}

TEST_CASE_FIXTURE(bench_world, "who is the same program is told how many runs "
                               "the worker takes") {
  CHECK(enter(knock())->value == 3);
  CHECK(runs == 1);
  CHECK(refusals.empty());
}

TEST_CASE_FIXTURE(bench_world, "another program is refused with one sentence "
                               "that names both") {
  const auto bench = knock();
  const auto in =
      ask<std::uint32_t>(peer, bench, worker_hello{"1 \x1b[31mdef", {}, {}});
  CHECK(in->error
        == "the worker is sofof 1 abc, who asks is sofof 1 ?[31mdef; start "
           "the same build on both sides");
  CHECK(refusals == std::vector<std::string>{in->error});
  CHECK(runs == 0);
}

TEST_CASE_FIXTURE(bench_world, "who cannot prove who he is gets no run") {
  doubt = "the certificate has expired";
  CHECK(enter(knock())->error == *doubt);
  CHECK(runs == 0);
}

TEST_CASE_FIXTURE(bench_world, "nobody but who introduced himself is heard") {
  const auto bench = knock();
  const file_piece piece{"config.toml", "x"};
  CHECK(!ask<bool>(peer, bench, piece)->value);
  enter(bench);
  const auto stranger = someone();
  CHECK(!ask<bool>(stranger, bench, piece)->value);
  CHECK(!ask<bool>(stranger, bench, begin_atom_v)->value);
  CHECK(!ask<std::uint32_t>(stranger, bench, worker_hello{"2", {}, {}})->value);
  CHECK(run->files.empty());
  CHECK(!run->on_end);
  CHECK(ask<bool>(peer, bench, piece)->value);
  CHECK(run->files.size() == 1);
}

TEST_CASE_FIXTURE(bench_world, "a file that no order has is refused") {
  const auto bench = knock();
  enter(bench);
  CHECK(ask<bool>(peer, bench, file_piece{"../passwd", "x"})->error
        == "no order has a file of that name");
}

TEST_CASE_FIXTURE(bench_world, "a run begins once, and takes no files then") {
  const auto bench = at_work();
  CHECK(!ask<bool>(peer, bench, begin_atom_v)->value);
  CHECK(!ask<bool>(peer, bench, file_piece{"map.toml", "x"})->value);
}

TEST_CASE_FIXTURE(bench_world, "who asks for a run is answered with every sign "
                               "of life, and at once when it ends") {
  const auto bench = at_work();
  auto report = ask<run_report>(peer, bench, look_atom_v);
  CHECK(!report->value);
  run_for(protocol::life_sign_period);
  REQUIRE(report->value);
  CHECK(!report->value->ended);
  report = ask<run_report>(peer, bench, look_atom_v);
  run->report = {true, "it must not be"};
  run->on_end();
  settle();
  REQUIRE(report->value);
  CHECK(report->value->failure == "it must not be");
  CHECK(ask<run_report>(peer, bench, look_atom_v)->value->ended);
}

TEST_CASE_FIXTURE(bench_world, "results are given when the run has ended") {
  const auto bench = at_work();
  CHECK(!ask<file_piece>(peer, bench, next_atom_v)->value);
  run->report.ended = true;
  REQUIRE(ask<file_piece>(peer, bench, next_atom_v)->value);
}

TEST_CASE_FIXTURE(bench_world, "a run ends when who ordered it is silent") {
  const auto bench = at_work();
  for (int k = 0; k < 30; ++k) {
    run_for(100ms);
    ask<run_report>(peer, bench, look_atom_v);
  }
  CHECK(!run->is_gone);
  run_for(protocol::silence_limit + protocol::life_sign_period);
  CHECK(run->is_gone);
  CHECK(is_gone(bench));
}

TEST_CASE_FIXTURE(bench_world, "a run ends when who ordered it dies") {
  at_work();
  kill(peer);
  CHECK(run->is_gone);
}

TEST_CASE_FIXTURE(bench_world, "a run ends with the worker's gate") {
  at_work();
  kill(gate);
  CHECK(run->is_gone);
}

TEST_CASE_FIXTURE(bench_world, "a worker whose disk is full says so, and the "
                               "run is over") {
  const auto bench = knock();
  enter(bench);
  run->disk_is_full = true;
  CHECK(ask<bool>(peer, bench, file_piece{"config.toml", "x"})->error
        == "the disk is full");
  CHECK(run->is_gone);
}

TEST_CASE_FIXTURE(bench_world, "who knocks and says nothing keeps others out "
                               "for two seconds at most") {
  const auto first = knock();
  while (knock())
    ;
  run_for(protocol::introduction_timeout + 2 * protocol::life_sign_period);
  CHECK(is_gone(first));
  CHECK(knock());
}

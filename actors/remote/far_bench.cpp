// The asking side of a workbench on another host.
#include "actors/remote/far_bench.hpp"

#include "actors/remote/printable.hpp"
#include "actors/remote/type_block.hpp"
#include "world/protocol.hpp"

#include <fmt/format.h>

#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

namespace sofof {

namespace {

/// No number to sign is longer; octets.
constexpr std::size_t longest_nonce = 1024;

/// @throws worker_lost, worker_refuses.
[[noreturn]] void explain(const caf::error& problem) {
  const auto& told = problem.context();
  if (told.match_elements<std::string>())
    throw worker_refuses{printable(told.get_as<std::string>(0))};
  if (problem == caf::sec::unexpected_message)
    throw worker_refuses{"it is no worker"};
  if (problem == caf::sec::request_timeout)
    throw worker_lost{"it does not answer"};
  throw worker_lost{"the connection is gone"};
}

} // namespace

template <class Answer, class Actor, class... Ts>
Answer far_bench::ask(const Actor& whom, duration limit, Ts&&... xs) {
  std::optional<Answer> answer;
  caf::error problem;
  const auto keep_problem = [&](caf::error& e) { problem = std::move(e); };
  auto waiting = self_->request(whom, limit, std::forward<Ts>(xs)...);
  if constexpr (std::is_same_v<Answer, std::monostate>)
    waiting.receive([&] { answer.emplace(); }, keep_problem);
  else
    waiting.receive([&](Answer& x) { answer = std::move(x); }, keep_problem);
  if (!answer)
    explain(problem);
  return *std::move(answer);
}

far_bench::far_bench(caf::actor_system& sys, const gate_actor& gate,
                     const worker_introduction& who)
    : self_{sys} {
  const auto types = fingerprint_of_types();
  std::uint32_t their_protocol = 0;
  std::uint64_t their_types = 0;
  std::string nonce;
  caf::error problem;
  self_->request(gate, protocol::introduction_timeout, who.protocol, types)
      .receive(
          [&](std::uint32_t protocol, std::uint64_t block, std::string& number,
              const caf::strong_actor_ptr& in) {
            their_protocol = protocol;
            their_types = block;
            nonce = std::move(number);
            bench_ = caf::actor_cast<workbench_actor>(in);
          },
          [&](caf::error& e) { problem = std::move(e); });
  if (problem)
    explain(problem);
  if (their_protocol != who.protocol || their_types != types)
    throw worker_refuses{fmt::format(
        "it speaks {}, this program {}; install the same version on both sides",
        spoken(their_protocol, their_types), spoken(who.protocol, types))};
  if (!bench_)
    throw worker_lost{"too many are there already"};
  // It must not let us speak to an actor of our own.
  if (bench_.node() != gate.node() || nonce.size() > longest_nonce)
    throw worker_refuses{"it is no worker"};
  worker_hello hello{who.program, {}, {}};
  who.prove(hello, nonce);
  slots_ = ask<std::uint32_t>(bench_, protocol::introduction_timeout,
                              std::move(hello));
}

void far_bench::add(file_piece piece) {
  ask<std::monostate>(bench_, protocol::silence_limit, std::move(piece));
}

void far_bench::begin() {
  ask<std::monostate>(bench_, protocol::silence_limit, begin_atom_v);
}

run_report far_bench::look() {
  auto report = ask<run_report>(bench_, protocol::silence_limit, look_atom_v);
  report.failure = printable(std::move(report.failure));
  return report;
}

file_piece far_bench::next() {
  return ask<file_piece>(bench_, protocol::silence_limit, next_atom_v);
}

} // namespace sofof

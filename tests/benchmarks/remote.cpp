// What a connection between two processes costs: an input there and its result
// back, beside a bare round trip of the same octets between two CAF systems.
#include "actors/remote/acceptor.hpp"
#include "actors/remote/provider_connection.hpp"
#include "actors/remote/provider_proxy.hpp"
#include "actors/runtime/recorder.hpp"
#include "messages/protocol/no_records.hpp"
#include "scenario/runtime.hpp"

#include <benchmark/benchmark.h>
#include <caf/io/middleman.hpp>
#include <caf/send.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <memory>
#include <numeric>
#include <semaphore>
#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::scenario;

namespace {

constexpr std::size_t octets_of_a_plan = 440; // as docs/v2x.md has it
constexpr station_id::rep first_station = 101;
/// They take turns: each may say but so much a second.
constexpr std::size_t stations = 200;
constexpr provider_id boot = 1;

using arrivals = std::binary_semaphore;

payload plan() {
  its_pdu message;
  message.octets.resize(octets_of_a_plan);
  return payload::of(std::move(message));
}

session_id running(station_id station = first_station) {
  return {boot, station, "trajectory_planning", 1};
}

// -- bare ---------------------------------------------------------------------

using echo_actor = caf::typed_actor<caf::result<service_result>(service_input)>;

echo_actor::behavior_type echo() {
  return {[](const service_input& x) {
    return service_result{x.session, 0, x.at, x.what};
  }};
}

void bare_round_trip(benchmark::State& state) {
  const auto there = make_network_runtime(), here = make_network_runtime();
  const auto answerer = there->system().spawn(echo);
  const auto port =
      there->system().middleman().publish(answerer, 0, "127.0.0.1");
  const auto far =
      here->system().middleman().remote_actor<echo_actor>("127.0.0.1", *port);
  arrivals come{0};
  caf::actor asker = here->system().spawn(
      [far = *far, &come](caf::event_based_actor* self) -> caf::behavior {
        return {[=, &come](const service_input& x) {
          self->request(far, caf::infinite, x)
              .then([&come](const service_result&) { come.release(); });
        }};
      });
  for (auto _ : state) {
    caf::anon_send(asker, service_input{running(), here->now(), plan()});
    come.acquire();
  }
  caf::anon_send_exit(asker, caf::exit_reason::user_shutdown);
  caf::anon_send_exit(answerer, caf::exit_reason::user_shutdown);
}
BENCHMARK(bare_round_trip)->UseRealTime()->Unit(benchmark::kMicrosecond);

// -- forwarded ----------------------------------------------------------------

provider_manager_actor::behavior_type
manager(provider_manager_actor::pointer self,
        const requester_actor& requester) {
  return {
      [=](const service_result&) {},
      [=](const service_input& x) {
        self->send(requester, service_result{x.session, 0, x.at, x.what});
      },
      [=](const service_end&) { self->quit(); },
  };
}

/// Accepts everything.
provider_actor::behavior_type provider(provider_actor::pointer self) {
  return {
      [](const its_pdu&, const requester_actor&) {},
      [self](const service_request& x, const requester_actor& requester) {
        service_response response{boot, x.station, x.number, {}};
        response.verdicts.push_back({running(x.station), true, {}});
        self->send(requester, response,
                   std::vector<provider_manager_actor>{
                       self->spawn(manager, requester)});
      },
      [](const service_end&) {},
  };
}

/// Tells when it is accepted, and then of every result.
requester_actor::behavior_type requester(requester_actor::pointer,
                                         arrivals* come) {
  return {
      [=](const service_result&) { come->release(); },
      [](const service_offer&) {},
      [](const session_digest&) {},
      [=](const service_response&, const std::vector<provider_manager_actor>&) {
        come->release();
      },
      [](const service_end&) {},
  };
}

void forwarded_round_trip(benchmark::State& state) {
  const auto there = make_network_runtime(), here = make_network_runtime();
  const auto sink = std::make_shared<no_records>();
  const auto serving = there->system().spawn(provider);
  acceptor_setup in;
  in.provider = serving;
  in.id = boot;
  in.name = "mec";
  in.clock = there->clock();
  in.recorder = spawn_recorder(there->system(), sink);
  in.draw_nonce = [] { return std::string{}; };
  in.examine = [](const auto&...) { return peer_finding{}; };
  const auto recorder = in.recorder;
  const auto port =
      there->publish(spawn_acceptor(there->system(), std::move(in)), 0);

  provider_connection_setup out;
  out.provider = "mec";
  out.stations.resize(stations);
  std::iota(out.stations.begin(), out.stations.end(), first_station);
  const auto speakers = out.stations;
  out.clock = here->clock();
  out.recorder = spawn_recorder(here->system(), sink);
  out.connect = [&here, port] { return here->connect(port); };
  out.prove = [](auto&, const auto&) {};
  arrivals connected{0}, come{0};
  out.on_refusal = [](const std::string&) {};
  out.on_news = [&connected](const std::string&) { connected.release(); };
  const auto here_recorder = out.recorder;
  const auto outbox = spawn_provider_connection(here->system(), std::move(out));
  std::vector<link_actor> far;
  for (const auto station : speakers) {
    far.push_back(spawn_provider_proxy(here->system(), station, outbox));
    introduce(outbox, station, far.back());
  }
  const auto near = here->system().spawn(requester, &come);
  connected.acquire();
  // Until the clocks are known, and everybody's turn to speak has come.
  here->run_until(here->now() + std::chrono::milliseconds{1500});
  for (std::size_t k = 0; k < stations; ++k) {
    caf::anon_send(
        far[k],
        service_request{boot, speakers[k], 1, {"trajectory_planning"}, {}, 0},
        requester_actor{near});
    come.acquire();
  }
  std::size_t k = 0;
  for (auto _ : state) {
    caf::anon_send(far[k],
                   service_input{running(speakers[k]), here->now(), plan()});
    come.acquire();
    k = (k + 1) % stations;
  }
  const auto leave = [](const auto& actor) {
    caf::anon_send_exit(actor, caf::exit_reason::user_shutdown);
  };
  for (const auto& one : far)
    leave(one);
  leave(outbox), leave(near), leave(here_recorder);
  leave(serving), leave(recorder);
}
BENCHMARK(forwarded_round_trip)->UseRealTime()->Unit(benchmark::kMicrosecond);

} // namespace

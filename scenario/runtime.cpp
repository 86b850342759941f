// The time that a run lives in: virtual or wall clock, around one CAF system.
#include "scenario/runtime.hpp"

#include "actors/runtime/accounting_scheduler.hpp"
#include "actors/runtime/host_scheduler.hpp"
#include "actors/runtime/sharing_scheduler.hpp"
#include "actors/simulation/des_scheduler.hpp"
#include "base/input_error.hpp"
#include "base/protocol.hpp"
#include "messages/type_ids.hpp"
#include "scenario/init_messages.hpp"

#include <caf/actor_system_config.hpp>
#include <caf/init_global_meta_objects.hpp>
#include <caf/io/middleman.hpp>
#include <caf/scoped_actor.hpp>
#include <caf/send.hpp>
#include <fmt/format.h>

#include <chrono>
#include <thread>
#include <utility>

namespace sofof::scenario {

namespace {

struct virtual_config : caf::actor_system_config {
  virtual_config() { load<actors::des_scheduler>(); }
};

class virtual_runtime final : public runtime {
public:
  explicit virtual_runtime(std::shared_ptr<job_pool> pool) {
    scheduler_.be_helped_by(pool ? std::move(pool)
                                 : std::make_shared<job_pool>(0));
  }

  caf::actor_system& system() override { return system_; }
  time_point now() const override {
    return time_point{scheduler_.clock().now().time_since_epoch()};
  }
  messages::etsi::its_clock clock() const override {
    return messages::etsi::its_clock{};
  }
  void run_until(time_point end) override { scheduler_.run_until(end); }
  void await_end(const std::vector<caf::actor>&) override {
    scheduler_.run_ready();
  }

private:
  virtual_config config_;
  caf::actor_system system_{config_};
  actors::des_scheduler& scheduler_ =
      dynamic_cast<actors::des_scheduler&>(system_.scheduler());
};

/// The machine's clocks, and how far the one of the run is off.
template <class Runtime>
class on_the_wall : public Runtime {
public:
  explicit on_the_wall(const actors::clock_error& error = {}) : error_{error} {}

  time_point now() const override {
    return error_.shown(
        time_point{std::chrono::steady_clock::now().time_since_epoch()});
  }
  messages::etsi::its_clock clock() const override { return clock_; }
  void run_until(time_point end) override {
    std::this_thread::sleep_until(std::chrono::steady_clock::time_point{
        error_.meant(end).time_since_epoch()});
  }
  void await_end(const std::vector<caf::actor>& leaving) override {
    caf::scoped_actor self{this->system()};
    self->wait_for(leaving);
  }

private:
  // The steady clock counts from anywhere.
  static std::int64_t epoch_unix_ms() {
    using std::chrono::milliseconds;
    const auto day = std::chrono::system_clock::now().time_since_epoch();
    const auto run = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::round<milliseconds>(day - run).count();
  }

  actors::clock_error error_;
  messages::etsi::its_clock clock_{epoch_unix_ms()};
};

struct wall_clock_config : caf::actor_system_config {
  wall_clock_config() { load<actors::sharing_scheduler>(); }
};

struct accounting_config : caf::actor_system_config {
  accounting_config() { load<actors::accounting_scheduler>(); }
};

template <class Config>
class wall_clock_runtime final : public on_the_wall<runtime> {
public:
  caf::actor_system& system() override { return system_; }

private:
  Config config_;
  caf::actor_system system_{config_};
};

struct network_config : caf::actor_system_config {
  explicit network_config(const actors::clock_error& error) {
    actors::host_scheduler::install(*this, error);
    load<caf::io::middleman>();
    set("caf.middleman.heartbeat-interval",
        caf::timespan{2 * protocol::ping_period});
    set("caf.middleman.connection-timeout",
        caf::timespan{protocol::silence_limit});
  }
};

class connected_runtime final : public on_the_wall<network_runtime> {
public:
  explicit connected_runtime(const actors::clock_error& error)
      : on_the_wall{error}, config_{error} {}

  ~connected_runtime() override {
    for (const auto& acceptor : acceptors_)
      caf::anon_send_exit(acceptor, caf::exit_reason::user_shutdown);
    await_end(acceptors_);
  }

  caf::actor_system& system() override { return system_; }

  void filter(actors::filter_setup setup) override {
    actors::filter_connections(system_.middleman(), std::move(setup), peers_);
  }

  std::optional<network::peer_identity>
  identity_of(const caf::node_id& process) const override {
    return peers_->find(process);
  }

  std::uint16_t publish(const messages::acceptor_actor& acceptor,
                        std::uint16_t port) override {
    constexpr auto reuse = true; // soon after another one, which was killed
    const auto open =
        system_.middleman().publish(acceptor, port, this_machine, reuse);
    if (!open)
      throw input_error(fmt::format(
          "cannot listen on port {}: {}; choose another one with --listen",
          port,
          open.error() == caf::sec::cannot_open_port
              ? "it is taken, or needs more rights"
              : caf::to_string(open.error())));
    acceptors_.push_back(caf::actor_cast<caf::actor>(acceptor));
    return *open;
  }

  std::variant<messages::acceptor_actor, std::string>
  connect(std::uint16_t port) override {
    auto acceptor = system_.middleman().remote_actor<messages::acceptor_actor>(
        this_machine, port);
    if (!acceptor)
      return explain(acceptor.error());
    return std::move(*acceptor);
  }

private:
  static std::string explain(const caf::error& why) {
    if (why == caf::sec::cannot_connect_to_node)
      return "nobody listens there";
    if (why == caf::sec::disconnect_during_handshake)
      return "it closed the connection before it said anything; is it a port "
             "that wants --keys?";
    if (why == caf::sec::connection_timeout)
      return "it does not answer";
    if (why == caf::sec::redundant_connection)
      return "an earlier connection with it has not ended yet";
    if (why == caf::sec::incompatible_versions)
      return "it was built with another version of CAF";
    return "who listens there speaks another language";
  }

  static constexpr auto this_machine = "127.0.0.1";

  const std::shared_ptr<actors::peer_nodes> peers_ =
      std::make_shared<actors::peer_nodes>();
  network_config config_;
  caf::actor_system system_{config_};
  std::vector<caf::actor> acceptors_;
};

} // namespace

std::unique_ptr<runtime> make_virtual_runtime(std::shared_ptr<job_pool> pool) {
  return std::make_unique<virtual_runtime>(std::move(pool));
}

std::unique_ptr<runtime> make_wall_clock_runtime() {
  return std::make_unique<wall_clock_runtime<wall_clock_config>>();
}

std::unique_ptr<runtime> make_accounting_runtime() {
  return std::make_unique<wall_clock_runtime<accounting_config>>();
}

std::unique_ptr<network_runtime>
make_network_runtime(actors::clock_error clock) {
  clock.from = time_point{std::chrono::steady_clock::now().time_since_epoch()};
  return std::make_unique<connected_runtime>(clock);
}

void init_messages() {
  caf::init_global_meta_objects<caf::id_block::sofof>();
  caf::io::middleman::init_global_meta_objects();
  caf::core::init_global_meta_objects();
}

} // namespace sofof::scenario

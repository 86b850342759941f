// The time that a run lives in: virtual or wall clock, around one CAF system.
#include "scenario/runtime.hpp"

#include "actors/des_scheduler.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system_config.hpp>
#include <caf/init_global_meta_objects.hpp>
#include <caf/scoped_actor.hpp>

#include <chrono>
#include <thread>

namespace sofof {

namespace {

struct virtual_config : caf::actor_system_config {
  virtual_config() { load<des_scheduler>(); }
};

class virtual_runtime final : public runtime {
public:
  caf::actor_system& system() override { return system_; }
  time_point now() const override {
    return time_point{scheduler_.clock().now().time_since_epoch()};
  }
  etsi::its_clock clock() const override { return etsi::its_clock{}; }
  void run_until(time_point end) override { scheduler_.run_until(end); }
  void await_end(const std::vector<caf::actor>&) override {
    scheduler_.run_ready();
  }

private:
  virtual_config config_;
  caf::actor_system system_{config_};
  des_scheduler& scheduler_ = dynamic_cast<des_scheduler&>(system_.scheduler());
};

class wall_clock_runtime final : public runtime {
public:
  caf::actor_system& system() override { return system_; }
  time_point now() const override {
    return time_point{std::chrono::steady_clock::now().time_since_epoch()};
  }
  etsi::its_clock clock() const override { return clock_; }
  void run_until(time_point end) override {
    std::this_thread::sleep_until(
        std::chrono::steady_clock::time_point{end.time_since_epoch()});
  }
  void await_end(const std::vector<caf::actor>& leaving) override {
    caf::scoped_actor self{system_};
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

  etsi::its_clock clock_{epoch_unix_ms()};
  caf::actor_system_config config_;
  caf::actor_system system_{config_};
};

} // namespace

std::unique_ptr<runtime> make_virtual_runtime() {
  return std::make_unique<virtual_runtime>();
}

std::unique_ptr<runtime> make_wall_clock_runtime() {
  return std::make_unique<wall_clock_runtime>();
}

void init_messages() {
  caf::init_global_meta_objects<caf::id_block::sofof>();
  caf::core::init_global_meta_objects();
}

} // namespace sofof

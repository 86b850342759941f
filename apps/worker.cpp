// sofof worker: carries out runs for sweeps on other hosts.
#include "scenario/sweep/worker.hpp"

#include "apps/command.hpp"
#include "apps/host_arguments.hpp"
#include "apps/program.hpp"
#include "apps/signals.hpp"
#include "scenario/sweep/child_run.hpp"

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

namespace sofof {

void add_worker(CLI::App& app, int& exit_code) {
  struct arguments {
    host_arguments host;
    worker_options what;
    std::string listen = "127.0.0.1:4712";
  };
  auto* command = app.add_subcommand(
      "worker", "Carry out runs for `sofof sweep --workers` on other hosts");
  auto args = std::make_shared<arguments>();
  args->what.slots = std::max(1U, std::thread::hardware_concurrency());
  command
      ->add_option("--listen", args->listen,
                   "Where sweeps connect to (default 127.0.0.1:4712)")
      ->type_name("HOST:PORT");
  command
      ->add_option("-j,--jobs", args->what.slots,
                   "Runs at the same time (default: one per core)")
      ->type_name("N")
      ->check(CLI::Range(1U, 1024U));
  args->host.add_to(*command);
  command->footer("It runs until it is stopped, and keeps nothing.\nExample:\n"
                  "  sofof worker --listen 0.0.0.0:4712 --keys "
                  "keys/provider-worker");
  command->callback([args, &exit_code] {
    auto& what = args->what;
    what.listen = address_of(args->listen);
    what.program = this_program();
    what.run = [limits = shared_limits(what.slots)](const run_order& order) {
      run_as_child(program_file, order, limits);
    };
    args->host.give(what);
    catch_signals();
    worker(what, interrupted, std::cout);
    exit_code = 0;
  });
}

} // namespace sofof

// The `sofof` command.
#include "apps/command.hpp"
#include "base/input_error.hpp"
#include "base/options/spelling.hpp"
#include "network/network_error.hpp"
#include "scenario/init_messages.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <malloc.h>
#include <string_view>
#include <vector>

namespace {

constexpr int failed = 1;
constexpr int wrong_input = 2;

int complain(const char* what, int exit_code) {
  std::fprintf(stderr, "sofof: %s\n", what);
  return exit_code;
}

/// @throws input_error for a command that there is none of.
void check_command(const CLI::App& app, std::string_view word) {
  if (word.starts_with('-'))
    return; // an option
  std::vector<std::string_view> known;
  for (const auto* command :
       app.get_subcommands([](const CLI::App*) { return true; }))
    known.push_back(command->get_name());
  if (std::ranges::count(known, word) == 0)
    throw sofof::input_error{sofof::unknown_word("command", word, known)};
}

int obey(int argc, char** argv) {
  CLI::App app{"SOFOF: function offloading for connected automated vehicles",
               "sofof"};
  app.set_version_flag("--version", "sofof " SOFOF_VERSION);
  app.require_subcommand(0, 1);
  app.footer("First steps:\n  sofof run config/ulm_lehr.toml\n"
             "  sofof report results/ulm_lehr-1\n"
             "  sofof test        (through ./sofof at the root)\n\n"
             "Exit codes: 0 done, 1 the run was unsafe or failed, or a message "
             "is wrong,\n2 wrong input or usage, 130 interrupted.");
  int exit_code = 0;
  sofof::apps::add_run(app, exit_code);
  sofof::apps::add_sweep(app, exit_code);
  sofof::apps::add_bench(app, exit_code);
  sofof::apps::add_train(app, exit_code);
  sofof::apps::add_provide(app, exit_code);
  sofof::apps::add_drive(app, exit_code);
  sofof::apps::add_reproduce(app, exit_code);
  sofof::apps::add_report(app, exit_code);
  sofof::apps::add_check(app, exit_code);
  sofof::apps::add_policies(app, exit_code);
  sofof::apps::add_solve(app, exit_code);
  sofof::apps::add_decode(app, exit_code);
  sofof::apps::add_encode(app, exit_code);
  sofof::apps::add_keys(app, exit_code);
  if (argc > 1)
    check_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : wrong_input;
  }
  if (app.get_subcommands().empty())
    std::cout << app.help();
  return exit_code;
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN); // a full quota is an error, no death
  // One arena for malloc: an actor system hands memory from thread to thread,
  // and with an arena per thread it spreads out.
  mallopt(M_ARENA_MAX, 1);
  sofof::scenario::init_messages();
  try {
    const auto exit_code = obey(argc, argv);
    if (!std::cout.flush())
      return complain("the output cannot be written; is the disk full?",
                      failed);
    return exit_code;
  } catch (const sofof::input_error& e) {
    return complain(e.what(), wrong_input);
  } catch (const sofof::network::network_error& e) {
    return complain(e.what(), wrong_input);
  } catch (const std::exception& e) {
    return complain(e.what(), failed);
  }
}

// The `sofof` command.
#include "apps/command.hpp"
#include "scenario/input_error.hpp"
#include "scenario/runtime.hpp"

#include <cstdio>
#include <exception>
#include <malloc.h>

namespace {

constexpr int wrong_input = 2;
constexpr int failed = 1;

} // namespace

int main(int argc, char** argv) {
  // One arena for malloc: an actor system hands memory from thread to thread,
  // and with an arena per thread it spreads out.
  mallopt(M_ARENA_MAX, 1);
  CLI::App app{"SOFOF: function offloading for connected automated vehicles",
               "sofof"};
  app.set_version_flag("--version", "sofof " SOFOF_VERSION);
  app.require_subcommand(1);
  app.footer("First steps:\n  sofof run config/ulm_lehr.toml\n"
             "  sofof test        (through ./sofof at the root)\n\n"
             "Exit codes: 0 done, 1 the run was unsafe or failed, 2 wrong "
             "input or usage,\n130 interrupted.");
  int exit_code = 0;
  sofof::add_run(app, exit_code);
  sofof::add_check(app, exit_code);
  sofof::init_messages();
  if (argc == 1) {
    std::fputs(app.help().c_str(), stdout);
    return 0;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : wrong_input;
  } catch (const sofof::input_error& e) {
    std::fprintf(stderr, "sofof: %s\n", e.what());
    return wrong_input;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "sofof: %s\n", e.what());
    return failed;
  }
  return exit_code;
}

// The `sofof` command.
#include "apps/command.hpp"
#include "apps/terminal.hpp"
#include "apps/usage.hpp"
#include "base/input_error.hpp"
#include "base/options/spelling.hpp"
#include "base/text/wrapped.hpp"
#include "network/network_error.hpp"
#include "scenario/init_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <malloc.h>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace {

constexpr int failed = 1;
constexpr int wrong_input = 2;

int complain(std::string_view what, int exit_code) {
  auto line = fmt::format("sofof: {}", what);
  if (const auto width = sofof::apps::terminal_width(STDERR_FILENO))
    line = sofof::wrapped(line, *width, 2);
  std::fprintf(stderr, "%s\n", line.c_str());
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

/// "help run" is "run --help".
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  return words;
}

int obey(int argc, char** argv) {
  CLI::App app{"SOFOF: function offloading for connected automated vehicles",
               "sofof"};
  app.set_version_flag("--version", "sofof " SOFOF_VERSION);
  app.require_subcommand(0, 1);
  app.footer("First steps:\n  sofof run config/ulm_lehr.toml\n"
             "  sofof report results/ulm_lehr-1\n"
             "  sofof help run\n\n"
             "Exit codes: 0 done, 1 the run was unsafe or failed, or a message "
             "is wrong,\n2 wrong input or usage, 130 interrupted.");
  int exit_code = 0;
  sofof::apps::add_run(app, exit_code);
  sofof::apps::add_sweep(app, exit_code);
  sofof::apps::add_bench(app, exit_code);
  sofof::apps::add_train(app, exit_code);
  sofof::apps::add_torture(app, exit_code);
  sofof::apps::add_provide(app, exit_code);
  sofof::apps::add_drive(app, exit_code);
  sofof::apps::add_broker(app, exit_code);
  sofof::apps::add_sil(app, exit_code);
  sofof::apps::add_load_test(app, exit_code);
  sofof::apps::add_health(app, exit_code);
  sofof::apps::add_reproduce(app, exit_code);
  sofof::apps::add_report(app, exit_code);
  sofof::apps::add_explain(app, exit_code);
  sofof::apps::add_convert(app, exit_code);
  sofof::apps::add_import(app, exit_code);
  sofof::apps::add_new(app, exit_code);
  sofof::apps::add_map(app, exit_code);
  sofof::apps::add_judge(app, exit_code);
  sofof::apps::add_check(app, exit_code);
  sofof::apps::add_check_trace(app, exit_code);
  sofof::apps::add_policies(app, exit_code);
  sofof::apps::add_solve(app, exit_code);
  sofof::apps::add_decode(app, exit_code);
  sofof::apps::add_encode(app, exit_code);
  sofof::apps::add_keys(app, exit_code);
  sofof::apps::add_schema(app, exit_code);
  sofof::apps::add_completion(app, exit_code);
  sofof::apps::add_manual(app, exit_code);
  const auto words = words_of(argc, argv);
  if (!words.empty())
    check_command(app, words.front());
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return complain(sofof::apps::usage_error(app, e, words), wrong_input);
  }
  if (app.get_subcommands().empty())
    std::cout << app.help();
  return exit_code;
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN); // a full quota is an error, no death
  std::signal(SIGCHLD, SIG_DFL); // ignored, how children end would be lost
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

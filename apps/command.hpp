// A sub-command of `sofof`.
#pragma once

#include <CLI/CLI.hpp>

namespace sofof::apps {

/// Each adds itself to the command line; when it was chosen, `exit_code` gets
/// what the process shall exit with.
void add_run(CLI::App& app, int& exit_code);
void add_provide(CLI::App& app, int& exit_code);
void add_drive(CLI::App& app, int& exit_code);
void add_load_test(CLI::App& app, int& exit_code);
void add_broker(CLI::App& app, int& exit_code);
void add_sil(CLI::App& app, int& exit_code);
void add_health(CLI::App& app, int& exit_code);
void add_sweep(CLI::App& app, int& exit_code);
void add_reproduce(CLI::App& app, int& exit_code);
void add_bench(CLI::App& app, int& exit_code);
void add_train(CLI::App& app, int& exit_code);
void add_torture(CLI::App& app, int& exit_code);
void add_explain(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_check_trace(CLI::App& app, int& exit_code);
void add_policies(CLI::App& app, int& exit_code);
void add_solve(CLI::App& app, int& exit_code);
void add_decode(CLI::App& app, int& exit_code);
void add_encode(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);
void add_import(CLI::App& app, int& exit_code);
void add_map(CLI::App& app, int& exit_code);
void add_judge(CLI::App& app, int& exit_code);
void add_new(CLI::App& app, int& exit_code);
void add_keys(CLI::App& app, int& exit_code);
void add_schema(CLI::App& app, int& exit_code);
void add_completion(CLI::App& app, int& exit_code);
void add_manual(CLI::App& app, int& exit_code);

} // namespace sofof::apps

// A program that decides in place of a policy, and its two faces.
#pragma once

#include "policies/api/context.hpp"

#include "programs/answers.hpp"
#include "programs/line_pipe.hpp"
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sofof::programs {

/// What a program is started with.
struct program_setup {
  std::string side;             ///< "lodm" or "codm".
  std::string command;          ///< As `command_words` reads it.
  std::filesystem::path folder; ///< Where it runs.
  duration time_limit{};        ///< For each answer, > 0, on the wall's clock.
  std::string scenario;         ///< Its name.
  std::uint64_t seed = 0;
};

/// A whole sentence about a program that did not do what it has to.
class program_error : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// A program that runs. Once it has failed it is asked nothing any more. Any
/// thread may call all members.
class policy_program {
public:
  /// Starts it and greets it.
  /// @throws input_error when it cannot be started, program_error when it does
  /// not greet back.
  explicit policy_program(program_setup setup);
  /// As `end`.
  ~policy_program();

  const hello_answer& hello() const { return hello_; }

  /// Asks it. @returns nullopt from its failure on.
  std::optional<policies::local_decision>
  decide(const policies::local_context& context);
  std::optional<std::vector<policies::central_decision>>
  decide(const policies::central_context& context);

  /// Tells it with the next ask, if it wants to be told.
  void tell(const auto& outcome) {
    if (!hello_.wanted.tells)
      return;
    const std::lock_guard lock{mutex_};
    append_told(untold_, outcome);
    send_if_many();
  }

  /// Calls `tell` with the sentence about its failure, as soon as it fails;
  /// only once, and without a failure never.
  void on_failure(std::function<void(const std::string&)> tell);

  /// @returns that sentence, if it has failed.
  std::optional<std::string> failure() const;

  /// Takes leave of it, and waits until it has gone.
  void end();

private:
  using append = std::function<void(std::string& to)>;
  using read = std::function<void(std::string_view answer)>;

  bool ask(const append& question, const read& answer);
  void send_if_many();
  void fail(std::string sentence);
  std::string sentence(std::string_view what, const answer_error& problem,
                       std::string_view answer) const;
  std::string sentence(const pipe_error& problem, std::string_view lines) const;
  line_pipe::clock::time_point limit() const;

  program_setup setup_;
  mutable std::mutex mutex_; // of all below
  std::optional<line_pipe> pipe_;
  hello_answer hello_;
  kept_words words_;
  std::string untold_;
  std::string lines_; // that are sent
  std::uint64_t asked_ = 0;
  std::optional<std::string> failure_;
  std::function<void(const std::string&)> on_failure_;
};

/// @returns the program as the policy of all vehicles, and of all providers.
std::shared_ptr<policies::local_policy>
local_decider(std::shared_ptr<policy_program> program);
std::shared_ptr<policies::central_policy>
central_decider(std::shared_ptr<policy_program> program);

} // namespace sofof::programs

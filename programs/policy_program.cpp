// One question at a time.
#include "programs/policy_program.hpp"

#include "base/input_error.hpp"

#include <fmt/format.h>

#include <cassert>
#include <chrono>
#include <utility>

namespace sofof::programs {

namespace {

using namespace policies;

/// The program as a policy; clones share it.
template <class Context, class Decision, class Candidate>
class decider final : public policy<Context, Decision, Candidate> {
public:
  using whole_policy = policy<Context, Decision, Candidate>;

  explicit decider(std::shared_ptr<policy_program> program)
      : program_{std::move(program)} {}

  Decision decide(const Context& context) override {
    if (auto decided = program_->decide(context))
      return *std::move(decided);
    if constexpr (std::is_same_v<Decision, local_decision>)
      return as_it_is("the program has failed");
    else
      return {};
  }
  void observe(const cycle_outcome& x) override { program_->tell(x); }
  void observe(const refusal_outcome& x) override { program_->tell(x); }
  void observe(const episode_outcome& x) override { program_->tell(x); }
  bool needs_scene() const override { return program_->hello().wanted.scene; }
  bool needs_chain() const override { return program_->hello().wanted.chain; }
  bool needs_forecast() const override {
    return program_->hello().wanted.forecast;
  }
  std::string_view name() const override { return "process"; }
  std::string title() const override {
    const auto& self = program_->hello();
    return fmt::format("{}{}{}", self.name, self.version.empty() ? "" : " ",
                       self.version);
  }
  std::unique_ptr<whole_policy> clone() const override {
    return std::make_unique<decider>(*this);
  }

private:
  std::shared_ptr<policy_program> program_;
};

child_setup child_of(const program_setup& setup) {
  child_setup made;
  made.command = command_words(setup.command);
  made.folder = setup.folder;
  return made;
}

} // namespace

policy_program::policy_program(program_setup setup) : setup_{std::move(setup)} {
  assert(setup_.time_limit > duration{0});
  pipe_.emplace(child_of(setup_));
  append_hello(lines_, setup_.side, setup_.scenario, setup_.seed);
  std::string_view answer;
  try {
    answer = pipe_->ask(lines_, limit());
    hello_ = read_hello(answer);
  } catch (const answer_error& problem) {
    throw program_error{sentence("answered hello wrongly", problem, answer)};
  } catch (const pipe_error& problem) {
    throw program_error{sentence(problem, lines_)};
  }
}

policy_program::~policy_program() {
  end();
}

std::optional<local_decision>
policy_program::decide(const local_context& context) {
  const std::lock_guard lock{mutex_};
  local_decision decided;
  const auto is_there = ask(
      [&](std::string& to) { append_ask(to, asked_, context, hello_.wanted); },
      [&](std::string_view answer) {
        decided = read_answer(answer, asked_, context, words_);
      });
  return is_there ? std::optional{decided} : std::nullopt;
}

std::optional<std::vector<central_decision>>
policy_program::decide(const central_context& context) {
  const std::lock_guard lock{mutex_};
  std::vector<central_decision> decided;
  const auto is_there =
      ask([&](std::string& to) { append_ask(to, asked_, context); },
          [&](std::string_view answer) {
            decided = read_answer(answer, asked_, context, words_);
          });
  return is_there ? std::optional{std::move(decided)} : std::nullopt;
}

/// @returns whether there is an answer.
bool policy_program::ask(const append& question, const read& answer) {
  if (!pipe_)
    return false;
  ++asked_;
  lines_ = std::exchange(untold_, {});
  const auto told = lines_.size();
  question(lines_);
  std::string_view line;
  try {
    line = pipe_->ask(lines_, limit());
    answer(line);
    return true;
  } catch (const answer_error& problem) {
    fail(sentence(fmt::format("answered ask {} wrongly", asked_), problem,
                  line));
  } catch (const pipe_error& problem) {
    fail(sentence(problem, std::string_view{lines_}.substr(told)));
  }
  return false;
}

/// Who is told much and asked little shall not be told all at once.
void policy_program::send_if_many() {
  constexpr std::size_t many = 65'536;
  if (!pipe_)
    untold_.clear();
  if (untold_.size() < many)
    return;
  lines_ = std::exchange(untold_, {});
  try {
    pipe_->tell(lines_, limit());
  } catch (const pipe_error& problem) {
    fail(sentence(problem, lines_));
  }
}

void policy_program::on_failure(std::function<void(const std::string&)> tell) {
  const std::lock_guard lock{mutex_};
  on_failure_ = std::move(tell);
}

std::optional<std::string> policy_program::failure() const {
  const std::lock_guard lock{mutex_};
  return failure_;
}

void policy_program::fail(std::string sentence) {
  assert(!failure_);
  pipe_->stop();
  pipe_.reset();
  failure_ = std::move(sentence);
  if (on_failure_)
    on_failure_(*failure_);
}

void policy_program::end() {
  const std::lock_guard lock{mutex_};
  if (!pipe_)
    return;
  append_bye(untold_);
  pipe_->end(untold_);
  pipe_.reset();
}

std::string policy_program::sentence(std::string_view what,
                                     const answer_error& problem,
                                     std::string_view answer) const {
  return fmt::format("the program of policies.{}, \"{}\", {}: {}: {}",
                     setup_.side, setup_.command, what, problem.what(),
                     quoted_line(answer));
}

/// @param lines  That it got.
std::string policy_program::sentence(const pipe_error& problem,
                                     std::string_view lines) const {
  return fmt::format("the program of policies.{}, \"{}\", {}; it had got: {}",
                     setup_.side, setup_.command, problem.what(),
                     quoted_line(lines));
}

line_pipe::clock::time_point policy_program::limit() const {
  return line_pipe::clock::now() + setup_.time_limit;
}

std::shared_ptr<local_policy>
local_decider(std::shared_ptr<policy_program> program) {
  assert(program);
  return std::make_shared<
      decider<local_context, local_decision, provider_view>>(
      std::move(program));
}

std::shared_ptr<central_policy>
central_decider(std::shared_ptr<policy_program> program) {
  assert(program);
  return std::make_shared<
      decider<central_context, std::vector<central_decision>, request_view>>(
      std::move(program));
}

} // namespace sofof::programs

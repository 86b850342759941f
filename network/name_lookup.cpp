// A detached thread that owns whatever it touches.
#include "network/name_lookup.hpp"

#include "network/block_signals.hpp"

#include <mutex>
#include <thread>
#include <utility>

namespace sofof::network {

struct name_lookup::question {
  std::mutex mutex;
  std::optional<std::vector<socket_address>> answer; // guarded by mutex
};

name_lookup::name_lookup(const name_resolver& resolve,
                         const network_address& host,
                         std::shared_ptr<wake_up> wake)
    : question_{std::make_shared<question>()} {
  std::thread{[=, question = question_, wake = std::move(wake)] {
    leave_signals_to_others();
    auto found = resolve(host);
    {
      const std::lock_guard lock{question->mutex};
      question->answer = std::move(found);
    }
    wake->call();
  }}.detach();
}

std::optional<std::vector<socket_address>> name_lookup::answer() const {
  const std::lock_guard lock{question_->mutex};
  return question_->answer;
}

} // namespace sofof::network

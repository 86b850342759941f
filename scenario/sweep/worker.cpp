// A process that carries out runs for sweeps on other hosts.
#include "scenario/sweep/worker.hpp"

#include "actors/remote/worker_gate.hpp"
#include "network/nonce.hpp"
#include "scenario/front.hpp"
#include "scenario/input_error.hpp"
#include "scenario/sweep/crew_run.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <ostream>
#include <system_error>
#include <utility>

namespace sofof {

namespace fs = std::filesystem;

namespace {

using namespace std::chrono_literals;

/// A folder of one's own, gone with this object.
class temporary_folder {
public:
  temporary_folder() {
    auto name = (fs::temp_directory_path() / "sofof_worker_XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw input_error(fmt::format(
          "cannot make a temporary folder {}: {}; choose another place with "
          "the variable TMPDIR",
          name, std::generic_category().message(errno)));
    at_ = name;
  }
  ~temporary_folder() {
    std::error_code ignored;
    fs::remove_all(at_, ignored);
  }
  temporary_folder(const temporary_folder&) = delete;
  temporary_folder& operator=(const temporary_folder&) = delete;

  const fs::path& path() const { return at_; }

private:
  fs::path at_;
};

/// Who was refused; strangers do not fill the console.
class refusals {
public:
  void add(const std::string& why) {
    const std::lock_guard lock{mutex_};
    ++count_;
    last_ = why;
  }

  /// @returns a line; empty if nobody was, since the last call.
  std::string take() {
    const std::lock_guard lock{mutex_};
    if (count_ == 0)
      return {};
    const auto others = std::exchange(count_, 0) - 1;
    return others == 0
               ? fmt::format("refused: {}", last_)
               : fmt::format("refused: {} (and {} more)", last_, others);
  }

private:
  std::mutex mutex_;
  std::size_t count_ = 0;
  std::string last_;
};

/// @returns why somebody must not order runs.
std::optional<std::string> doubt(const credentials& own,
                                 const worker_hello& hello,
                                 const std::string& nonce) {
  const auto proved =
      own.prove(hello.certificate, proof_of_orders(nonce), hello.signature);
  if (!proved.who)
    return proved.refusal;
  if (proved.who->is_provider())
    return fmt::format("its certificate is for {}, not for a station",
                       describe(*proved.who));
  return std::nullopt;
}

void tell(refusals& refused, std::ostream& console) {
  if (const auto line = refused.take(); !line.empty())
    console << line << std::endl;
}

void wait_for_end(network_runtime& time, refusals& refused,
                  const std::atomic<bool>& interrupted, std::ostream& console) {
  constexpr auto glance = 100ms;
  constexpr auto glances_a_second = 10;
  for (int i = 0; !interrupted; ++i) {
    time.run_until(time.now() + glance);
    if (i % glances_a_second == 0)
      tell(refused, console);
  }
  tell(refused, console);
}

} // namespace

void worker(const worker_options& what, const std::atomic<bool>& interrupted,
            std::ostream& console) {
  const auto own = load_keys(what.listen, what.keys, "--listen");
  const temporary_folder home;
  const auto hands = std::make_shared<crew>(what.slots, what.run);
  const auto refused = std::make_shared<refusals>();
  std::atomic<std::uint64_t> orders = 0;
  front door{own, what.listen};
  const auto time = make_network_runtime(what.clock);
  workbench_setup setup;
  setup.program = what.program;
  setup.slots = what.slots;
  setup.make_run = [&] {
    return make_crew_run(hands, home.path() / fmt::format("{}", ++orders));
  };
  setup.draw_nonce = &draw_nonce;
  setup.doubt = [&own](const worker_hello& hello, const std::string& nonce) {
    return own ? doubt(*own, hello, nonce) : std::nullopt;
  };
  setup.on_refusal = [refused](const std::string& why) { refused->add(why); };
  const auto at =
      door.open(*time, spawn_worker_gate(time->system(), std::move(setup)),
                [refused](const std::string& why) { refused->add(why); });
  console << fmt::format("worker listens on {}{}, {} runs at a time",
                         print_address(at),
                         own ? "" : ", for this machine alone", what.slots)
          << std::endl;
  wait_for_end(*time, *refused, interrupted, console);
  hands->stop(); // what they call goes with the actors
}

} // namespace sofof

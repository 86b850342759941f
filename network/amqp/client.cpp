// Proton's container on a thread of its own, and a queue before its sender.
#include "network/amqp/client.hpp"

#include "network/amqp/proton_message.hpp"
#include "network/block_signals.hpp"
#include "network/deadline.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <proton/codec/map.hpp>
#include <proton/connection.hpp>
#include <proton/connection_options.hpp>
#include <proton/container.hpp>
#include <proton/delivery.hpp>
#include <proton/error_condition.hpp>
#include <proton/messaging_handler.hpp>
#include <proton/receiver.hpp>
#include <proton/receiver_options.hpp>
#include <proton/sender.hpp>
#include <proton/sender_options.hpp>
#include <proton/source_options.hpp>
#include <proton/symbol.hpp>
#include <proton/target_options.hpp>
#include <proton/transport.hpp>
#include <proton/work_queue.hpp>
#include <thread>
#include <utility>

namespace sofof::network::amqp {

namespace {

/// A broker or client that is silent for so long is gone.
constexpr std::chrono::milliseconds idle_timeout{5000};
/// From the first attempt's end to the next one's beginning, at least.
constexpr std::chrono::milliseconds first_pause{100};
constexpr std::chrono::milliseconds longest_pause{2000};
constexpr std::chrono::milliseconds longest_wait{100}; // for credit
constexpr std::uint32_t longest_frame_taken = 64 << 10;

/// @returns the filter under which brokers look for a selector.
proton::source_options source_of(const client_options& o) {
  proton::source_options from;
  from.address(o.address);
  if (o.selector.empty())
    return from;
  proton::source::filter_map filters;
  proton::value described;
  proton::codec::encoder out(described);
  out << proton::codec::start::described()
      << proton::symbol{"apache.org:selector-filter:string"} << o.selector
      << proton::codec::finish();
  filters.put("selector", described);
  return from.filters(filters);
}

bool proves_senders(const proton::connection& c) {
  const auto all = c.properties();
  const auto product = all.find("product");
  return product != all.end() && product->second.type() == proton::STRING
         && proton::get<std::string>(product->second) == proving_broker;
}

} // namespace

class client::state final : public proton::messaging_handler {
public:
  explicit state(client_options options) : options_{std::move(options)} {}

  void start() {
    thread_ = std::thread{[this] {
      leave_signals_to_others();
      run();
    }};
  }

  void stop() {
    {
      const std::lock_guard lock{mutex_};
      ends_ = true;
      if (container_)
        container_->stop();
    }
    ended_.notify_all();
    if (thread_.joinable())
      thread_.join();
    options_.on_message = {};
    options_.on_up = {};
    options_.on_down = {};
  }

  void send(message m) {
    const std::lock_guard lock{mutex_};
    if (!is_up_ || waiting_.size() >= options_.longest_queue) {
      ++dropped_;
      return;
    }
    waiting_.push_back({std::move(m), deadline_clock::now() + longest_wait});
    if (std::exchange(is_woken_, true))
      return;
    work_->add([this] { send_waiting(); });
  }

  bool is_up() const {
    const std::lock_guard lock{mutex_};
    return is_up_;
  }

  client_counts counts() const {
    return {sent_, received_, dropped_, unreadable_};
  }

private:
  // -- connecting -----------------------------------------------------------

  /// A container for each attempt: what a broker sends that Proton cannot
  /// decode, or a handler throws, ends it and nothing else.
  void run() {
    auto pause = first_pause;
    for (;;) {
      const auto was_up = attempt();
      pause = was_up >= longest_pause ? first_pause
                                      : std::min(2 * pause, longest_pause);
      std::unique_lock lock{mutex_};
      if (ended_.wait_for(lock, pause, [this] { return ends_.load(); }))
        return;
    }
  }

  /// @returns how long there was a connection.
  deadline::duration attempt() {
    up_since_.reset();
    why_ = "it does not answer";
    try {
      proton::container container{*this, options_.name};
      if (!takes(&container))
        return {};
      try {
        container.run();
      } catch (const std::exception& e) {
        why_ = e.what();
      }
      lose();
    } catch (const std::exception& e) { // the system has no more files, say
      why_ = e.what();
    }
    if (!ends_ && options_.on_down)
      options_.on_down(why_);
    return up_since_ ? deadline_clock::now() - *up_since_
                     : deadline::duration{};
  }

  /// @returns whether there is still something to do.
  bool takes(proton::container* one) {
    const std::lock_guard lock{mutex_};
    container_ = ends_ ? nullptr : one;
    return !ends_;
  }

  void lose() {
    const std::lock_guard lock{mutex_};
    container_ = nullptr;
    is_up_ = false;
    work_ = nullptr;
    dropped_ += waiting_.size();
    waiting_.clear();
    sender_ = {};
    opened_sender_ = {};
  }

  void on_container_start(proton::container& c) override {
    proton::connection_options how;
    how.container_id(options_.name)
        .idle_timeout(proton::duration{idle_timeout.count()})
        .max_frame_size(longest_frame_taken);
    if (!options_.host.empty())
      how.virtual_host(options_.host);
    // TLS is below, in a tunnel: what is sent here stays on this machine.
    how.sasl_allow_insecure_mechs(true);
    if (options_.user.empty())
      how.sasl_allowed_mechs(options_.external ? "EXTERNAL ANONYMOUS"
                                               : "ANONYMOUS");
    else
      how.sasl_allowed_mechs("PLAIN")
          .user(options_.user)
          .password(options_.password);
    c.connect("amqp://" + print_address(options_.where()), how);
  }

  void on_connection_open(proton::connection& c) override {
    if (options_.proving && !proves_senders(c)) {
      why_ = "it does not prove who sends a message";
      c.close();
      return;
    }
    links_ = 0;
    c.open_sender(options_.address, proton::sender_options{}.delivery_mode(
                                        proton::delivery_mode::AT_MOST_ONCE));
    auto from = source_of(options_);
    c.open_receiver(options_.address,
                    proton::receiver_options{}
                        .source(from)
                        .delivery_mode(proton::delivery_mode::AT_MOST_ONCE)
                        .credit_window(options_.credit_window));
  }

  void on_sender_open(proton::sender& s) override {
    opened_sender_ = s;
    if (++links_ == 2)
      begin();
  }
  void on_receiver_open(proton::receiver&) override {
    if (++links_ == 2)
      begin();
  }

  void begin() {
    {
      const std::lock_guard lock{mutex_};
      sender_ = opened_sender_;
      work_ = &sender_.work_queue();
      is_up_ = true;
      is_woken_ = false;
    }
    up_since_ = deadline_clock::now();
    why_ = "the connection was closed";
    if (options_.on_up)
      options_.on_up();
  }

  void on_transport_error(proton::transport& t) override {
    why_ = t.error().what();
  }
  void on_connection_error(proton::connection& c) override {
    why_ = c.error().what();
  }
  // A broker that ends a link or a session may leave its connection open.
  void on_sender_close(proton::sender& s) override { leave(s, s.error()); }
  void on_receiver_close(proton::receiver& r) override { leave(r, r.error()); }
  void on_session_close(proton::session& s) override { leave(s, s.error()); }
  void on_error(const proton::error_condition& e) override { why_ = e.what(); }

  void leave(const auto& ended, const proton::error_condition& e) {
    if (!e.empty())
      why_ = e.what();
    ended.connection().close();
  }

  // -- messages -------------------------------------------------------------

  void on_sendable(proton::sender&) override { send_waiting(); }

  void send_waiting() {
    const std::lock_guard lock{mutex_};
    is_woken_ = false;
    const auto now = deadline_clock::now();
    while (is_up_ && !waiting_.empty()) {
      if (waiting_.front().gives_up < now) {
        ++dropped_;
      } else if (sender_.credit() > 0) {
        sender_.send(to_proton(waiting_.front().what));
        ++sent_;
      } else {
        return; // on_sendable comes
      }
      waiting_.pop_front();
    }
  }

  void on_message(proton::delivery&, proton::message& m) override {
    if (ends_)
      return;
    auto ours = from_proton(m);
    if (!ours) {
      ++unreadable_;
      return;
    }
    ++received_;
    options_.on_message(std::move(*ours));
  }

  struct waiting_message {
    message what;
    deadline gives_up;
  };

  client_options options_;
  // Of the client's thread:
  std::string why_;
  std::optional<deadline> up_since_;
  int links_ = 0; // that the broker has opened, too
  proton::sender opened_sender_;
  mutable std::mutex mutex_; // of the following
  std::condition_variable ended_;
  proton::container* container_ = nullptr;
  proton::work_queue* work_ = nullptr;
  bool is_up_ = false;
  bool is_woken_ = false; // the client's thread will send
  std::deque<waiting_message> waiting_;
  proton::sender sender_;
  // Anybody's:
  std::atomic<bool> ends_ = false;
  std::atomic<std::uint64_t> sent_ = 0, received_ = 0, dropped_ = 0,
                             unreadable_ = 0;
  std::thread thread_;
};

client::client(client_options options)
    : state_{std::make_shared<state>(std::move(options))} {}

client::~client() {
  state_->stop();
}

void client::stop() {
  state_->stop();
}

void client::start() {
  state_->start();
}

void client::send(message m) {
  state_->send(std::move(m));
}

bool client::is_up() const {
  return state_->is_up();
}

client_counts client::counts() const {
  return state_->counts();
}

} // namespace sofof::network::amqp

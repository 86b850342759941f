// Peers of a broker, for tests/acceptance/wires: one that only listens, a
// hundred stations with their provider, and one that lies.
//
//   amqp_peer listen PORT SELECTOR SECONDS FOLDER
//   amqp_peer load PORT SECONDS [CARS_KEYS PROVIDER_KEYS]
//   amqp_peer lie PORT COUNT KEYS
#include "network/amqp/client.hpp"
#include "network/keys/credentials.hpp"
#include "network/tls/tls_connector.hpp"
#include "tests/support/dice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <arpa/inet.h>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <netinet/in.h>
#include <proton/codec/encoder.hpp>
#include <proton/connection.hpp>
#include <proton/connection_options.hpp>
#include <proton/container.hpp>
#include <proton/delivery.hpp>
#include <proton/message.hpp>
#include <proton/messaging_handler.hpp>
#include <proton/receiver.hpp>
#include <proton/receiver_options.hpp>
#include <proton/source_options.hpp>
#include <proton/symbol.hpp>
#include <proton/work_queue.hpp>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace {

using namespace sofof;
using namespace std::chrono_literals;
using network::amqp::message;
using wall = std::chrono::system_clock;

double now_ms() {
  return std::chrono::duration<double, std::milli>(
             wall::now().time_since_epoch())
      .count();
}

// -- one that only listens, with nothing of ours ------------------------------

class listener final : public proton::messaging_handler {
public:
  listener(std::string url, std::string selector, double seconds,
           std::string folder)
      : url_{std::move(url)}, selector_{std::move(selector)}, seconds_{seconds},
        folder_{std::move(folder)} {}

  void on_container_start(proton::container& c) override {
    c.connect(url_,
              proton::connection_options{}.sasl_allowed_mechs("ANONYMOUS"));
    c.schedule(proton::duration{static_cast<std::int64_t>(1e3 * seconds_)},
               [this] { connection_.close(); });
  }
  // It ends when its connection does, however that does.
  void on_error(const proton::error_condition&) override {}
  void on_connection_open(proton::connection& c) override {
    connection_ = c;
    proton::source::filter_map filters;
    proton::value described;
    proton::codec::encoder out(described);
    out << proton::codec::start::described()
        << proton::symbol{"apache.org:selector-filter:string"} << selector_
        << proton::codec::finish();
    filters.put("selector", described);
    proton::source_options from;
    from.filters(filters);
    c.open_receiver("etsi",
                    proton::receiver_options{}.source(from).credit_window(5));
  }
  void on_message(proton::delivery&, proton::message& m) override {
    const auto text = [&](const char* name) {
      return m.properties().exists(name)
                 ? proton::to_string(m.properties().get(name))
                 : std::string{"none"};
    };
    ++counts_[fmt::format("{} mid {} station {}", m.subject(), text("mid"),
                          text("station_id"))];
    if (m.body().type() != proton::BINARY)
      return;
    std::ofstream out{folder_ + "/" + m.subject() + ".hex", std::ios::app};
    for (const auto b : proton::get<proton::binary>(m.body()))
      out << fmt::format("{:02x}", b);
    out << '\n';
  }
  void tell() const {
    for (const auto& [what, count] : counts_)
      fmt::print("{} {}\n", what, count);
  }

private:
  std::string url_, selector_;
  double seconds_;
  std::string folder_;
  proton::connection connection_;
  std::map<std::string, int> counts_;
};

// -- a hundred stations and their provider
// -------------------------------------

/// A client, through TLS if it has keys, and what comes to it.
class peer {
public:
  peer(std::uint16_t port, const std::string& keys, const std::string& selector,
       std::chrono::milliseconds reads_for = 0ms, bool takes_all = false) {
    static int number = 0;
    if (!keys.empty()) {
      const network::credentials own{keys};
      user = network::describe(own.identity());
      tunnel_ = std::make_unique<network::tls_connector>(
          &own,
          network::connector_options{.remote = {"127.0.0.1", port},
                                     .provider = "broker",
                                     .service = network::tls_service::broker,
                                     .idle = 6000ms});
    }
    network::amqp::client_options how;
    how.where = [at = tunnel_ ? tunnel_->port() : port] {
      return network::network_address{"127.0.0.1", at};
    };
    how.name = fmt::format("peer-{}-{}", getpid(), ++number);
    how.selector = selector;
    how.longest_queue = 100'000;
    how.on_message = [this, reads_for, takes_all](const message& m) {
      note(m, takes_all);
      std::this_thread::sleep_for(reads_for);
    };
    client_ = std::make_unique<network::amqp::client>(std::move(how));
    client_->start();
  }
  ~peer() { client_->stop(); }

  void send(std::uint16_t mid, std::uint32_t station, std::size_t size,
            std::optional<std::uint32_t> to = {}, bool counts = true) const {
    message m;
    m.user = user;
    m.subject = mid == 0 ? "sofof" : "its";
    m.created = std::chrono::floor<std::chrono::milliseconds>(
        wall::now().time_since_epoch());
    m.ttl = mid == 2049 ? 100ms : 1000ms;
    m.all = {
        {"station_id", station}, {"sent_ms", now_ms()}, {"counts", counts}};
    if (mid != 0)
      m.all.emplace("mid", mid);
    if (to)
      m.all.emplace("destination_station_id", *to);
    m.body.assign(size, std::byte{0});
    for (std::size_t i = 0; i < 4; ++i)
      m.body[2 + i] = static_cast<std::byte>(station >> (24 - 8 * i) & 0xff);
    client_->send(std::move(m));
  }
  void send(message m) const { client_->send(std::move(m)); }

  bool is_up() const { return client_->is_up(); }
  network::amqp::client_counts counts() const { return client_->counts(); }
  std::vector<double> latencies() const {
    const std::lock_guard lock{mutex_};
    return latencies_ms_;
  }

  std::string user;
  std::atomic<std::uint64_t> too_old = 0;

private:
  void note(const message& m, bool takes_all) {
    const auto* sent = network::amqp::find<double>(m.all, "sent_ms");
    const auto* counts = network::amqp::find<bool>(m.all, "counts");
    if (!sent || !counts || (!*counts && !takes_all))
      return;
    const auto age = now_ms() - *sent;
    if (age > static_cast<double>(m.ttl.count()) + 100)
      ++too_old;
    const std::lock_guard lock{mutex_};
    latencies_ms_.push_back(age);
  }

  std::unique_ptr<network::tls_connector> tunnel_;
  mutable std::mutex mutex_;
  std::vector<double> latencies_ms_;
  std::unique_ptr<network::amqp::client> client_;
};

bool wait_for(const std::vector<const peer*>& all) {
  for (int i = 0; i < 500; ++i) {
    if (std::ranges::all_of(all, [](const auto* x) { return x->is_up(); }))
      return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

/// CAM, CPM and MCM of each station at 10 Hz and clocks at 2 Hz to the
/// provider; MCMs at 20 Hz to each station.
int load(std::uint16_t port, double seconds, const std::string& cars_keys,
         const std::string& provider_keys) {
  constexpr std::uint32_t stations = 100, first = 101, mec = 900'000'001;
  peer provider{port, provider_keys,
                fmt::format("(destination_station_id IS NULL OR "
                            "destination_station_id = {0}) AND "
                            "NOT(station_id = {0})",
                            mec)};
  peer cars{port, cars_keys,
            fmt::format("destination_station_id BETWEEN {} AND {}", first,
                        first + stations - 1)};
  peer slow{port, cars_keys, "mid = 2050", 4ms, true}; // 250 of 1000 a second
  if (!wait_for({&provider, &cars, &slow}))
    return 1;
  std::uint64_t counted = 0;
  auto next = std::chrono::steady_clock::now();
  const auto turns = static_cast<int>(seconds * 100);
  for (int turn = 0; turn < turns; ++turn) { // 10 ms each
    const bool counts = turn >= 100;         // after the first second
    for (std::uint32_t k = 0; k < 10; ++k) {
      const auto station =
          first + static_cast<std::uint32_t>(turn % 10) * 10 + k;
      cars.send(2050, station, 92, {}, counts);
      cars.send(2049, station, 150, {}, counts);
      cars.send(2052, station, 440, mec, counts);
      counted += counts ? 3 : 0;
    }
    if (turn % 50 == 0)
      cars.send(0, first, 40, mec, counts), counted += counts ? 1 : 0;
    for (std::uint32_t k = 0; k < 20; ++k) {
      const auto to = first + static_cast<std::uint32_t>(turn % 5) * 20 + k;
      provider.send(2052, mec, 440, to, counts);
      counted += counts ? 1 : 0;
    }
    next += 10ms;
    std::this_thread::sleep_until(next);
  }
  std::this_thread::sleep_for(1500ms);
  auto all = provider.latencies();
  const auto down = cars.latencies();
  all.insert(all.end(), down.begin(), down.end());
  std::ranges::sort(all);
  const auto at = [&](double share) {
    return all.empty() ? -1.0
                       : all[static_cast<std::size_t>(
                           share * static_cast<double>(all.size() - 1))];
  };
  fmt::print("sent {} lost {} p50 {:.2f} p99 {:.2f} max {:.2f} slow_got {} "
             "slow_too_old {}\n",
             counted,
             static_cast<std::int64_t>(counted)
                 - static_cast<std::int64_t>(all.size()),
             at(0.5), at(0.99), at(1), slow.latencies().size(),
             slow.too_old.load());
  return 0;
}

// -- one that lies
// ---------------------------------------------------------------

/// Octets at the broker's door, most of them nearly AMQP.
void knock_with_nonsense(std::uint16_t port, int count) {
  constexpr unsigned char head[] = {'A', 'M', 'Q', 'P', 0, 1, 0, 0};
  test::dice dice{7};
  const auto below = [&](int n) {
    return static_cast<int>(dice.between(0, n));
  };
  for (int done = 0; done < count;) {
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) {
      close(fd);
      return;
    }
    std::string octets{reinterpret_cast<const char*>(head), sizeof head};
    for (int frames = 1 + below(200); frames > 0 && done < count;
         --frames, ++done) {
      const auto size = 8 + below(48);
      std::string frame(static_cast<std::size_t>(size), '\0');
      frame[3] = static_cast<char>(below(8) ? size : below(256));
      frame[4] = static_cast<char>(below(8) ? 2 : below(256)); // data offset
      const char performatives[] = {0x00, 0x53,
                                    static_cast<char>(0x10 + below(10))};
      for (int i = 0; i < size - 8; ++i)
        frame[static_cast<std::size_t>(8 + i)] =
            i < 3 ? performatives[i] : static_cast<char>(below(256));
      octets += frame;
    }
    static_cast<void>(send(fd, octets.data(), octets.size(), MSG_NOSIGNAL));
    close(fd);
  }
}

/// As somebody certified for station 101: in others' names, for other stations,
/// with others' messages inside, from long ago, and far too much.
int lie(std::uint16_t port, int count, const std::string& keys) {
  peer liar{port, keys, "mid = 1"};
  if (!wait_for({&liar}))
    return 1;
  auto lie = [&](const std::string& user, std::uint32_t station,
                 std::uint32_t inside, std::chrono::milliseconds age = 0ms) {
    message m;
    m.user = user;
    m.subject = "cam";
    m.created = std::chrono::floor<std::chrono::milliseconds>(
        wall::now().time_since_epoch() - age);
    m.ttl = 1000ms;
    m.all = {{"station_id", station}, {"mid", std::uint16_t{2050}}};
    m.body.assign(92, std::byte{0});
    m.body[0] = m.body[1] = std::byte{2};
    for (std::size_t i = 0; i < 4; ++i)
      m.body[2 + i] = static_cast<std::byte>(inside >> (24 - 8 * i) & 0xff);
    liar.send(std::move(m));
  };
  for (int i = 0; i < 300; ++i) {
    lie(liar.user, 102, 102);
    lie("station 102", 102, 102);
    lie(liar.user, 101, 102);
    lie("stations 101-200", 112, 112, 5s); // as it was heard
    std::this_thread::sleep_for(5ms);
  }
  for (int i = 0; i < 20'000; ++i)
    lie(liar.user, 102, 102);
  knock_with_nonsense(port, count);
  std::this_thread::sleep_for(500ms);
  fmt::print("sent {}\n", liar.counts().sent);
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 3)
    return 2;
  const auto port = static_cast<std::uint16_t>(std::stoi(words[1]));
  if (words[0] == "listen" && words.size() == 5) {
    listener one{"amqp://127.0.0.1:" + words[1], words[2], std::stod(words[3]),
                 words[4]};
    proton::container{one}.run();
    one.tell();
    return 0;
  }
  if (words[0] == "load")
    return load(port, std::stod(words[2]), words.size() > 3 ? words[3] : "",
                words.size() > 4 ? words[4] : "");
  if (words[0] == "lie" && words.size() == 4)
    return lie(port, std::stoi(words[2]), words[3]);
  return 2;
}

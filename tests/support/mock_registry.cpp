// A registry of services as ETSI GS MEC 011 v2.2.1 describes it: one connection
// after the other, a question each.
#include "tests/support/mock_registry.hpp"

#include "messages/protocol/remote.hpp"
#include "network/mec/service_info.hpp"
#include "network/socket.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <list>
#include <map>
#include <mutex>
#include <poll.h>
#include <set>
#include <string_view>
#include <sys/socket.h>
#include <thread>
#include <utility>

namespace sofof::test {

namespace {

using nlohmann::json;

constexpr std::string_view base = "/mep";
constexpr std::string_view known_application = "sofof-mec";

struct asked_of_registry {
  std::string method, path, query, body;
};

struct told_by_registry {
  int status = 200;
  std::string body{};
  std::string location{};
};

told_by_registry problem(int status, const std::string& detail) {
  return {status, json{{"status", status}, {"detail", detail}}.dump(), {}};
}

/// @returns what is missing in a ServiceInfoPost, or is of none of its values.
std::string fault_in_service(const json& x) {
  const auto lacks = [](const json& of,
                        std::initializer_list<const char*> all) -> std::string {
    for (const auto* name : all)
      if (!of.is_object() || !of.contains(name))
        return std::string{name} + " is missing";
    return {};
  };
  const auto is_one_of = [](const json& value,
                            const std::set<std::string>& of) {
    return value.is_string() && of.contains(value.get<std::string>());
  };
  auto fault =
      lacks(x, {"serName", "version", "state", "serializer", "transportInfo"});
  if (!fault.empty())
    return fault;
  if (!is_one_of(x["state"], {"ACTIVE", "INACTIVE"})
      || !is_one_of(x["serializer"], {"JSON", "XML", "PROTOBUF3"})
      || (x.contains("scopeOfLocality")
          && !is_one_of(x["scopeOfLocality"],
                        {"MEC_SYSTEM", "MEC_HOST", "NFVI_POP", "ZONE",
                         "ZONE_GROUP", "NFVI_NODE"})))
    return "a value that the enumeration does not have";
  const auto& transport = x["transportInfo"];
  fault = lacks(transport, {"id", "name", "type", "protocol", "version",
                            "endpoint", "security"});
  if (!fault.empty())
    return fault;
  if (!is_one_of(transport["type"],
                 {"REST_HTTP", "MB_TOPIC_BASED", "MB_ROUTING", "MB_PUBSUB",
                  "RPC", "RPC_STREAMING", "WEBSOCKET"}))
    return "type is no TransportType";
  const auto& endpoint = transport["endpoint"];
  if (!endpoint.is_object()
      || endpoint.contains("uris") + endpoint.contains("addresses")
                 + endpoint.contains("alternative")
             != 1)
    return "endpoint is not one of its three kinds";
  return {};
}

/// Reads a question from a connection, which does not block; nothing when it
/// ends.
asked_of_registry read_question(const descriptor& from) {
  std::string text;
  std::size_t size = 0, head = text.npos;
  while (head == text.npos || text.size() < head + 4 + size) {
    constexpr int patience_ms = 5000;
    pollfd ready{from.get(), POLLIN, 0};
    if (poll(&ready, 1, patience_ms) != 1)
      return {};
    std::array<char, 4096> some{};
    const auto got = recv(from.get(), some.data(), some.size(), 0);
    if (got <= 0)
      return {};
    text.append(some.data(), static_cast<std::size_t>(got));
    head = text.find("\r\n\r\n");
    static constexpr std::string_view length = "Content-Length: ";
    if (const auto at = text.find(length); at < head)
      std::from_chars(text.data() + at + length.size(),
                      text.data() + text.size(), size);
  }
  asked_of_registry x;
  const auto first = text.find(' '), second = text.find(' ', first + 1);
  x.method = text.substr(0, first);
  x.path = text.substr(first + 1, second - first - 1);
  if (const auto at = x.path.find('?'); at != x.path.npos) {
    x.query = x.path.substr(at + 1);
    x.path.resize(at);
  }
  x.body = text.substr(head + 4);
  return x;
}

void write_answer(const descriptor& to, const told_by_registry& x) {
  const auto text = fmt::format(
      "HTTP/1.1 {} x\r\nContent-Type: application/json\r\n{}{}Connection: "
      "close\r\n\r\n{}",
      x.status,
      x.location.empty() ? "" : fmt::format("Location: {}\r\n", x.location),
      x.status == 204 ? ""
                      : fmt::format("Content-Length: {}\r\n", x.body.size()),
      x.body);
  std::string_view left = text;
  while (!left.empty()) {
    constexpr int patience_ms = 1000;
    pollfd ready{to.get(), POLLOUT, 0};
    if (poll(&ready, 1, patience_ms) != 1)
      return;
    const auto sent = send(to.get(), left.data(), left.size(), MSG_NOSIGNAL);
    if (sent <= 0)
      return;
    left.remove_prefix(static_cast<std::size_t>(sent));
  }
}

} // namespace

class mock_registry::state {
public:
  explicit state(std::uint16_t port)
      : listener_{network::listen_at({"127.0.0.1", port})}, thread_{[this] {
          run();
        }} {}
  ~state() {
    stops_ = true;
    wake_.call();
    thread_.join();
  }

  std::uint16_t port() const { return network::port_of(listener_); }

  mutable std::mutex mutex; // guards
  registry_mood mood = registry_mood::well;
  std::map<std::string, json> services; // by id
  std::vector<std::string> asked;
  int count = 0;

private:
  void run() {
    for (;;) {
      std::array<pollfd, 2> events{
          {{wake_.fd(), POLLIN, 0}, {listener_.get(), POLLIN, 0}}};
      poll(events.data(), events.size(), -1);
      if (stops_)
        return;
      auto accepted = network::accept_from(listener_);
      if (!accepted.socket)
        continue;
      const auto question = read_question(accepted.socket);
      const std::lock_guard lock{mutex};
      if (question.method.empty())
        continue;
      if (mood == registry_mood::silent) {
        mute_.push_back(std::move(accepted.socket));
        continue;
      }
      const auto answer = in_this_mood(question);
      asked.push_back(fmt::format("{} {} {}", question.method, question.path,
                                  answer.status));
      write_answer(accepted.socket, answer);
    }
  }

  told_by_registry in_this_mood(const asked_of_registry& x) {
    constexpr std::size_t very_long = 16U << 20;
    switch (mood) {
      case registry_mood::garbage:
        return {200, "<html>\xff\xfe", {}};
      case registry_mood::huge:
        return {200, '[' + std::string(very_long, ' ') + ']', {}};
      case registry_mood::crowded: {
        auto all = json::array();
        for (int i = 0; i < 10'000; ++i)
          all.push_back({{"serName", "sofof"}});
        return {200, all.dump(), {}};
      }
      case registry_mood::redirects:
        return {302, "", "http://127.0.0.1:1/"};
      case registry_mood::broken:
        return problem(500, "no disk\x1b[2J");
      case registry_mood::immutable:
        if (x.method == "PUT")
          return problem(403, "not changed");
        break;
      default:
        break;
    }
    return as_it_should(x);
  }

  told_by_registry as_it_should(const asked_of_registry& x) {
    const auto all = fmt::format("{}/mec_service_mgmt/v1/services", base);
    const auto ours = fmt::format("{}/mec_service_mgmt/v1/applications/{}/"
                                  "services",
                                  base, known_application);
    const auto ready = fmt::format("{}/mec_app_support/v1/applications/{}/"
                                   "confirm_ready",
                                   base, known_application);
    if (x.method == "GET" && (x.path == all || x.path == ours))
      return {200, found(x.query).dump(), {}};
    if (x.method == "POST" && x.path == ours)
      return add(x, ours);
    if (x.method == "POST" && x.path == ready)
      return json::parse(x.body, nullptr, false)
                     == json{{"indication", "READY"}}
                 ? told_by_registry{204}
                 : problem(400, "no AppReadyConfirmation");
    if (!x.path.starts_with(ours + '/'))
      return problem(404, "no such resource");
    const auto at = services.find(x.path.substr(ours.size() + 1));
    if (at == services.end())
      return problem(404, "no such service");
    if (x.method == "DELETE") {
      services.erase(at);
      return {204};
    }
    return x.method == "PUT" ? change(at->second, x)
                             : told_by_registry{200, at->second.dump(), {}};
  }

  json found(const std::string& query) const {
    auto list = json::array();
    for (const auto& [id, x] : services)
      if (query == "ser_name=" + x.value("serName", ""))
        list.push_back(x);
    return list;
  }

  told_by_registry add(const asked_of_registry& x, const std::string& ours) {
    auto service = json::parse(x.body, nullptr, false);
    if (auto fault = fault_in_service(service); !fault.empty())
      return problem(400, fault);
    if (service.contains("serInstanceId"))
      return problem(400, "serInstanceId is chosen here");
    const auto id = fmt::format("s-{}", ++count);
    service["serInstanceId"] = id;
    services[id] = service;
    return {201, service.dump(), "http://mep.example" + ours + '/' + id};
  }

  /// As AdvantEDGE has it: nothing but the state may change.
  static told_by_registry change(json& was, const asked_of_registry& x) {
    auto fresh = json::parse(x.body, nullptr, false);
    if (auto fault = fault_in_service(fresh); !fault.empty())
      return problem(400, fault);
    auto rest = fresh;
    rest["state"] = was["state"];
    if (rest != was)
      return problem(400, "only the state may be changed");
    was = fresh;
    return {200, was.dump(), {}};
  }

  descriptor listener_;
  network::wake_up wake_;
  std::atomic<bool> stops_ = false;
  std::list<descriptor> mute_;
  std::thread thread_;
};

mock_registry::mock_registry(std::uint16_t port)
    : state_{std::make_unique<state>(port)} {}
mock_registry::~mock_registry() = default;

network::network_address mock_registry::address() const {
  return {"127.0.0.1", state_->port()};
}

std::string mock_registry::root() const {
  return "http://" + network::print_address(address()) + std::string{base};
}

void mock_registry::be(registry_mood mood) {
  const std::lock_guard lock{state_->mutex};
  state_->mood = mood;
}

std::string mock_registry::list(json service) {
  const std::lock_guard lock{state_->mutex};
  auto id = fmt::format("s-{}", ++state_->count);
  service["serInstanceId"] = id;
  state_->services[id] = std::move(service);
  return id;
}

void mock_registry::forget() {
  const std::lock_guard lock{state_->mutex};
  state_->services.clear();
}

std::vector<json> mock_registry::services() const {
  const std::lock_guard lock{state_->mutex};
  std::vector<json> all;
  for (const auto& [id, x] : state_->services)
    all.push_back(x);
  return all;
}

std::vector<std::string> mock_registry::asked() const {
  const std::lock_guard lock{state_->mutex};
  return state_->asked;
}

std::size_t mock_registry::times(const std::string& question) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      asked(), [&](const auto& x) { return x.find(question) != x.npos; }));
}

json service_of(const std::string& provider, std::uint16_t port) {
  return json::parse(network::mec011::to_json(
      {.version = std::to_string(messages::remote_protocol),
       .provider = provider,
       .is_secured = false,
       .addresses = {{"127.0.0.1", port}}}));
}

} // namespace sofof::test

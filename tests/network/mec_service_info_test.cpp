// What registries say of providers, as they should and as they should not.
#include "network/mec/service_info.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sofof::test::registry_documents {

using namespace network;
using namespace network::mec011;
using nlohmann::json;

namespace {

const service_info example{
    .id = "a-1",
    .version = "10",
    .is_active = false,
    .provider = "mec",
    .is_secured = true,
    .addresses = {{"edge.example", 4711}, {"fd00::5", 1}, {"10.0.0.5", 65535}}};

/// @returns what is wrong with a document; empty: nothing.
std::string fault_of(const json& x) {
  const auto read = read_service(x.dump());
  const auto* why = std::get_if<std::string>(&read);
  return why ? *why : "";
}

/// @returns the example with another value, or without one if it is discarded.
json with(const std::string& pointer, json value) {
  auto x = json::parse(to_json(example));
  x[json::json_pointer{pointer}] = std::move(value);
  return x;
}
json without(const std::string& parent, const std::string& name) {
  auto x = json::parse(to_json(example));
  x[json::json_pointer{parent}].erase(name);
  return x;
}

/// Whatever was read is within its bounds, and may be told again.
void check_bounds(const service_info& x) {
  REQUIRE(is_plain_name(x.id));
  REQUIRE(x.provider.size() <= longest_name);
  REQUIRE(x.version.size() <= longest_name);
  REQUIRE(!x.addresses.empty());
  REQUIRE(x.addresses.size() <= most_addresses);
  for (const auto& at : x.addresses) {
    REQUIRE(at.port > 0);
    REQUIRE(parse_address(print_address(at)) == at);
  }
  const auto again = read_service(to_json(x));
  REQUIRE(std::get<service_info>(again) == x);
}

} // namespace

TEST_CASE("what is told of a provider is read as it was") {
  CHECK(std::get<service_info>(read_service(to_json(example))) == example);
  const auto list = read_services('[' + to_json(example) + ']');
  CHECK(std::get<service_list>(list).services
        == std::vector<service_info>{example});
}

TEST_CASE("a ServiceInfo has what the standard requires, and its own words") {
  const auto x = json::parse(to_json(example));
  CHECK(x["serName"] == "sofof");
  CHECK(x["state"] == "INACTIVE");
  CHECK(x["serializer"] == "JSON");
  CHECK(x["consumedLocalOnly"] == false);
  const auto& transport = x["transportInfo"];
  for (const auto* name :
       {"id", "name", "type", "protocol", "version", "endpoint", "security"})
    CHECK(transport.contains(name));
  CHECK(transport["type"] == "RPC_STREAMING");
  CHECK(transport["endpoint"]["addresses"][0]
        == json{{"host", "edge.example"}, {"port", 4711}});
  auto fresh = example;
  fresh.id.clear();
  CHECK(!json::parse(to_json(fresh)).contains("serInstanceId"));
}

TEST_CASE("what is missing, of another type or out of its range is named") {
  const std::string addresses = "/transportInfo/endpoint/addresses";
  const std::vector<std::pair<json, std::string>> all = {
      {json::array(), "no object"},
      {without("", "state"), "state is missing"},
      {without("", "serInstanceId"), "serInstanceId is missing"},
      {without("", "transportInfo"), "transportInfo is missing"},
      {without("/transportInfo", "implSpecificInfo"), "is missing"},
      {without("/transportInfo/endpoint", "addresses"), "addresses is missing"},
      {with("/serName", "rnis"), "serName is not sofof"},
      {with("/state", "ON"), "neither ACTIVE nor INACTIVE"},
      {with("/state", 1), "state is no text"},
      {with("/version", ""), "0 characters"},
      {with("/version", std::string(129, '1')), "129 characters"},
      {with("/serInstanceId", "../x"), "other characters"},
      {with("/serInstanceId", ".."), "other characters"},
      {with("/transportInfo", "x"), "transportInfo is no object"},
      {with("/transportInfo/implSpecificInfo/tls", "no"), "neither true"},
      {with("/transportInfo/implSpecificInfo/provider", nullptr), "no text"},
      {with(addresses, json::array()), "no list of 1 to 8"},
      {with(addresses, json::array({1, 2, 3, 4, 5, 6, 7, 8, 9})), "1 to 8"},
      {with(addresses + "/0", "10.0.0.5:1"), "address is no object"},
      {with(addresses + "/0/port", 0), "from 1 to 65535"},
      {with(addresses + "/0/port", 65536), "from 1 to 65535"},
      {with(addresses + "/0/port", -1), "from 1 to 65535"},
      {with(addresses + "/0/port", 1.5), "from 1 to 65535"},
      {with(addresses + "/0/port", "80"), "from 1 to 65535"},
      {with(addresses + "/0/port", ~std::uint64_t{0}), "from 1 to 65535"},
      {with(addresses + "/0/host", "a b"), "neither a name nor an address"},
      {with(addresses + "/0/host", "a/b"), "neither a name nor an address"},
      {with(addresses + "/0/host", "a\nb"), "neither a name nor an address"},
      {with(addresses + "/0/host", "0.0.0.0"), "leads nowhere"},
      {with(addresses + "/0/host", "::"), "leads nowhere"}};
  for (const auto& [document, why] : all) {
    CAPTURE(document.dump());
    CAPTURE(fault_of(document));
    CHECK(contains(fault_of(document), why));
  }
  CHECK(fault_of(json::parse(to_json(example))) == "");
}

TEST_CASE("what a registry adds for others disturbs nobody") {
  auto x = with("/isLocal", true);
  x["_links"] = {{"self", {{"href", "x"}}}};
  x["transportInfo"]["endpoint"]["uris"] = nullptr;
  CHECK(fault_of(x) == "");
}

TEST_CASE("of a list strangers and the broken are left out, and no others") {
  auto list = json::array({with("/serName", "rnis"),
                           {{"serName", 7}},
                           with("/state", "ON"),
                           json::parse(to_json(example))});
  const auto read = std::get<service_list>(read_services(list.dump()));
  CHECK(read.services == std::vector<service_info>{example});
  CHECK(read.why_not_all == "state is neither ACTIVE nor INACTIVE");
  CHECK(std::get<service_list>(read_services("[]")).services.empty());
}

TEST_CASE("a list that is none, too long or no JSON is refused") {
  const auto fault = [](const std::string& text) {
    const auto read = read_services(text);
    const auto* why = std::get_if<std::string>(&read);
    return why ? *why : "";
  };
  CHECK(fault("") == "it is no JSON");
  CHECK(fault("{}") == "it is no list");
  CHECK(fault("[1]") == "it lists what is no object");
  CHECK(contains(fault("[" + std::string(longest_document, ' ') + "]"),
                 "octets, more than 262144"));
  CHECK(contains(fault(std::string(200'000, '[')), "no JSON"));
  CHECK(contains(fault(std::string(100'000, '[') + std::string(100'000, ']')),
                 "no object"));
  CHECK(contains(fault(json(std::vector<json>(257, json::object())).dump()),
                 "257 services, more than 256"));
}

TEST_CASE("a problem is told in its own words, or not at all") {
  CHECK(read_problem(R"({"detail":"no such application","status":404})")
        == "no such application");
  for (const auto* nothing : {"", "x", "[]", "{}", R"({"detail":1})"})
    CHECK(read_problem(nothing) == "");
}

TEST_CASE("mutated answers are read within their bounds or refused") {
  constexpr int attempts = 100'000;
  dice random{11};
  const auto whole =
      '[' + to_json(example) + ',' + with("/state", "ACTIVE").dump() + ']';
  const std::string alphabet = "{}[]\",:0123456789-.eE\\u\xff\x80 \n/aAct";
  std::size_t read = 0, refused = 0;
  for (int i = 0; i < attempts; ++i) {
    auto text = whole;
    const auto changes = 1 + static_cast<int>(random.between(0, 4));
    for (int k = 0; k < changes && !text.empty(); ++k) {
      const auto at = static_cast<std::size_t>(
          random.between(0, static_cast<double>(text.size())));
      const auto c = alphabet[static_cast<std::size_t>(
          random.between(0, static_cast<double>(alphabet.size())))];
      const auto what = random.between(0, 4);
      if (what < 2)
        text[at] = c;
      else if (what < 3)
        text.insert(at, 1, c);
      else
        text.erase(at, static_cast<std::size_t>(random.between(1, 20)));
    }
    const auto answer = read_services(text);
    if (const auto* list = std::get_if<service_list>(&answer)) {
      ++read;
      for (const auto& x : list->services)
        check_bounds(x);
    } else {
      ++refused;
      REQUIRE(!std::get<std::string>(answer).empty());
    }
  }
  CHECK(read > attempts / 20);
  CHECK(refused > attempts / 20);
}

} // namespace sofof::test::registry_documents

// JSON of a registry, read with mistrust.
#include "network/mec/service_info.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace sofof::network::mec011 {

namespace {

using nlohmann::json;

/// What is wrong with a document.
struct flaw {
  std::string sentence;
};

constexpr bool is_alphanumeric(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')
         || (c >= '0' && c <= '9');
}

/// @returns whether all characters are letters, digits, or one of `more`.
bool consists_of(std::string_view text, std::string_view more) {
  return std::ranges::all_of(text, [&](char c) {
    return is_alphanumeric(c) || more.find(c) != more.npos;
  });
}

const json& member(const json& of, const char* name) {
  const auto found = of.find(name);
  if (found == of.end())
    throw flaw{fmt::format("{} is missing", name)};
  return *found;
}

const json& object_in(const json& of, const char* name) {
  const auto& x = member(of, name);
  if (!x.is_object())
    throw flaw{fmt::format("{} is no object", name)};
  return x;
}

/// @returns a text that is not empty, nor too long.
const std::string& text_in(const json& of, const char* name) {
  const auto& x = member(of, name);
  if (!x.is_string())
    throw flaw{fmt::format("{} is no text", name)};
  const auto& text = x.get_ref<const std::string&>();
  if (text.empty() || text.size() > longest_name)
    throw flaw{fmt::format("{} has {} characters, not 1 to {}", name,
                           text.size(), longest_name)};
  return text;
}

network_address read_address(const json& from) {
  if (!from.is_object())
    throw flaw{"an address is no object"};
  const auto& host = text_in(from, "host");
  const auto& port = member(from, "port");
  if (!port.is_number_integer() || port < 1
      || port > std::numeric_limits<std::uint16_t>::max())
    throw flaw{"a port is no number from 1 to 65535"};
  network_address at{host, port.get<std::uint16_t>()};
  if (!is_host(host) || parse_address(print_address(at)) != at)
    throw flaw{"a host is neither a name nor an address"};
  if (is_anywhere(host))
    throw flaw{fmt::format("host {} leads nowhere", host)};
  return at;
}

std::vector<network_address> read_addresses(const json& endpoint) {
  const auto& all = member(endpoint, "addresses");
  if (!all.is_array() || all.empty() || all.size() > most_addresses)
    throw flaw{fmt::format("addresses are no list of 1 to {}", most_addresses)};
  std::vector<network_address> read;
  for (const auto& x : all)
    read.push_back(read_address(x));
  return read;
}

bool read_state(const json& from) {
  const auto& state = text_in(from, "state");
  if (state != "ACTIVE" && state != "INACTIVE")
    throw flaw{"state is neither ACTIVE nor INACTIVE"};
  return state == "ACTIVE";
}

/// @param from  An object.
service_info read_info(const json& from) {
  service_info read;
  if (text_in(from, "serName") != service_name)
    throw flaw{fmt::format("serName is not {}", service_name)};
  read.id = text_in(from, "serInstanceId");
  if (!is_plain_name(read.id))
    throw flaw{"serInstanceId has other characters than letters, digits and "
               "-._~"};
  read.version = text_in(from, "version");
  read.is_active = read_state(from);
  const auto& transport = object_in(from, "transportInfo");
  const auto& ours = object_in(transport, "implSpecificInfo");
  read.provider = text_in(ours, "provider");
  const auto& secured = member(ours, "tls");
  if (!secured.is_boolean())
    throw flaw{"tls is neither true nor false"};
  read.is_secured = secured.get<bool>();
  read.addresses = read_addresses(object_in(transport, "endpoint"));
  return read;
}

/// @returns a document, or throws flaw.
json parse(std::string_view text) {
  if (text.size() > longest_document)
    throw flaw{fmt::format("it has {} octets, more than {}", text.size(),
                           longest_document)};
  auto document = json::parse(text, nullptr, false);
  if (document.is_discarded())
    throw flaw{"it is no JSON"};
  return document;
}

/// @returns whether an entry says that it is one of ours.
bool is_of_ours(const json& x) {
  const auto name = x.find("serName");
  return name != x.end() && *name == service_name;
}

} // namespace

bool is_plain_name(std::string_view text) {
  return !text.empty() && text.size() <= longest_name && text != "."
         && text != ".." && consists_of(text, "-._~");
}

bool is_host(std::string_view text) {
  return !text.empty() && consists_of(text, "-._:");
}

bool is_anywhere(std::string_view host) {
  return host.find_first_not_of("0.:") == host.npos;
}

// A standard registry knows three serializers, none of which is CAF's: the
// first one stands there, and the truth in implSpecificInfo, which is ours.
std::string to_json(const service_info& what) {
  auto addresses = json::array();
  for (const auto& at : what.addresses)
    addresses.push_back({{"host", at.host}, {"port", at.port}});
  json info = {{"serName", service_name},
               {"version", what.version},
               {"state", what.is_active ? "ACTIVE" : "INACTIVE"},
               {"transportInfo",
                {{"id", "sofof-" + what.provider},
                 {"name", "SOFOF"},
                 {"description", "Function offloading for connected vehicles"},
                 {"type", "RPC_STREAMING"},
                 {"protocol", "CAF"},
                 {"version", what.version},
                 {"endpoint", {{"addresses", addresses}}},
                 {"security", json::object()},
                 {"implSpecificInfo",
                  {{"provider", what.provider},
                   {"tls", what.is_secured},
                   {"serializer", "CAF"}}}}},
               {"serializer", "JSON"},
               {"scopeOfLocality", "MEC_SYSTEM"},
               {"consumedLocalOnly", false}};
  if (!what.id.empty())
    info["serInstanceId"] = what.id;
  // Names come from files, whose octets may be no UTF-8.
  return info.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::variant<service_info, std::string> read_service(std::string_view text) {
  try {
    const auto document = parse(text);
    if (!document.is_object())
      return "it is no object";
    return read_info(document);
  } catch (const flaw& x) {
    return x.sentence;
  }
}

std::variant<service_list, std::string> read_services(std::string_view text) {
  json document;
  try {
    document = parse(text);
  } catch (const flaw& x) {
    return x.sentence;
  }
  if (!document.is_array())
    return "it is no list";
  if (document.size() > most_services)
    return fmt::format("it lists {} services, more than {}", document.size(),
                       most_services);
  service_list all;
  for (const auto& x : document) {
    if (!x.is_object())
      return "it lists what is no object";
    if (!is_of_ours(x))
      continue;
    try {
      all.services.push_back(read_info(x));
    } catch (const flaw& why) {
      if (all.why_not_all.empty())
        all.why_not_all = why.sentence;
    }
  }
  return all;
}

std::string read_problem(std::string_view text) {
  try {
    const auto document = parse(text);
    if (document.is_object())
      return text_in(document, "detail");
  } catch (const flaw&) { // then it says nothing
  }
  return {};
}

} // namespace sofof::network::mec011

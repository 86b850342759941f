// Paths, methods and status codes of GS MEC 011.
#include "network/mec/registry.hpp"

#include "base/text/printable.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace sofof::network::mec011 {

namespace {

constexpr std::string_view management = "/mec_service_mgmt/v1";
constexpr std::string_view support = "/mec_app_support/v1";
constexpr unsigned done = 200, created = 201, no_content = 204, not_found = 404;

std::string services_of(const std::string& application) {
  return fmt::format("{}/applications/{}/services", management, application);
}

/// @returns the last part of a path or URI.
std::string last_part_of(std::string_view uri) {
  return std::string{uri.substr(uri.rfind('/') + 1)};
}

} // namespace

http::url parse_root(std::string_view text) {
  const auto shown = printable(std::string{text});
  if (text.starts_with("https://"))
    throw network_error{fmt::format(
        "{} wants TLS, which is not spoken to registries; give an http:// "
        "address, that of a proxy on this machine, say",
        shown)};
  auto root = http::parse_url(text);
  if (!root || root->at.port == 0 || !is_host(root->at.host)
      || root->target.find_first_of("?#") != root->target.npos)
    throw network_error{fmt::format("'{}' is no URL of a registry, like "
                                    "http://10.0.0.9:8080/mep",
                                    shown)};
  while (root->target.ends_with('/'))
    root->target.pop_back();
  return *root;
}

std::string print_root(const http::url& root) {
  return "http://" + print_address(root.at) + root.target;
}

http::response registry::ask_by_http(const http::question& how,
                                     const http::url& what) {
  constexpr std::chrono::milliseconds patience{1000};
  return http::ask(how, what, {patience, longest_document});
}

http::response registry::ask(std::string_view method, const std::string& target,
                             std::string body) const {
  http::question how{std::string{method}, "", std::move(body)};
  if (!how.body.empty())
    how.type = "application/json";
  return ask_(how, {root_.at, root_.target + target});
}

void registry::complain(std::string_view method,
                        const http::response& answer) const {
  const auto why = printable(read_problem(answer.body));
  throw registry_refusal{fmt::format("it answers {} with status {}{}{}", method,
                                     answer.status, why.empty() ? "" : ": ",
                                     why)};
}

service_list registry::list(const std::string& target) const {
  const auto answer = ask("GET", target);
  if (answer.status != done)
    complain("GET", answer);
  auto read = read_services(answer.body);
  if (const auto* why = std::get_if<std::string>(&read))
    throw network_error{"its answer is not understood: " + *why};
  return std::get<service_list>(std::move(read));
}

service_list registry::providers() const {
  return list(fmt::format("{}/services?ser_name={}", management, service_name));
}

service_list registry::providers_of(const std::string& application) const {
  return list(
      fmt::format("{}?ser_name={}", services_of(application), service_name));
}

// The URI of what has been added leads to the same registry, whatever it says.
std::string registry::add(const std::string& application,
                          const service_info& what) const {
  const auto answer = ask("POST", services_of(application), to_json(what));
  if (answer.status != created)
    complain("POST", answer);
  auto id = last_part_of(answer.location);
  if (!is_plain_name(id))
    throw network_error{"it has added the provider, but does not say where: "
                        "its header Location names no service"};
  return id;
}

std::optional<service_info> registry::find(const std::string& application,
                                           const std::string& id) const {
  const auto answer = ask("GET", services_of(application) + '/' + id);
  if (answer.status == not_found)
    return std::nullopt;
  if (answer.status != done)
    complain("GET", answer);
  auto read = read_service(answer.body);
  if (const auto* why = std::get_if<std::string>(&read))
    throw network_error{"its answer is not understood: " + *why};
  return std::get<service_info>(std::move(read));
}

void registry::update(const std::string& application,
                      const service_info& what) const {
  const auto answer =
      ask("PUT", services_of(application) + '/' + what.id, to_json(what));
  if (answer.status != done && answer.status != no_content)
    complain("PUT", answer);
}

void registry::remove(const std::string& application,
                      const std::string& id) const {
  const auto answer = ask("DELETE", services_of(application) + '/' + id);
  if (answer.status != no_content && answer.status != done
      && answer.status != not_found)
    complain("DELETE", answer);
}

void registry::confirm_ready(const std::string& application) const {
  const auto answer =
      ask("POST",
          fmt::format("{}/applications/{}/confirm_ready", support, application),
          R"({"indication":"READY"})");
  if (answer.status != no_content && answer.status != done)
    complain("POST confirm_ready", answer);
}

} // namespace sofof::network::mec011

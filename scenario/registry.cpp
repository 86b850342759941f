// A provider's entry in a registry, and vehicles that look for providers there.
#include "scenario/registry.hpp"

#include "actors/runtime/recorder.hpp"
#include "base/fingerprint.hpp"
#include "base/input_error.hpp"
#include "base/text/printable.hpp"
#include "network/keys/nonce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace sofof::scenario {

namespace {

/// Many who have lost one registry do not come back as one.
random_stream draws_of_ours(std::string_view name) {
  return {fingerprint(network::draw_nonce()), name};
}

/// @returns which entries of a registry vehicles of the scenario go by.
network::mec011::directory_rules rules_of(const scenario_definition& s,
                                          const drive_options& what) {
  network::mec011::directory_rules rules;
  for (const auto& p : s.providers)
    rules.providers.insert(p.name);
  rules.version = std::to_string(what.protocol);
  rules.is_secured = !what.keys.empty();
  return rules;
}

network::mec011::service_info entry_of(const register_options& registry,
                                       const network::network_address& listens,
                                       std::uint32_t protocol,
                                       const std::string& name,
                                       bool is_secured) {
  auto at = registry.advertised;
  if (at.port == 0)
    at.port = listens.port;
  return {.version = std::to_string(protocol),
          .provider = name,
          .is_secured = is_secured,
          .addresses = {std::move(at)}};
}

} // namespace

announcement::announcement(const register_options& registry,
                           const network::network_address& listens,
                           std::uint32_t protocol, const std::string& name,
                           bool is_secured, registry_listener publish)
    : entry_{network::mec011::registry{registry.root}, registry.application,
             entry_of(registry, listens, protocol, name, is_secured),
             draws_of_ours("registration"), std::move(publish)},
      thread_{[this]() -> network::mec011::pause_between {
                const auto pause = entry_.step();
                return {pause, pause};
              },
              [this] { entry_.end(); }} {}

discovery::discovery(const scenario_definition& s, const drive_options& what)
    : directory_{network::mec011::registry{*what.registry}, rules_of(s, what),
                 draws_of_ours("discovery"),
                 [this](const auto& news) { publish_(news); }} {}

void discovery::begin(registry_listener publish) {
  if (thread_)
    return;
  publish_ = std::move(publish);
  thread_.emplace([this] { return directory_.step(); });
}

void discovery::end() {
  if (!thread_)
    return;
  thread_->stop();
  publish_ = {};
}

std::optional<network::network_address>
discovery::next(const std::string& provider) {
  constexpr std::chrono::milliseconds for_the_first{1000};
  directory_.await_first(for_the_first);
  const auto next = directory_.next(provider);
  if (next.is_urgent)
    thread_->hurry();
  return next.at;
}

register_options complete_registration(register_options registry,
                                       const network::network_address& listen,
                                       const std::string& name) {
  if (registry.application.empty())
    registry.application = "sofof-" + name;
  if (!network::mec011::is_plain_name(registry.application))
    throw input_error(fmt::format("a registry knows no application '{}'; give "
                                  "the id that its platform has chosen, of "
                                  "letters, digits and \"-._~\", with "
                                  "--app-instance",
                                  printable(registry.application)));
  auto& host = registry.advertised.host;
  if (host.empty())
    host = listen.host;
  if (network::mec011::is_anywhere(host))
    throw input_error(fmt::format("vehicles cannot connect to {}; say with "
                                  "--advertise how they reach this host",
                                  host));
  return registry;
}

registry_listener recording_listener(std::function<void(std::string)> log,
                                     const runtime& time,
                                     messages::recorder_actor recorder) {
  return [log = std::move(log), &time, recorder = std::move(recorder)](
             const network::mec011::registry_news& news) {
    actors::send_record(
        recorder,
        messages::event_record{
            .at = time.now(),
            .what = news.is_well ? messages::event_type::registry_answered
                                 : messages::event_type::registry_failed,
            .detail = printable(news.sentence)});
    log(news.sentence);
  };
}

void look_up(actors::provider_connection_setup& setup, discovery& where,
             std::function<void(const network::network_address&)> lead_to) {
  const auto name = setup.provider;
  setup.address = [&where, name] { return where.place_of(name); };
  setup.on_refusal = setup.on_news;
  setup.connect = [&where, name, lead_to = std::move(lead_to),
                   connect = setup.connect]()
      -> std::variant<messages::acceptor_actor, std::string> {
    const auto at = where.next(name);
    if (!at)
      return "it is not listed as ACTIVE";
    lead_to(*at);
    return connect();
  };
}

std::vector<drive_options::provider>
wanted_providers(const scenario_definition& s, const drive_options& what) {
  auto all = what.providers;
  const auto standing = std::ranges::count_if(
      s.providers, [](const auto& p) { return !p.carrier; });
  if (what.registry)
    for (const auto& p : s.providers)
      if (!p.carrier && std::ranges::none_of(all, [&](const auto& x) {
            return x.name == p.name || (x.name.empty() && standing == 1);
          }))
        all.push_back({p.name, std::nullopt});
  return all;
}

} // namespace sofof::scenario

// Decision policies that say what a test tells them to, and remember what
// they were asked.
#pragma once

#include "policies/api/context.hpp"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace sofof::test {

/// What an LODM was asked, and what it shall say.
struct lodm_script {
  struct question {
    time_point now;
    std::string service;
    point provider_at;
    std::vector<point> path;
    double speed_mps = 0;
    std::vector<policies::provider_view> providers;
    service_place current{};
    time_point since;
  };
  std::vector<question> asked;
  std::set<std::string, std::less<>> wanted{"one", "two"};
  service_place preferred{}; ///< Whom it shall ask; else who stands first.
  service_place second{};
  duration hedge_after{};
  bool release = false;
  std::set<provider_id> unwanted; ///< To which it objects, though it asks them.
  double epoch_s = 0;
  std::vector<policies::cycle_outcome> cycles; ///< What it was told; no names.
  std::vector<policies::refusal_outcome> refusals;
  std::vector<policies::episode_outcome> episodes;
};

class spy_lodm final : public policies::local_policy {
public:
  explicit spy_lodm(std::shared_ptr<lodm_script> script)
      : script_{std::move(script)} {}

  policies::local_decision decide(const policies::local_context& c) override {
    script_->asked.push_back({c.now,
                              std::string{c.service},
                              c.providers.front().at,
                              {c.path.begin(), c.path.end()},
                              c.speed_mps,
                              {c.providers.begin(), c.providers.end()},
                              c.current,
                              c.since});
    if (!script_->wanted.contains(c.service))
      return policies::as_it_is("as told");
    if (script_->release)
      return {policies::come_home{}, "as told"};
    policies::run_at there{script_->preferred.value_or(c.providers.front().id)};
    if (script_->second)
      there.second = {*script_->second, script_->hedge_after};
    return {there, "as told"};
  }
  reason objection(const policies::local_context&,
                   const policies::provider_view& x) const override {
    return script_->unwanted.contains(x.id) ? "as told" : "";
  }
  void observe(const policies::cycle_outcome& x) override {
    script_->cycles.push_back(x);
    script_->cycles.back().service = {};
  }
  void observe(const policies::refusal_outcome& x) override {
    script_->refusals.push_back(x);
    script_->refusals.back().service = script_->refusals.back().why = {};
  }
  void observe(const policies::episode_outcome& x) override {
    script_->episodes.push_back(x);
    script_->episodes.back().service = {};
  }
  double epoch_s() const override { return script_->epoch_s; }
  std::string_view name() const override { return "spy"; }
  std::unique_ptr<policies::local_policy> clone() const override {
    return std::make_unique<spy_lodm>(*this);
  }

private:
  std::shared_ptr<lodm_script> script_;
};

/// What a CODM was asked, and what it shall say.
struct codm_script {
  struct question {
    time_point now;
    station_id station = 0;
    std::vector<std::string> services;
    std::vector<point> route;
    double speed_mps = 0;
    /// Station and kind of what runs.
    std::vector<std::pair<station_id, std::string>> sessions;
  };
  std::vector<question> asked;
  /// Utilisation of the provider, and by the first request.
  std::vector<std::pair<double, double>> used;
  std::vector<policies::session_view> sessions; ///< Of the latest question.
  std::vector<candidate> served;                ///< Told of its first session.
  std::vector<candidate> candidates;            ///< Of its first request.
  std::vector<policies::chain_links> links;     ///< Of its requests.
  std::set<std::string, std::less<>> accepted{"one", "two"};
  std::size_t worker = 0;               ///< Assigned to all.
  std::optional<duration> offset;       ///< Likewise.
  std::optional<provider_id> instead{}; ///< Told to all who are refused.
  double epoch_s = 0;                   ///< Read when a provider begins.
  /// If there are any, it decides about sessions too: those go.
  std::set<std::string, std::less<>> revoked{};
  std::optional<std::size_t> at_most; ///< Decisions that it makes.
};

class spy_codm final : public policies::central_policy {
public:
  explicit spy_codm(std::shared_ptr<codm_script> script)
      : script_{std::move(script)} {}

  std::vector<policies::central_decision>
  decide(const policies::central_context& c) override {
    const auto first =
        c.requests.empty() ? policies::request_view{} : c.requests.front();
    script_->used.emplace_back(c.utilisation, first.utilisation);
    codm_script::question q{c.now,
                            first.station,
                            {},
                            {first.route.begin(), first.route.end()},
                            first.speed_mps,
                            {}};
    script_->links.clear();
    for (const auto& request : c.requests) {
      q.services.emplace_back(request.service);
      script_->links.push_back(request.links);
    }
    script_->sessions.assign(c.sessions.begin(), c.sessions.end());
    script_->candidates.assign(first.candidates.begin(),
                               first.candidates.end());
    if (!c.sessions.empty()) {
      const auto& told = c.sessions.front().candidates;
      script_->served.assign(told.begin(), told.end());
    }
    for (const auto& s : c.sessions)
      q.sessions.emplace_back(s.station, s.service);
    script_->asked.push_back(std::move(q));
    std::vector<policies::central_decision> all;
    for (const auto& request : c.requests) {
      if (script_->accepted.contains(request.service))
        all.push_back(
            {policies::accepted{script_->worker, script_->offset}, "as told"});
      else
        all.push_back({policies::refused{script_->instead}, "as told"});
    }
    if (!script_->revoked.empty())
      for (const auto& s : c.sessions)
        all.push_back(
            script_->revoked.contains(s.service)
                ? policies::central_decision{policies::refused{}, "as told"}
                : policies::central_decision{policies::accepted{}, "as told"});
    if (script_->at_most && all.size() > *script_->at_most)
      all.resize(*script_->at_most);
    return all;
  }
  double epoch_s() const override { return script_->epoch_s; }
  std::string_view name() const override { return "spy"; }
  std::unique_ptr<policies::central_policy> clone() const override {
    return std::make_unique<spy_codm>(*this);
  }

private:
  std::shared_ptr<codm_script> script_;
};

} // namespace sofof::test

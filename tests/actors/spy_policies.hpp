// Decision policies that say what a test tells them to, and remember what
// they were asked.
#pragma once

#include "policies/context.hpp"

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
    std::string kind;
    point provider_at;
    std::vector<point> path;
    double speed_mps = 0;
    std::vector<provider_view> providers;
  };
  std::vector<question> asked;
  std::set<std::string, std::less<>> wanted{"one", "two"};
  boot_id preferred = 0; ///< Whom it shall ask; 0: who offers just now.
};

class spy_lodm final : public local_policy {
public:
  explicit spy_lodm(std::shared_ptr<lodm_script> script)
      : script_{std::move(script)} {}

  local_decision decide(const local_context& c) override {
    script_->asked.push_back({c.now,
                              std::string{c.kind},
                              c.providers.front().at,
                              {c.path.begin(), c.path.end()},
                              c.speed_mps,
                              {c.providers.begin(), c.providers.end()}});
    if (!script_->wanted.contains(c.kind))
      return {0, "as told"};
    return {script_->preferred ? script_->preferred : c.providers.front().id,
            "as told"};
  }
  std::string_view name() const override { return "spy"; }
  std::unique_ptr<local_policy> clone() const override {
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
    std::vector<std::string> kinds;
    std::vector<point> route;
    double speed_mps = 0;
    /// Station and kind of what runs.
    std::vector<std::pair<station_id, std::string>> sessions;
  };
  std::vector<question> asked;
  /// Utilisation of the provider, and by the first request.
  std::vector<std::pair<double, double>> used;
  std::vector<session_view> sessions; ///< Of the latest question.
  std::set<std::string, std::less<>> accepted{"one", "two"};
  std::size_t worker = 0;         ///< Assigned to all.
  std::optional<duration> offset; ///< Likewise.
};

class spy_codm final : public central_policy {
public:
  explicit spy_codm(std::shared_ptr<codm_script> script)
      : script_{std::move(script)} {}

  std::vector<central_decision> decide(const central_context& c) override {
    const auto first = c.requests.empty() ? request_view{} : c.requests.front();
    script_->used.emplace_back(c.utilisation, first.utilisation);
    codm_script::question q{c.now,
                            first.station,
                            {},
                            {first.route.begin(), first.route.end()},
                            first.speed_mps,
                            {}};
    for (const auto& request : c.requests)
      q.kinds.emplace_back(request.kind);
    script_->sessions.assign(c.sessions.begin(), c.sessions.end());
    for (const auto& s : c.sessions)
      q.sessions.emplace_back(s.station, s.kind);
    script_->asked.push_back(std::move(q));
    std::vector<central_decision> all;
    for (const auto& request : c.requests)
      all.push_back({script_->accepted.contains(request.kind), "as told",
                     script_->worker, script_->offset});
    return all;
  }
  std::string_view name() const override { return "spy"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<spy_codm>(*this);
  }

private:
  std::shared_ptr<codm_script> script_;
};

} // namespace sofof::test

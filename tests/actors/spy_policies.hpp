// Decision policies that say what a test tells them to, and remember what
// they were asked.
#pragma once

#include "policies/context.hpp"

#include <memory>
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
  };
  std::vector<question> asked;
  std::set<std::string, std::less<>> wanted{"one", "two"};
};

class spy_lodm final : public local_policy {
public:
  explicit spy_lodm(std::shared_ptr<lodm_script> script)
      : script_{std::move(script)} {}

  local_decision decide(const local_context& c) override {
    script_->asked.push_back({c.now,
                              std::string{c.kind},
                              c.provider_at,
                              {c.path.begin(), c.path.end()},
                              c.speed_mps});
    return {script_->wanted.contains(c.kind), "as told"};
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
  std::set<std::string, std::less<>> accepted{"one", "two"};
};

class spy_codm final : public central_policy {
public:
  explicit spy_codm(std::shared_ptr<codm_script> script)
      : script_{std::move(script)} {}

  std::vector<central_decision> decide(const central_context& c) override {
    codm_script::question q{c.now,
                            c.station,
                            {c.kinds.begin(), c.kinds.end()},
                            {c.route.begin(), c.route.end()},
                            c.speed_mps,
                            {}};
    for (const auto& s : c.sessions)
      q.sessions.emplace_back(s.station, s.kind);
    script_->asked.push_back(std::move(q));
    std::vector<central_decision> all;
    for (const auto& kind : c.kinds)
      all.push_back({script_->accepted.contains(kind), "as told"});
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

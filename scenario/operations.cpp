// Pages of text.
#include "scenario/operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace sofof::scenario {

namespace {

using recording::exposition;
using kind = exposition::kind;

/// Workers are busy by jobs: looked at for less, they are or are not.
constexpr duration looked_back = std::chrono::seconds{5};

double busy_share(const channel::load_figures& x, duration now) {
  const auto from = std::max(x.bins_from, now - looked_back);
  if (from >= now)
    return 0;
  return to_seconds(x.between(from, now).busy)
         / (x.servers * to_seconds(now - from));
}

class counting_sink final : public messages::record_sink {
public:
  counting_sink(std::shared_ptr<messages::record_sink> counts,
                std::shared_ptr<messages::record_sink> then)
      : counts_{std::move(counts)}, then_{std::move(then)} {}

  void on_record(const messages::record& x) override {
    counts_->on_record(x);
    then_->on_record(x);
  }

private:
  std::shared_ptr<messages::record_sink> counts_, then_;
};

} // namespace

operations::operations(const recording::run_info& run, std::string role,
                       std::function<time_point()> now,
                       recording::live_figures::more more)
    : start_{run.start}, now_{std::move(now)}, title_{fmt::format(
                                                   "sofof {} {}, {}", role,
                                                   run.version, run.scenario)},
      figures_{std::make_shared<recording::live_figures>(
          run, std::move(role), [this, more = std::move(more)](exposition& to) {
            if (health_ == health::starting)
              return;
            write_loads(to);
            if (more)
              more(to);
          })} {}

void operations::serve(const network::network_address& at) {
  server_.emplace(
      at, [this](const network::http::request& to) { return answer(to); });
}

std::shared_ptr<messages::record_sink>
operations::counting(std::shared_ptr<messages::record_sink> then) const {
  return std::make_shared<counting_sink>(figures_, std::move(then));
}

std::string operations::address() const {
  return server_ ? "http://" + network::print_address(server_->address()) : "";
}

void operations::ready(std::vector<provider_load> loads) {
  loads_ = std::move(loads);
  health_ = health::ready;
}

network::http::response
operations::answer(const network::http::request& to) const {
  constexpr unsigned unavailable = 503, not_found = 404;
  if (to.path == "/metrics") {
    const auto format = recording::format_for(to.accept);
    return {200, std::string{recording::type_of(format)},
            figures_->text(format)};
  }
  network::http::response page;
  if (to.path == "/healthz") {
    const auto now = health_.load();
    page.body = now == health::ready      ? "ready\n"
                : now == health::starting ? "starting\n"
                                          : "ending\n";
    if (now != health::ready)
      page.status = unavailable;
    return page;
  }
  page.body = title_
              + "\n/metrics  figures, for Prometheus\n"
                "/healthz  whether it is ready\n";
  if (to.path != "/")
    page.status = not_found;
  return page;
}

std::vector<operations::load> operations::loads() const {
  std::vector<load> all;
  if (health_ == health::starting)
    return all;
  for (const auto& x : loads_) {
    const auto read = x.workers->read();
    all.push_back({x.name, read.servers, busy_share(read, now_() - start_)});
  }
  return all;
}

void operations::write_loads(exposition& to) const {
  if (loads_.empty())
    return;
  const auto now = now_() - start_;
  std::vector<channel::load_figures> all;
  for (const auto& x : loads_)
    all.push_back(x.workers->read());
  const auto each = [&](const char* name, kind what, const char* help,
                        const char* unit, const auto& tell) {
    to.family(name, what, help, unit);
    for (std::size_t i = 0; i < all.size(); ++i)
      tell(all[i], std::pair<std::string_view, std::string_view>{
                       "provider", loads_[i].name});
  };
  each("sofof_workers", kind::gauge, "Workers of a provider.", "",
       [&](const auto& x, const auto& label) {
         to.sample({label}, std::uint64_t{x.servers});
       });
  each("sofof_utilisation_ratio", kind::gauge,
       "Share of the last 5 s in which workers were busy.", "ratio",
       [&](const auto& x, const auto& label) {
         to.sample({label}, busy_share(x, now));
       });
  each("sofof_computing_seconds", kind::counter,
       "Workers' time that was used, by service.", "seconds",
       [&](const auto& x, const auto& label) {
         for (const auto& [service, use] : x.busy_by)
           to.sample({label, {"service", service}},
                     to_seconds(x.busy_for(service, now)));
       });
}

} // namespace sofof::scenario

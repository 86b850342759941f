// Each claim of the paper, with figures for each verdict that it can get.
#include "experiments/dehler2025/claims.hpp"

#include "experiments/dehler2025/report_text.hpp"
#include "experiments/dehler2025/verdicts.hpp"
#include "recording/cpu_balance.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

namespace sofof::experiments::study {

namespace {

interval about(double mean, double half_width) {
  return {mean, mean - half_width, mean + half_width};
}

/// Costs of vehicles that are all alike, but for a width of their intervals.
cost_figures costs(const recording::cpu_shares& c, double half_width = 0) {
  const auto pays = recording::break_even_share(c);
  return {about(c.active, half_width), about(c.inactive, half_width),
          about(c.requester_remote, half_width),
          pays ? std::optional{about(100 * *pays, half_width)} : std::nullopt};
}

/// Figures that are all like the paper's.
paper_figures like_the_paper() {
  paper_figures f;
  for (int n = 1; n <= 6; ++n) {
    vehicle_figures v;
    v.vehicles = n;
    v.curve = {{10, about(0.02, 0.001)},
               {90, about(36 - 4 * n, 1)},
               {100, about(n == 6 ? 60 : 70, 2)},
               {150, about(n == 6 ? 60 : 70, 2)}};
    v.time_in_area_s = 70;
    v.latency_ms = about(10.34 + 0.2 * n, 0.1);
    v.latency_deviation_ms = 9.73 + 0.1 * n;
    v.late_share = 1e-4;
    f.by_vehicles.push_back(v);
  }
  f.real_latency_ms = {11.94, 2.98, 1000};
  f.drives = 300;
  f.drives_ended_early = 40;
  f.cpu_20_hz = costs({19.5, 8.5, 0.96, 0.96});
  f.cpu_100_hz = costs({116.1, 28.3, 4, 4});
  f.v2x_at_most = 0.2;
  f.switches = 30;
  f.largest_speed_jump_mps = 0.01;
  f.largest_acceleration_jump_mps2 = 0.05;
  return f;
}

verdict of(const char* name, const paper_figures& f) {
  for (const auto& claim : judge(f))
    if (claim.name == name)
      return claim.word;
  FAIL("there is no claim ", name);
  return {};
}

/// @returns the verdict on figures like the paper's, after a change.
template <class Change>
verdict after(const char* name, Change change) {
  auto f = like_the_paper();
  change(f);
  return of(name, f);
}

using enum verdict;
using figures = paper_figures;

void flat(figures& f, double height_s, double half_width_s) {
  for (auto& n : f.by_vehicles)
    for (auto& point : n.curve)
      point.t_off_s = about(height_s, half_width_s);
}

} // namespace

TEST_CASE("a verdict is made of what each part of a claim shows") {
  using enum finding;
  const auto all = [](std::initializer_list<finding> parts) {
    return verdict_of(parts);
  };
  CHECK(all({}) == not_measured);
  CHECK(all({holds, holds}) == reproduced);
  CHECK(all({holds, open}) == in_part);
  CHECK(all({holds, opposite}) == in_part);
  CHECK(all({open, open}) == not_reproduced);
  CHECK(all({open, opposite}) == contradicts);
}

TEST_CASE("each verdict has a word of its own") {
  std::set<std::string_view> words;
  for (const auto v :
       {not_measured, reproduced, in_part, not_reproduced, contradicts})
    words.insert(word_of(v));
  CHECK(words
        == std::set<std::string_view>{"not measured", "reproduced", "in part",
                                      "not reproduced", "contradicts"});
}

TEST_CASE("figures like the paper's reproduce all of its claims") {
  for (const auto& claim : judge(like_the_paper())) {
    CAPTURE(claim.name);
    CAPTURE(claim.ours);
    CHECK(claim.word == reproduced);
  }
}

TEST_CASE("without figures nothing is measured") {
  for (const auto& claim : judge({})) {
    CAPTURE(claim.name);
    CHECK(claim.word == not_measured);
  }
}

TEST_CASE("curves that rise, that fall in between, and that do not rise") {
  CHECK(after("rises",
              [](figures& f) {
                f.by_vehicles[2].curve[1].t_off_s = about(0.001, 0.0001);
              })
        == in_part);
  CHECK(after("rises", [](figures& f) { flat(f, 70, 1); }) == not_reproduced);
  CHECK(after("rises",
              [](figures& f) {
                for (auto& n : f.by_vehicles) {
                  n.curve = {{10, about(70, 1)}, {150, about(60, 20)}};
                  n.curve.insert(n.curve.begin() + 1, {80, about(30, 1)});
                }
              })
        == contradicts);
  CHECK(after("rises",
              [](figures& f) {
                for (auto& n : f.by_vehicles)
                  n.curve = {{10, about(70, 1)}, {150, about(6, 1)}};
              })
        == contradicts);
}

TEST_CASE("saturation near 70 s, elsewhere, at no height, and uncertain") {
  const auto ends = [](double last_but_one, double last, double half_width) {
    return after("saturates", [=](figures& f) {
      auto& curve = f.by_vehicles[0].curve;
      curve[2].t_off_s = about(last_but_one, half_width);
      curve[3].t_off_s = about(last, half_width);
    });
  };
  CHECK(ends(76, 76, 1) == reproduced);
  CHECK(ends(50, 50, 1) == in_part);
  CHECK(ends(40, 70, 1) == in_part);
  CHECK(ends(20, 50, 1) == contradicts);
  CHECK(ends(70, 60, 8) == not_reproduced);
}

TEST_CASE("saturation at the time in the area, or at another") {
  const auto stays = [](double time_s, double half_width) {
    return after("time_in_area", [=](figures& f) {
      f.by_vehicles[0].time_in_area_s = time_s;
      f.by_vehicles[0].curve[3].t_off_s = about(70, half_width);
    });
  };
  CHECK(stays(73, 1) == reproduced);
  CHECK(stays(90, 1) == contradicts);
  CHECK(stays(90, 15) == not_reproduced);
  CHECK(after("time_in_area",
              [](figures& f) { f.by_vehicles[0].time_in_area_s.reset(); })
        == not_measured);
}

TEST_CASE("six vehicles rise more slowly, alike, or faster") {
  const auto six = [](double mean_s, double half_width) {
    return after("rises_slower", [=](figures& f) {
      f.by_vehicles[5].curve[1].t_off_s = about(mean_s, half_width);
    });
  };
  CHECK(six(20, 1) == reproduced);
  CHECK(six(30, 5) == not_reproduced);
  CHECK(six(40, 1) == contradicts);
  CHECK(after("rises_slower",
              [](figures& f) {
                for (auto& n : f.by_vehicles)
                  n.curve.insert(n.curve.begin() + 1, {80, about(20, 1)});
              })
        == in_part);
  CHECK(after("rises_slower", [](figures& f) { flat(f, 70, 1); })
        == not_measured);
}

TEST_CASE("six vehicles are below the others, below some, alike, or above") {
  const auto six = [](double mean_s, double half_width) {
    return after("six_lowest", [=](figures& f) {
      f.by_vehicles[5].curve[3].t_off_s = about(mean_s, half_width);
    });
  };
  CHECK(six(60, 2) == reproduced);
  CHECK(six(69, 2) == not_reproduced);
  CHECK(six(80, 2) == contradicts);
  CHECK(after("six_lowest",
              [](figures& f) {
                f.by_vehicles[4].curve[3].t_off_s = about(61, 2);
              })
        == in_part);
}

TEST_CASE("latency grows, in the mean only, not surely, or falls") {
  const auto growth = [](double mean_step, double half_width,
                         double deviation_step) {
    return after("latency_grows", [=](figures& f) {
      for (auto& n : f.by_vehicles) {
        n.latency_ms = about(10 + mean_step * n.vehicles, half_width);
        n.latency_deviation_ms = 9 + deviation_step * n.vehicles;
      }
    });
  };
  CHECK(growth(0.2, 0.1, 0.1) == reproduced);
  CHECK(growth(0.2, 0.1, -0.1) == in_part);
  CHECK(growth(-0.01, 1, 0) == not_reproduced);
  CHECK(growth(-0.2, 0.1, -0.1) == contradicts);
}

TEST_CASE("latency does not grow in a step whose interval is below 0") {
  const auto step = [](double mean_ms, double half_width) {
    return after("latency_grows", [=](figures& f) {
      f.by_vehicles[2].deviation_step_ms = about(mean_ms, half_width);
    });
  };
  CHECK(step(0.1, 0.05) == reproduced);
  CHECK(step(-0.006, 0.04) == reproduced);
  CHECK(step(-0.1, 0.05) == in_part);
  CHECK(after("latency_grows",
              [](figures& f) {
                f.by_vehicles[2].mean_step_ms = about(-0.1, 0.05);
                f.by_vehicles[3].deviation_step_ms = about(-0.1, 0.05);
              })
        == not_reproduced);
}

TEST_CASE("a fit is met, half met, uncertain, or missed") {
  const auto one = [](double mean, double half_width, double deviation) {
    return after("latency_of_one", [=](figures& f) {
      f.by_vehicles[0].latency_ms = about(mean, half_width);
      f.by_vehicles[0].latency_deviation_ms = deviation;
    });
  };
  CHECK(one(10.7, 0.1, 9.9) == reproduced);
  CHECK(one(10.7, 0.1, 5) == in_part);
  CHECK(one(12, 0.1, 5) == contradicts);
  const auto real = [](double mean, double deviation) {
    return after("real_latency", [=](figures& f) {
      f.real_latency_ms = {mean, deviation, 100};
    });
  };
  CHECK(real(12, 3) == reproduced);
  CHECK(real(12, 4) == in_part);
  CHECK(real(15, 4) == contradicts);
}

TEST_CASE("results come in time nearly always, for some, or not") {
  const auto late = [](double share) {
    return after("nearly_all_in_time", [=](figures& f) {
      for (auto& n : f.by_vehicles)
        n.late_share = share;
    });
  };
  CHECK(late(0.01) == reproduced);
  CHECK(late(0.03) == not_reproduced);
  CHECK(late(0.06) == contradicts);
  CHECK(after("nearly_all_in_time",
              [](figures& f) { f.by_vehicles[5].late_share = 0.06; })
        == in_part);
}

TEST_CASE("drives end early as often, about as often, or not") {
  const auto drives = [](std::uint64_t early, std::uint64_t of) {
    return after("real_early_ends", [=](figures& f) {
      f.drives_ended_early = early;
      f.drives = of;
    });
  };
  CHECK(drives(33, 300) == reproduced);
  CHECK(drives(20, 300) == not_reproduced);
  CHECK(drives(0, 300) == contradicts);
  CHECK(drives(150, 300) == contradicts);
  CHECK(drives(0, 1) == not_reproduced); // one drive tells nothing
  CHECK(drives(0, 0) == not_measured);
}

TEST_CASE("switches are quiet, quiet in part, to be felt, or hard") {
  const auto jumps = [](double speed, double acceleration) {
    return after("switch_unnoticed", [=](figures& f) {
      f.largest_speed_jump_mps = speed;
      f.largest_acceleration_jump_mps2 = acceleration;
    });
  };
  CHECK(jumps(0.01, 0.1) == reproduced);
  CHECK(jumps(0.01, 2) == in_part);
  CHECK(jumps(0.2, 0.5) == not_reproduced);
  CHECK(jumps(0.6, 2) == contradicts);
  CHECK(after("switch_unnoticed", [](figures& f) { f.switches = 0; })
        == not_measured);
}

TEST_CASE("computing costs as much as in the paper, in part, or not") {
  using recording::cpu_shares;
  for (const auto* rate : {"20_hz", "100_hz"}) {
    CAPTURE(rate);
    const auto shares = [rate](const cpu_shares& c, double half_width = 0) {
      return after((std::string{"cost_"} + rate).c_str(), [=](figures& f) {
        (std::string_view{rate} == "20_hz" ? f.cpu_20_hz : f.cpu_100_hz) =
            costs(c, half_width);
      });
    };
    const auto theirs = std::string_view{rate} == "20_hz"
                            ? cpu_shares{19.5, 8.5, 0.96, 0.96}
                            : cpu_shares{116.1, 28.3, 2.61, 2.61};
    const auto times = [&](double x, double requester) {
      return cpu_shares{theirs.active * x, theirs.inactive * x,
                        theirs.requester * requester,
                        theirs.requester * requester};
    };
    CHECK(shares(times(1.5, 1.5)) == reproduced);
    CHECK(shares(times(0.01, 1)) == in_part);
    CHECK(shares(times(3, 3)) == not_reproduced);
    CHECK(shares(times(0.01, 0.1)) == contradicts);
    CHECK(shares(times(0.01, 0.1), 100) == not_reproduced); // who knows
  }
}

TEST_CASE("computing for V2X is negligible, is not, or may be") {
  const auto v2x = [](double percent) {
    return after("v2x_negligible",
                 [=](figures& f) { f.v2x_at_most = percent; });
  };
  CHECK(v2x(0.5) == reproduced);
  CHECK(v2x(3) == not_reproduced);
  CHECK(v2x(6) == contradicts);
}

TEST_CASE("offloading pays from about the same share on, from another, never") {
  for (const auto* rate : {"20_hz", "100_hz"}) {
    CAPTURE(rate);
    const auto pays = [rate](double requester, double half_width = 0) {
      return after((std::string{"pays_"} + rate).c_str(), [=](figures& f) {
        (std::string_view{rate} == "20_hz" ? f.cpu_20_hz : f.cpu_100_hz) =
            costs({10, 0, requester, requester}, half_width);
      });
    };
    CHECK(pays(0.7) == reproduced);
    CHECK(pays(4) == in_part);
    CHECK(pays(4, 70) == not_reproduced); // 40 %, or never
    CHECK(pays(20) == contradicts);
  }
}

TEST_CASE("the section has each claim with its tolerance and its verdict") {
  auto f = like_the_paper();
  f.drives_ended_early = 0;
  const auto claims = judge(f);
  const auto s = verdicts(claims);
  const auto& t = std::get<report::table>(s.blocks.at(1));
  REQUIRE(t.rows.size() == claims.size());
  for (std::size_t i = 0; i < claims.size(); ++i) {
    CHECK(t.rows[i][0] == claims[i].name);
    CHECK(t.rows[i][1] == word_of(claims[i].word));
    CHECK(t.rows[i][3].find('{') == std::string::npos);
  }
  const auto early = std::ranges::find(
      t.rows, "real_early_ends", [](const auto& row) { return row.front(); });
  REQUIRE(early != t.rows.end());
  CHECK((*early)[1] == "contradicts");
  CHECK(test::contains((*early)[2], "0 of 300 drives"));
}

TEST_CASE("no text of the evaluation has a verdict of its own") {
  for (const auto* name :
       {"latency_plot", "delay_plot", "real_world", "cpu_cost", "quality",
        "sensitivity", "refusals", "report"}) {
    CAPTURE(name);
    for (const auto* word :
         {"reproduced", "contradicts", "so are the curves", "agrees"})
      CHECK_FALSE(test::contains(std::string{template_of(name)}, word));
  }
}

} // namespace sofof::experiments::study

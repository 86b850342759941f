// Services whose functions are programs, in whole runs of virtual time.
#include "actors/services/programs/input_source.hpp"
#include "scenario/load.hpp"
#include "tests/scenario/whole_run.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace sofof::programs_test {

namespace {

using namespace std::chrono_literals;

const std::string file = SOFOF_SOURCE_DIR "/config/object_detection.toml";
constexpr auto service = "object_detection";

/// The scenario with another program.
scenario::scenario_definition with(const std::string& behaviour,
                                   std::vector<std::string> more = {}) {
  more.insert(more.begin(),
              {"duration=5s", "fleet.0.count=2",
               "service.object_detection.most_result_octets=30000",
               fmt::format("service.object_detection.command=\"{} {}\"",
                           SOFOF_ODD_PROGRAM, behaviour)});
  return scenario::load_scenario(file, more);
}

struct counted {
  std::size_t remote = 0, used = 0, at_home = 0, lost = 0, back = 0;
  std::size_t planned_late = 0;
};

counted count(const test::memory_sink& records) {
  counted all;
  for (const auto& x : records.cycles)
    if (x.session.service == messages::service_name{service}) {
      ++all.remote;
      all.used += x.used ? 1 : 0;
    }
  for (const auto& x : records.work)
    if (x.service == messages::service_name{service})
      all.at_home += x.on_board;
  for (const auto& x : records.events) {
    all.lost += x.what == messages::event_type::program_lost ? 1 : 0;
    all.back += x.what == messages::event_type::program_back ? 1 : 0;
    if (x.what == messages::event_type::violation
        && x.service == messages::service_name{"trajectory_planning"})
      ++all.planned_late;
  }
  return all;
}

std::string refusal(std::vector<std::string> changes) {
  try {
    scenario::load_scenario(file, changes);
  } catch (const std::exception& problem) {
    return problem.what();
  }
  return "it is taken";
}

} // namespace

TEST_CASE("a program computes a service, at home and at providers") {
  const auto all = count(test::play(with("")));
  CHECK(all.remote >= 70); // of two vehicles in 5 s
  CHECK(all.used >= all.remote * 95 / 100);
  CHECK(all.at_home >= 2);
  CHECK(all.lost == 0);
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1); // all have ended
}

TEST_CASE("a program that does the same makes the same run") {
  const auto one = test::play(with("tells_its_steps"));
  const auto two = test::play(with("tells_its_steps"));
  REQUIRE(one.cycles.size() == two.cycles.size());
  for (std::size_t k = 0; k < one.cycles.size(); ++k) {
    CHECK(one.cycles[k].received == two.cycles[k].received);
    CHECK(one.cycles[k].used == two.cycles[k].used);
  }
}

TEST_CASE("programs that die are a matter of their service alone") {
  const auto all = count(test::play(with("dies 8")));
  CHECK(all.lost >= 4);
  CHECK(all.back >= 2);
  CHECK(all.remote >= 10); // there is some between deaths
  CHECK(all.planned_late == 0);
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
}

TEST_CASE("a provider's program may be another one than the vehicles'") {
  const auto other = fmt::format(
      "provider.0.program=[{{service=\"object_detection\",command=\"{} dies "
      "3\"}}]",
      SOFOF_ODD_PROGRAM);
  const auto records = test::play(
      with("", {other, "provider.1.services=[\"trajectory_planning\"]"}));
  std::size_t there = 0, here = 0;
  for (const auto& x : records.events)
    if (x.what == messages::event_type::program_lost)
      ++(x.provider == provider_id{0} ? here : there);
  CHECK(there >= 2);
  CHECK(here == 0);
  const auto all = count(records);
  CHECK(all.at_home >= 10);
}

TEST_CASE("results of a size that no result has are implausible") {
  const auto records =
      test::play(with("", {"service.object_detection.most_result_octets=100000",
                           "service.object_detection.least_result_octets="
                           "90000"}));
  CHECK(std::ranges::any_of(records.events, [](const auto& x) {
    return x.what == messages::event_type::implausible
           && x.check == "least_octets";
  }));
  CHECK(count(records).used == 0);
}

TEST_CASE("inputs are what their source says") {
  for (const auto source : {"cpm", "route"}) {
    CAPTURE(source);
    const auto all = count(test::play(
        with("", {fmt::format("service.object_detection.input={{name"
                              "=\"{}\"}}",
                              source),
                  "service.object_detection.least_result_octets=0"})));
    CHECK(all.used >= 70);
  }
}

TEST_CASE("a program may get what another one of its vehicle has found") {
  const test::scratch folder;
  auto text = test::read_file(file);
  const auto absolute = [&](std::string_view path) {
    const auto at = text.find(path);
    REQUIRE(at != text.npos);
    text.insert(at, SOFOF_SOURCE_DIR "/config/");
  };
  absolute("maps/ulm_lehr.toml");
  absolute("frames\"");
  text += fmt::format("[[service]]\nname = \"second\"\n"
                      "command = \"{}\"\n"
                      "input = {{ name = \"program\", service = "
                      "\"object_detection\" }}\n",
                      SOFOF_ODD_PROGRAM);
  test::write_text(folder / "two.toml", text);
  const auto records = test::play(scenario::load_scenario(
      folder / "two.toml",
      std::vector<std::string>{
          "duration=5s", "fleet.0.count=2",
          fmt::format("service.object_detection.command=\"{}\"",
                      SOFOF_ODD_PROGRAM),
          "service.object_detection.most_result_octets=30000"}));
  CHECK(std::ranges::count_if(
            records.cycles,
            [](const auto& x) {
              return x.used
                     && x.session.service == messages::service_name{"second"};
            })
        >= 50);
}

TEST_CASE("what is wrong with a program is said before anything runs") {
  const auto at = [](std::string_view option) {
    return "service.object_detection." + std::string{option};
  };
  using test::contains;
  CHECK(contains(refusal({at("command=\"\"")}), "must name a program."));
  CHECK(contains(refusal({at("command=\"a 'b\"")}),
                 "cannot be read: the quote ' is not closed."));
  CHECK(contains(refusal({at("command=\"no_such_program x\"")}),
                 "there is no program \"no_such_program\" in PATH."));
  CHECK(
      contains(refusal({at("command=\"./nothing\"")}), "there is no program "));
  CHECK(contains(refusal({at("input.folder=\"nowhere\"")}),
                 "there are no .jpg files in "));
  CHECK(contains(refusal({at("input.folder=\"\"")}),
                 "must name a folder of .jpg files"));
  CHECK(contains(refusal({at("input=\"camra\"")}), "camera"));
  CHECK(contains(refusal({at("most_input_octets=100")}), "cannot be read: "));
  CHECK(contains(refusal({at("least_result_octets=2000")}),
                 "must not be more than `most_result_octets`."));
  CHECK(contains(refusal({at("input={name=\"program\",service=\"x\"}")}),
                 "is no [[service]] with a `command` here"));
  CHECK(contains(refusal({"service.1.name=\"Object-Detection\""}),
                 "must have 1 to 31 of the characters"));
  CHECK(contains(refusal({"service.1.name=\"tracking\""}),
                 "is a function of SOFOF's own"));
  CHECK(contains(refusal({"provider.0.program=[{service=\"x\",command=\"true\"}"
                          "]"}),
                 "is no [[service]] with a `command` here"));
}

TEST_CASE("computing times that were measured are a file of times") {
  const test::scratch folder;
  const auto at = folder / "detect.times";
  const auto option =
      fmt::format("service.object_detection.run_times=\"{}\"", at.string());
  CHECK(test::contains(refusal({option}), "cannot be read"));
  test::write_text(at, "# ms\n");
  CHECK(test::contains(refusal({option}), "has no times."));
  for (const auto wrong : {"-1", "0", "nan", "1 ms", "1e9", "x"}) {
    CAPTURE(wrong);
    test::write_text(at, fmt::format("# ms\n1.5\n{}\n", wrong));
    CHECK(test::contains(refusal({option}),
                         fmt::format(":3: \"{}\" is no time in ms", wrong)));
  }
  test::write_text(at, "# ms\n140\n1\n"); // every other one comes too late
  const auto all = count(test::play(with("", {option})));
  CHECK(all.remote > 0);
}

TEST_CASE("what programs and pictures hold is known, and told apart") {
  const test::scratch folder;
  const auto script = folder.path() / "program.sh";
  const auto texts = [&] {
    return scenario::load_scenario(
               file, std::vector{fmt::format(
                         "service.object_detection.command=\"sh {}\"",
                         script.string())})
        .program_texts;
  };
  test::write_text(script, "one");
  const auto one = texts();
  CHECK(one.size() == 2 + 8); // sh, the script and the pictures
  CHECK(one == texts());
  test::write_text(script, "two");
  CHECK(one != texts());
  for (const auto& text : one)
    CHECK(text.size() < 100); // no contents
}

TEST_CASE("what a program is given behind a = counts for its runs") {
  const test::scratch folder;
  const auto weights = folder.path() / "weights";
  const auto texts = [&] {
    return scenario::load_scenario(
               file, std::vector{fmt::format(
                         "service.object_detection.command=\"sh --w={}\"",
                         weights.string())})
        .program_texts;
  };
  test::write_text(weights, "one");
  const auto one = texts();
  test::write_text(weights, "two");
  CHECK(one != texts());
}

TEST_CASE("a program is told of the nearest objects when there are too many") {
  actors::vehicle_view view{{.where = test::in_ulm()}};
  actors::vehicle_look look;
  look.own.station = 101;
  look.own.at = look.seen.at = time_point{1s};
  for (int k = 200; k > 0; --k)
    look.seen.objects.push_back(
        {.centre = {0.5 * k, 3}, .length_m = 4.5, .width_m = 1.8});
  view.see(look);
  const auto source = actors::make_input_source("cpm");
  const auto octets = source->next(view, 101, 0);
  REQUIRE_FALSE(octets.empty());
  messages::its_pdu pdu;
  pdu.octets.assign(octets.begin(), octets.end());
  const auto message = test::message_in<messages::etsi::tr103562::cpm>(pdu);
  REQUIRE(message);
  const auto read = messages::read_cpm(*message, *test::in_ulm(), look.own.at);
  REQUIRE(read);
  CHECK(read->objects.size() == 128);
  for (const auto& x : read->objects)
    CHECK(x.centre.x_m < 64.5);
}

} // namespace sofof::programs_test

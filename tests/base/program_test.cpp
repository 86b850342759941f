// Programs that serve as functions: what they say, how they die, and that they
// are there again.
#include "base/process/kept_program.hpp"
#include "base/process/spare_programs.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <csignal>
#include <random>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <utility>
#include <vector>

namespace sofof::program_test {

namespace {

using namespace std::chrono_literals;
using octets = std::vector<std::byte>;

octets octets_of(std::string_view text) {
  const auto some = std::as_bytes(std::span{text.data(), text.size()});
  return {some.begin(), some.end()};
}

std::string text_of(const std::optional<octets>& what) {
  return what ? std::string(reinterpret_cast<const char*>(what->data()),
                            what->size())
              : "nothing";
}

/// A program that does what it is told, and all news of it.
struct kept {
  explicit kept(std::vector<std::string> words, bool waits = true) {
    setup.how.command = {SOFOF_ODD_PROGRAM};
    setup.how.command.insert(setup.how.command.end(), words.begin(),
                             words.end());
    setup.configuration = "service=odd\n";
    setup.activation = "station=7\n";
    setup.most_octets = 1000;
    setup.answer_limit = 10'000ms; // only hung programs take longer
    setup.start_limit = waits ? 10'000ms : 100ms;
    setup.waits_for_start = waits;
  }

  void start() {
    program.emplace(setup, [this](const program_news& x) {
      news += x.is_there ? "there. " : x.why + ". ";
    });
    program->configure(now);
    program->activate(now);
  }

  std::string ask(std::string_view text) {
    now += 100ms;
    return text_of(program->exchange(now, octets_of(text)));
  }

  kept_setup setup;
  std::optional<kept_program> program;
  time_point now;
  std::string news;
};

/// Looks at a program until it is ready.
bool wait_for_id(kept& of) {
  const auto before = of.news.size();
  for (int k = 0; k < 200; ++k) {
    std::this_thread::sleep_for(1ms);
    of.program->look(of.now);
    if (of.news.size() > before)
      return true;
  }
  return of.program->id().has_value();
}

} // namespace

TEST_CASE("a program answers each input, and is told each step of its life") {
  kept echo{{}};
  echo.start();
  CHECK(echo.ask("one") == "one");
  CHECK(echo.ask("") == "");
  kept steps{{"tells_its_steps"}};
  steps.start();
  CHECK(steps.ask("?") == "service=odd on station=7 ");
  steps.program->deactivate(steps.now);
  steps.program->activate(steps.now);
  CHECK(steps.ask("?") == "service=odd on station=7 off on station=7 ");
  const auto id = steps.program->id();
  steps.program->shut_down(steps.now);
  CHECK(id);
  CHECK(kill(*id, 0) == -1);
  CHECK(steps.ask("?") == "nothing");
  CHECK(steps.news.empty());
}

TEST_CASE("an input that has no result is no mistake") {
  kept none{{"has_none"}};
  none.start();
  CHECK(none.ask("one") == "nothing");
  CHECK(none.ask("two") == "nothing");
  CHECK(none.news.empty());
}

TEST_CASE("a program that dies is there again after a pause, and as it was") {
  kept mortal{{"dies", "2"}};
  mortal.start();
  CHECK(mortal.ask("one") == "one");
  CHECK(mortal.ask("two") == "two");
  CHECK(mortal.ask("three") == "nothing");
  CHECK(mortal.news == "was ended by signal 9 (Killed). ");
  CHECK(mortal.ask("four") == "nothing"); // 100 ms later
  mortal.now += 400ms;
  CHECK(mortal.ask("five") == "five");
  CHECK(mortal.news == "was ended by signal 9 (Killed). there. ");
}

TEST_CASE("a result counts, whatever the program does behind it") {
  for (const auto* what : {"answers_and_exits", "answers_and_babbles"})
    for (int k = 0; k < 20; ++k) {
      kept last{{what, "1"}};
      last.start();
      CHECK(last.ask("one") == "one");
      CHECK(last.ask("two") == "two");
      CHECK(last.news.empty());
      CHECK(last.ask("three") == "nothing");
      CHECK_FALSE(last.news.empty());
    }
  kept twice{{"answers_twice", "1"}};
  twice.start();
  for (const auto* text : {"one", "two", "three", "four"})
    CHECK(twice.ask(text) == text);
  CHECK(twice.news.empty());
}

TEST_CASE("a program has ended also when others have its files open") {
  kept parent{{"leaves_another", "1"}};
  parent.start();
  CHECK(parent.ask("one") == "one");
  const auto start = std::chrono::steady_clock::now();
  CHECK(parent.ask("two") == "nothing");
  CHECK(std::chrono::steady_clock::now() - start < 5s);
  CHECK(parent.news == "exited with 4. ");
}

TEST_CASE("a program that has been started before is taken as it is") {
  kept ready{{"tells_its_process"}};
  auto started = start_program(ready.setup);
  const auto id = std::to_string(started->id());
  ready.setup.take_started = [&] { return std::move(started); };
  ready.start();
  CHECK(ready.ask("?") == id);
  kill(std::stoi(id), SIGKILL);
  CHECK(ready.ask("?") == "nothing");
  ready.now += 500ms; // there is no other one: it is started
  const auto other = ready.ask("?");
  REQUIRE(ready.program->id());
  CHECK(other == std::to_string(*ready.program->id()));
}

TEST_CASE("spare programs are there before they are needed, and reaped") {
  const kept ready{{"tells_its_process"}};
  spare_programs spares{ready.setup, 2};
  const auto first = spares.take();
  const auto second = spares.take();
  REQUIRE(first);
  REQUIRE(second);
  CHECK(first->id() != second->id());
  kill(second->id(), SIGKILL); // not a spare any more
  spares.look();
  CHECK(spares.take());
  const kept none{{}};
  auto missing = none.setup;
  missing.how.command = {"no_such_program"};
  CHECK(!spare_programs(missing, 3).take());
  CHECK(!spare_programs(ready.setup, 0).take());
}

TEST_CASE("whoever dies at once is started less and less often") {
  kept brief{{"exits", "0"}};
  brief.start();
  int deaths = 0;
  for (int k = 0; k < 100; ++k) { // 10 s
    const auto before = brief.news.size();
    CHECK(brief.ask("?") == "nothing");
    if (brief.news.size() > before)
      ++deaths;
  }
  CHECK(deaths >= 4);
  CHECK(deaths <= 6); // after 0.5, 1, 2, 4 … s
}

TEST_CASE("who has lived for a while before it dies is there again soon") {
  kept mortal{{}};
  mortal.start();
  for (int k = 0; k < 6; ++k) {
    CAPTURE(k);
    REQUIRE(wait_for_id(mortal));
    mortal.now += 2s; // without any input
    kill(*mortal.program->id(), SIGKILL);
    for (int wait = 0; wait < 10'000 && mortal.program->id(); ++wait) {
      std::this_thread::sleep_for(1ms);
      mortal.program->look(mortal.now);
    }
    mortal.now += 500ms;
    mortal.program->look(mortal.now);
    CHECK(mortal.program->id());
  }
}

TEST_CASE("what a program does wrong is said, and it is ended") {
  const auto all = std::to_array<std::pair<std::string, std::string>>({
      {"exits", "exited with 3. "},
      {"is_silent", "did not answer in time. "},
      {"closes", "closed its output. "},
      {"babbles", "did not answer in time. "},
      {"talks_nonsense",
       "sent a frame of kind 28261 with 24948 behind it; a program sends 16 to "
       "18, and 0. "},
      {"sends_much", "sent a frame of 100000 octets; 1000 are the most. "},
      {"foresees", "answered input 3, which it was not given. "},
  });
  for (const auto& [what, why] : all) {
    CAPTURE(what);
    kept odd{{what, "1"}};
    if (why == "did not answer in time. ")
      odd.setup.answer_limit = 1'000ms;
    odd.start();
    CHECK(odd.ask("one") == "one");
    CHECK(odd.ask("two") == "nothing");
    CHECK(odd.news == why);
    CHECK(!odd.program->id());
  }
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1); // no zombies
}

TEST_CASE("a program that eats memory ends, and nobody else") {
  kept greedy{{"eats", "1"}};
  greedy.setup.how.limits.memory_octets = 256 << 20;
  greedy.start();
  CHECK(greedy.ask("one") == "one");
  CHECK(greedy.ask("two") == "nothing");
  CHECK(greedy.news == "was ended by signal 11 (Segmentation fault). ");
}

TEST_CASE("where nobody waits, a program gets inputs once it is ready") {
  kept late{{"never_ready"}, false};
  late.start();
  CHECK(late.ask("one") == "nothing");
  CHECK(late.news.empty());
  std::this_thread::sleep_for(120ms);
  CHECK(late.ask("two") == "nothing");
  CHECK(late.news == "was not ready after 100 ms. ");
}

TEST_CASE("a death is found without an input, too") {
  kept brief{{"ends_at_once"}, false};
  brief.start();
  for (int k = 0; k < 1000 && brief.news.empty(); ++k) {
    std::this_thread::sleep_for(1ms);
    brief.program->look(brief.now);
  }
  CHECK(brief.news == "exited with 3. ");
}

TEST_CASE("a program that cannot be started is one that has died") {
  kept none{{}};
  none.setup.how.command = {"/no/such/program"};
  none.start();
  CHECK(none.news == "there is no program \"/no/such/program\".. ");
  CHECK(none.ask("?") == "nothing");
}

TEST_CASE("frames that are cut or changed anywhere are refused or waited for") {
  octets stream;
  for (std::uint64_t k = 1; k <= 3; ++k)
    append_frame(stream, frame_kind::result, -5, k, octets_of("some content"));
  std::mt19937 draws{1};
  for (int k = 0; k < 2000; ++k) {
    auto changed = stream;
    changed[draws() % changed.size()] = static_cast<std::byte>(draws());
    frame_parser parser{100};
    std::size_t at = 0, frames = 0, most = 0;
    while (at < changed.size()) {
      const auto count =
          std::min<std::size_t>(draws() % 20, changed.size() - at);
      parser.add(std::span{changed}.subspan(at, count));
      at += count;
      while (const auto frame = parser.next()) {
        ++frames;
        most = std::max(most, frame->octets.size());
      }
    }
    CHECK(frames <= 3);
    CHECK(most <= 100);
  }
  frame_parser parser{100};
  for (const auto octet : stream)
    parser.add({&octet, 1});
  const auto first = parser.next();
  REQUIRE(first);
  CHECK(first->time_ns == -5);
  CHECK(first->number == 1);
  CHECK(text_of(first->octets) == "some content");
}

} // namespace sofof::program_test

// What programs may answer, and what is said of what they may not.
#include "programs/answers.hpp"

#include "tests/programs/asked_program.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace sofof;
using namespace sofof::programs;
using namespace sofof::test;

namespace sofof::answers_of_programs {

using policies::local_decision;

struct local_question : asked_vehicle {
  kept_words words;

  local_decision read(std::string_view line) {
    return read_answer(line, 7, seen, words);
  }
  std::string error(std::string_view line) {
    try {
      read(line);
    } catch (const answer_error& problem) {
      return problem.what();
    }
    return {};
  }
};

struct central_question : asked_provider {
  kept_words words;

  std::vector<policies::central_decision> read(std::string_view line) {
    const auto context = seen();
    return read_answer(line, 7, context, words);
  }
  std::string error(std::string_view line) {
    try {
      read(line);
    } catch (const answer_error& problem) {
      return problem.what();
    }
    return {};
  }
};

TEST_CASE("a program says who it is and what it wants") {
  const auto plain = read_hello(R"({"sofof":1,"name":"mine"})");
  CHECK(plain.name == "mine");
  CHECK(plain.version.empty());
  CHECK_FALSE(plain.wanted.tells);
  const auto full =
      read_hello(R"({"sofof":1,"name":"mine","version":"2","tells":true,)"
                 R"("forecast":true,"scene":true,"chain":false})");
  CHECK(full.version == "2");
  CHECK(full.wanted.tells);
  CHECK(full.wanted.forecast);
  CHECK(full.wanted.scene);
  CHECK_FALSE(full.wanted.chain);
}

TEST_CASE("of another version, without a name, or with unknown members it is "
          "not understood") {
  for (const auto* line :
       {"", "hello", "[]", R"({"sofof":2,"name":"mine"})", R"({"sofof":1})",
        R"({"sofof":1,"name":""})", R"({"sofof":1,"name":"mine","vers":"1"})",
        R"({"sofof":1,"name":"mine","version":1})",
        R"({"sofof":1,"name":"m\u00fcller"})",
        R"({"sofof":1,"sofof":1,"name":"mine"})",
        R"({"sofof":1,"name":"mine","tells":1})"}) {
    CAPTURE(line);
    CHECK_THROWS_AS(read_hello(line), answer_error);
  }
}

TEST_CASE_FIXTURE(local_question, "a vehicle is told to go, to stay or to come "
                                  "home") {
  const auto go = read(R"({"n":7,"do":"run_at","provider":65538,)"
                       R"("second":{"provider":65537,"hedge_after_s":0.02},)"
                       R"("advantage":0.5,"why":"the nearest"})");
  const auto* there = std::get_if<policies::run_at>(&go.what);
  REQUIRE(there);
  CHECK(there->provider == 65538);
  REQUIRE(there->second);
  CHECK(there->second->provider == 65537);
  CHECK(there->second->hedge_after == std::chrono::milliseconds{20});
  CHECK(there->advantage == 0.5);
  CHECK(go.why.text() == "the nearest");
  const auto here = read(R"({"n":7,"do":"stay"})");
  CHECK(std::holds_alternative<policies::stay>(here.what));
  CHECK(here.why.text() == "the program says so");
  CHECK(std::holds_alternative<policies::stay>(
      read(R"({"n":7,"do":"come_home"})").what)); // it is there
  seen.current = 65537;
  CHECK(std::holds_alternative<policies::come_home>(
      read(R"({"n":7,"do":"come_home"})").what));
}

TEST_CASE_FIXTURE(local_question, "where a service runs it may stay, though "
                                  "nobody else comes into question") {
  seen.current = 65999;
  seen.providers = {};
  CHECK(error(R"({"n":7,"do":"run_at","provider":65999})") == "");
  CHECK(error(R"({"n":7,"do":"run_at","provider":65537})") != "");
}

TEST_CASE_FIXTURE(local_question, "what is wrong with an answer is said of the "
                                  "member that is wrong") {
  constexpr std::array<std::array<const char*, 2>, 20> wrong{{
      {"", "must be a JSON object"},
      {R"({"n":7,"do":"stay")", "must be a JSON object"},
      {R"(7)", "must be a JSON object"},
      {R"({"do":"stay"})", "must have \"n\""},
      {R"({"n":8,"do":"stay"})", "\"n\" must be 7"},
      {R"({"n":7.0,"do":"stay"})", "\"n\" must be a whole number"},
      {R"({"n":7,"do":"fly"})", "\"do\" must be \"stay\""},
      {R"({"n":7,"do":"stay","do":"stay"})", "\"do\" only once"},
      {R"({"n":7,"do":"stay","\u001b[2J\u009bx":1})",
       "\"?[2J??x\" is unknown here"},
      {R"({"n":7,"\u001b[2J":1,"\u001b[2J":1})", "\"?[2J\" only once"},
      {R"({"n":7,"do":"stay","whi":"x"})", "\"whi\" is unknown"},
      {R"({"n":7,"do":"stay","provider":65537})", "\"provider\" is unknown"},
      {R"({"n":7,"do":"run_at"})", "must have \"provider\""},
      {R"({"n":7,"do":"run_at","provider":1})", "one of those in question"},
      {R"({"n":7,"do":"run_at","provider":-1})", "whole number"},
      {R"({"n":7,"do":"run_at","provider":65537,"second":65538})",
       "\"second\" must be an object"},
      {R"({"n":7,"do":"run_at","provider":65537,)"
       R"("second":{"provider":65537}})",
       "another provider"},
      {R"({"n":7,"do":"run_at","provider":65537,"advantage":1e999})",
       "must be a JSON object"},
      {R"({"n":7,"do":"stay","why":"a\nb"})", "printable ASCII"},
      {"{\"n\":7,\"do\":\"stay\",\"why\":\"\xff\"}", "must be a JSON object"},
  }};
  for (const auto& [line, says] : wrong) {
    CAPTURE(line);
    CHECK(contains(error(line), says));
  }
  const std::string deep(1000, '[');
  CHECK(contains(error("{\"n\":" + deep), "nested"));
}

TEST_CASE_FIXTURE(local_question,
                  "reasons of a program that has too many are not kept") {
  for (int k = 0; k < 300; ++k)
    CHECK(words.keep(std::to_string(k))
          == (k < 256 ? std::to_string(k) : "the program's reason"));
  CHECK(words.keep("17") == "17");
}

TEST_CASE_FIXTURE(central_question, "a provider is told of each request, and "
                                    "of sessions where the program likes") {
  const auto some = read(R"({"n":7,"requests":[{"accept":true,"worker":3,)"
                         R"("offset_s":0.02,"why":"room"},)"
                         R"({"accept":false,"instead":65538}]})");
  REQUIRE(some.size() == 2);
  const auto* terms = policies::terms_of(some[0]);
  REQUIRE(terms);
  CHECK(terms->worker == 3);
  CHECK(terms->offset == std::chrono::milliseconds{20});
  const auto* no = std::get_if<policies::refused>(&some[1].what);
  REQUIRE(no);
  CHECK(no->instead == provider_id{65538});
  const auto all = read(R"({"n":7,"requests":[{"accept":true},)"
                        R"({"accept":true}],"sessions":[{"accept":false}]})");
  REQUIRE(all.size() == 3);
  CHECK_FALSE(policies::terms_of(all[2]));
}

TEST_CASE_FIXTURE(central_question, "of each request something has to be "
                                    "said, within what there is") {
  constexpr std::array<std::array<const char*, 2>, 8> wrong{{
      {R"({"n":7,"requests":[{"accept":true}]})",
       "\"requests\" must have 2 entries"},
      {R"({"n":7,"requests":true})", "\"requests\" must be a list"},
      {R"({"n":7,"requests":[{"accept":true},{"accept":1}]})",
       "\"requests[1].accept\" must be true or false"},
      {R"({"n":7,"requests":[{"accept":true},true]})",
       "\"requests[1]\" must be an object"},
      {R"({"n":7,"requests":[{"accept":true,"worker":4},{"accept":true}]})",
       "\"requests[0].worker\" must be below 4"},
      {R"({"n":7,"requests":[{"accept":true,"offset_s":0.1},)"
       R"({"accept":true}]})",
       "below the period"},
      {R"({"n":7,"requests":[{"accept":true,"instead":1},{"accept":true}]})",
       "\"requests[0].instead\" is unknown"},
      {R"({"n":7,"requests":[{"accept":true},{"accept":true}],)"
       R"("sessions":[]})",
       "\"sessions\" must have 1 entries"},
  }};
  for (const auto& [line, says] : wrong) {
    CAPTURE(line);
    CHECK(contains(error(line), says));
  }
}

TEST_CASE_FIXTURE(central_question,
                  "mutated answers are understood or refused") {
  local_question car;
  dice random{28};
  const std::array<std::string, 3> right{
      R"({"n":7,"do":"run_at","provider":65538,"second":)"
      R"({"provider":65537,"hedge_after_s":0.02},"why":"x"})",
      R"({"n":7,"requests":[{"accept":true,"worker":3,"offset_s":0.02},)"
      R"({"accept":false,"instead":65538}],"sessions":[{"accept":true}]})",
      R"({"sofof":1,"name":"mine","version":"2","tells":true})"};
  int refused = 0;
  constexpr int tries = 30'000;
  for (int k = 0; k < tries; ++k) {
    const auto which = static_cast<std::size_t>(k % 3);
    auto line = right[which];
    for (auto changes = 1 + k % 4; changes > 0; --changes) {
      const auto at = static_cast<std::size_t>(
          random.between(0, static_cast<double>(line.size()) - 0.001));
      if (k % 2)
        line[at] = static_cast<char>(random.between(-128, 128));
      else
        line.erase(at, 1);
      if (line.empty())
        line = "{";
    }
    try {
      if (which == 0)
        car.read(line);
      else if (which == 1)
        read(line);
      else
        read_hello(line);
    } catch (const answer_error& problem) {
      ++refused;
      REQUIRE(std::string_view{problem.what()}.size() > 4);
    }
  }
  CHECK(refused > tries / 2);
  CHECK(refused < tries);
}

} // namespace sofof::answers_of_programs

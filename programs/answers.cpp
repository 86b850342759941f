// From lines of a program to decisions.
#include "programs/answers.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "programs/json_members.hpp"
#include <algorithm>
#include <cassert>
#include <optional>

namespace sofof::programs {

namespace {

using namespace policies;

constexpr std::size_t longest_name = 64;
constexpr std::size_t longest_reason = 80;
constexpr double longest_hedge_s = 3600;
constexpr double greatest_advantage = 1e9;

/// @returns printable ASCII characters.
std::string words(json_members& of, std::string_view name, std::size_t least,
                  std::size_t most) {
  auto text = of.text(name);
  const auto is_plain =
      std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
  if (!is_plain || text.size() < least || text.size() > most)
    of.refuse(name, fmt::format("must be {} to {} printable ASCII characters",
                                least, most));
  return text;
}

reason why(json_members& of, kept_words& kept) {
  constexpr std::string_view unsaid = "the program says so";
  const auto text =
      of.has("why") ? words(of, "why", 0, longest_reason) : std::string{};
  return text.empty() ? unsaid : kept.keep(text);
}

bool wish(json_members& of, std::string_view name) {
  return of.has(name) && of.flag(name);
}

void expect_number(json_members& of, std::uint64_t n) {
  if (of.count("n") != n)
    of.refuse("n", fmt::format("must be {}, as in the ask", n));
}

/// @returns one that is in question.
provider_id provider(json_members& of, const local_context& context) {
  const provider_id id{of.count("provider")};
  const auto& all = context.providers;
  if (id != context.current
      && std::ranges::find(all, id, &provider_view::id) == all.end())
    of.refuse("provider", "must be one of those in question, or where it runs");
  return id;
}

std::optional<second_provider> second(json_members& of,
                                      const local_context& context) {
  if (!of.has("second"))
    return std::nullopt;
  json_members inner{of.need("second"), "second."};
  second_provider found{provider(inner, context)};
  if (inner.has("hedge_after_s"))
    found.hedge_after =
        from_seconds(inner.number("hedge_after_s", 0, longest_hedge_s));
  inner.finish();
  return found;
}

run_at run_there(json_members& of, const local_context& context) {
  run_at there{.provider = provider(of, context),
               .second = second(of, context)};
  if (there.second && there.second->provider == there.provider)
    of.refuse("second", "must be another provider than the first");
  if (of.has("advantage"))
    there.advantage =
        of.number("advantage", -greatest_advantage, greatest_advantage);
  return there;
}

/// @param period  Of the service.
central_decision verdict(const nlohmann::json& entry, std::string where,
                         const central_context& context, duration period,
                         kept_words& kept) {
  json_members of{entry, std::move(where)};
  central_decision decision;
  if (of.flag("accept")) {
    accepted terms;
    if (of.has("worker"))
      terms.worker = of.count("worker");
    if (terms.worker >= std::max<std::size_t>(context.workers, 1))
      of.refuse("worker", fmt::format("must be below {}", context.workers));
    if (of.has("offset_s")) {
      terms.offset = from_seconds(of.number("offset_s", 0, to_seconds(period)));
      if (*terms.offset >= period)
        of.refuse("offset_s", "must be below the period");
    }
    decision.what = terms;
  } else if (of.has("instead")) {
    decision.what = refused{provider_id{of.count("instead")}};
  }
  decision.why = why(of, kept);
  of.finish();
  return decision;
}

/// @param of_what  Requests or sessions: each has a `task`.
void read_verdicts(json_members& of, std::string_view name, auto of_what,
                   const central_context& context, kept_words& kept,
                   std::vector<central_decision>& to) {
  const auto& all = of.list(name);
  if (all.size() != of_what.size())
    of.refuse(name, fmt::format("must have {} entries", of_what.size()));
  for (std::size_t k = 0; k < all.size(); ++k)
    to.push_back(verdict(all[k], fmt::format("{}[{}].", name, k), context,
                         of_what[k].task.period, kept));
}

} // namespace

std::string_view kept_words::keep(std::string_view words) {
  const auto found = all_.find(words);
  if (found != all_.end())
    return *found;
  if (all_.size() == most)
    return "the program's reason";
  return *all_.emplace(words).first;
}

hello_answer read_hello(std::string_view line) {
  const auto object = parse_object(line);
  json_members of{*object};
  if (of.count("sofof") != protocol_version)
    of.refuse("sofof", fmt::format("must be {}, the version of the protocol "
                                   "that this SOFOF speaks",
                                   protocol_version));
  hello_answer self;
  self.name = words(of, "name", 1, longest_name);
  if (of.has("version"))
    self.version = words(of, "version", 1, longest_name);
  self.wanted = {.tells = wish(of, "tells"),
                 .forecast = wish(of, "forecast"),
                 .scene = wish(of, "scene"),
                 .chain = wish(of, "chain")};
  of.finish();
  return self;
}

local_decision read_answer(std::string_view line, std::uint64_t n,
                           const local_context& context, kept_words& kept) {
  assert(n >= 1);
  const auto object = parse_object(line);
  json_members of{*object};
  expect_number(of, n);
  local_decision decision;
  const auto what = of.text("do");
  if (what == "run_at")
    decision.what = run_there(of, context);
  else if (what == "stay")
    decision.what = stay{second(of, context)};
  else if (what != "come_home")
    of.refuse("do", "must be \"stay\", \"come_home\" or \"run_at\"");
  else if (context.current)
    decision.what = come_home{};
  decision.why = why(of, kept);
  of.finish();
  return decision;
}

std::vector<central_decision> read_answer(std::string_view line,
                                          std::uint64_t n,
                                          const central_context& context,
                                          kept_words& kept) {
  assert(n >= 1);
  const auto object = parse_object(line);
  json_members of{*object};
  expect_number(of, n);
  std::vector<central_decision> all;
  read_verdicts(of, "requests", context.requests, context, kept, all);
  if (of.has("sessions"))
    read_verdicts(of, "sessions", context.sessions, context, kept, all);
  of.finish();
  return all;
}

} // namespace sofof::programs

// What a program that decides is told and asked: docs/policy_process.md.
#pragma once

#include "policies/api/context.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace sofof::programs {

/// The version of the protocol.
inline constexpr std::uint64_t protocol_version = 1;

/// What a program wants, as it says when it is greeted.
struct wishes {
  bool tells = false;    ///< To be told what came of decisions.
  bool forecast = false; ///< `local_context::forecasts`,
  bool scene = false;    ///< `local_context::safe_response`,
  bool chain = false;    ///< `local_context::chain`.
};

/// Each appends a line with its end.
/// @param side  "lodm" or "codm".
void append_hello(std::string& to, std::string_view side,
                  std::string_view scenario, std::uint64_t seed);
/// @param n  Of the ask, from 1 on.
void append_ask(std::string& to, std::uint64_t n,
                const policies::local_context& context, const wishes& wanted);
void append_ask(std::string& to, std::uint64_t n,
                const policies::central_context& context);
void append_told(std::string& to, const policies::cycle_outcome& outcome);
void append_told(std::string& to, const policies::refusal_outcome& outcome);
void append_told(std::string& to, const policies::episode_outcome& outcome);
void append_bye(std::string& to);

} // namespace sofof::programs

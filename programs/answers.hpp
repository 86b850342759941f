// What a program that decides answers: docs/policy_process.md.
#pragma once

#include "policies/api/context.hpp"

#include "programs/messages.hpp"
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::programs {

/// A line of a program has at most so many octets, its end included.
inline constexpr std::size_t longest_answer = 65'536;

/// What speaks against an answer; starts like "it must ...".
class answer_error : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// What a program says of itself.
struct hello_answer {
  std::string name;
  std::string version; ///< Empty: it says none.
  wishes wanted;
};

/// Keeps the words of reasons as long as it lives.
class kept_words {
public:
  /// @returns the same words; of more than `most` different ones others.
  std::string_view keep(std::string_view words);

private:
  static constexpr std::size_t most = 256;
  std::set<std::string, std::less<>> all_;
};

/// Each reads a line without its end. @throws answer_error.
hello_answer read_hello(std::string_view line);
/// @param n        Of the ask.
/// @param context  That was asked about: nobody else is chosen.
/// @param words    Outlives the decision.
policies::local_decision read_answer(std::string_view line, std::uint64_t n,
                                     const policies::local_context& context,
                                     kept_words& words);
/// @returns a decision for each request, and, if there are any, for each
/// session.
std::vector<policies::central_decision>
read_answer(std::string_view line, std::uint64_t n,
            const policies::central_context& context, kept_words& words);

} // namespace sofof::programs

// What a file of a policy, a filter or a governor defines, and the tables that
// CMake makes of these files consist of.
#pragma once

#include "policies/api/filter.hpp"
#include "policies/api/governor.hpp"
#include "policies/api/notes.hpp"
#include "policies/filtered.hpp"

#include <memory>

namespace sofof::policies {

/// Something that decides, by the name in its notes, which is that of its file.
template <class Decider>
struct policy_entry {
  policy_info notes;
  std::unique_ptr<Decider> (*make)(); ///< With its default options.
};

/// Of policies/lodm/NAME.cpp, which defines lodm_NAME().
using lodm_entry = policy_entry<local_policy>;
/// Of policies/codm/NAME.cpp, which defines codm_NAME().
using codm_entry = policy_entry<central_policy>;
/// Of policies/filters/NAME.cpp, which defines local_filter_NAME().
using local_filter_entry = policy_entry<local_filter>;
/// Of the same file, which also defines central_filter_NAME().
using central_filter_entry = policy_entry<central_filter>;
/// Of policies/governors/NAME.cpp, which defines governor_NAME().
using governor_entry = policy_entry<governor>;

/// Makes one as it is, without a filter before it.
template <class Decider, class Whole>
std::unique_ptr<Decider> unfiltered() {
  return std::make_unique<Whole>();
}

/// Makes a policy that chooses among what a filter lets through.
template <class Choice>
std::unique_ptr<local_policy> filtered_by_provider() {
  return std::make_unique<filtered_lodm>(std::make_unique<Choice>());
}
template <class Choice>
std::unique_ptr<central_policy> filtered_by_request() {
  return std::make_unique<filtered_codm>(std::make_unique<Choice>());
}

} // namespace sofof::policies

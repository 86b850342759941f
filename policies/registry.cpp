// Policies by name: the one place that knows them all.
#include "policies/registry.hpp"

#include "policies/baselines.hpp"
#include "policies/capacity.hpp"
#include "policies/choices.hpp"
#include "policies/composition.hpp"
#include "policies/deadline_admission.hpp"
#include "policies/location.hpp"

#include <array>
#include <cstddef>

namespace sofof {

namespace {

/// How to make one, and what to say of it; apart, so that notes are a list.
template <class Policy, std::size_t Count>
struct family {
  std::array<policy_notes, Count> notes;
  std::array<std::unique_ptr<Policy> (*)(), Count> makers;

  std::unique_ptr<Policy> make(std::string_view name) const {
    for (std::size_t i = 0; i < Count; ++i)
      if (notes[i].name == name)
        return makers[i]();
    return nullptr;
  }

  std::vector<std::string_view> names() const {
    std::vector<std::string_view> all;
    for (const auto& note : notes)
      all.push_back(note.name);
    return all;
  }
};

template <class Policy, class Whole, auto... Arguments>
std::unique_ptr<Policy> whole() {
  return std::make_unique<Whole>(Arguments...);
}

template <class Choice>
std::unique_ptr<local_policy> filtered_local() {
  return std::make_unique<filtered_lodm>(std::make_unique<Choice>());
}

template <class Choice>
std::unique_ptr<central_policy> filtered_central() {
  return std::make_unique<filtered_codm>(std::make_unique<Choice>());
}

constexpr auto our_own = "ours, to compare with";
constexpr auto the_paper = "Dehler & Buchholz, IEEE RA-L 10(5), 2025";

constexpr family<local_policy, 6> lodms{
    {{
        {"location",
         "Asks as soon as the way ahead stays long enough near a provider.",
         "d_passed > d_min, the way on the planned path before it leaves the "
         "disc of radius r_off round the provider",
         "the planned path, where providers are", the_paper},
        {"always", "Asks whoever offers.", "yes", "nothing", our_own},
        {"never", "Plans on board, whatever is offered.", "no", "nothing",
         our_own},
        {"random", "Asks by the toss of a coin.",
         "U < probability; then any provider", "nothing", our_own},
        {"nearest", "Asks the nearest provider.", "min |x_provider - x|",
         "where providers are", our_own},
        {"least_loaded", "Asks the less loaded of two providers.",
         "min utilisation of two providers drawn at random, if below `most`",
         "the utilisation that offers tell",
         "Mitzenmacher, IEEE TPDS 12(10), 2001 (two choices)"},
    }},
    {{
        whole<local_policy, location_lodm>,
        whole<local_policy, constant_lodm, true>,
        whole<local_policy, constant_lodm, false>,
        filtered_local<random_choice>,
        filtered_local<nearest_choice>,
        filtered_local<least_loaded_choice>,
    }}};

constexpr family<central_policy, 5> codms{
    {{
        {"location", "Accepts vehicles that will stay long enough in the area.",
         "t_in_area >= t_min, the way on the route before it leaves the area "
         "by the present speed; and the whole route is on the map",
         "the route and the speed that requests tell", the_paper},
        {"always", "Accepts everybody.", "yes", "nothing", our_own},
        {"never", "Accepts nobody.", "no", "nothing", our_own},
        {"capacity", "Accepts as long as the workers have room.",
         "U + u <= most; u = mean computing time / (period workers)",
         "what runs, the mean computing time of a result",
         "utilisation test of Liu & Layland, J. ACM 20(1), 1973, per pool"},
        {"edf", "Accepts as long as every result can be in time.",
         "sum_j (floor((t - D_j) / T_j) + 1) C_j <= t for all deadlines t up "
         "to "
         "the busy period (demand); or an offset in the period for which no "
         "deadline is missed (phases)",
         "period, computing time, time limit and offset of all that runs",
         "Baruah, Rosier & Howell, RTSS 1990; phases are ours"},
    }},
    {{
        whole<central_policy, location_codm>,
        whole<central_policy, constant_codm, true>,
        whole<central_policy, constant_codm, false>,
        filtered_central<capacity_codm>,
        filtered_central<deadline_admission>,
    }}};

} // namespace

std::span<const policy_notes> lodm_notes() {
  return lodms.notes;
}

std::span<const policy_notes> codm_notes() {
  return codms.notes;
}

std::unique_ptr<local_policy> make_lodm(std::string_view name) {
  return lodms.make(name);
}

std::unique_ptr<central_policy> make_codm(std::string_view name) {
  return codms.make(name);
}

std::vector<std::string_view> lodm_names() {
  return lodms.names();
}

std::vector<std::string_view> codm_names() {
  return codms.names();
}

} // namespace sofof

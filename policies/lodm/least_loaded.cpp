// LODM "least_loaded": the power of two choices.
#include "policies/api/drawn_place.hpp"
#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

/// Asks the one with less utilisation of two drawn at random, unless it has no
/// room.
class least_loaded final : public local_policy {
public:
  local_decision decide(const local_context& context) override {
    const auto& all = context.providers;
    if (context.current)
      return as_it_is("it runs already");
    if (all.empty())
      return as_it_is("nobody comes into question");
    const auto& best = better_of_two(context);
    if (!(best.utilisation < most_)) // nor what is no number
      return as_it_is({"no room", best.utilisation, most_});
    return {run_at{best.id}, "the less loaded of two"};
  }
  void visit_options(option_visitor& s) override {
    s.field("most", most_, {0, 1e3});
  }
  std::string_view name() const override { return "least_loaded"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<least_loaded>(*this);
  }

private:
  static const provider_view& better_of_two(const local_context& context) {
    const auto& all = context.providers;
    constexpr std::uint32_t first = 0, step = 1;
    const auto place = drawn_place(context, first, all.size());
    const auto& one = all[place];
    if (all.size() == 1)
      return one;
    const auto steps = 1 + drawn_place(context, step, all.size() - 1);
    const auto& other = all[(place + steps) % all.size()];
    return other.utilisation < one.utilisation ? other : one;
  }

  double most_ = 1; // utilisation from which on nobody is asked
};

} // namespace

lodm_entry lodm_least_loaded() {
  return {{"least_loaded",
           "Asks the less loaded of two providers.",
           "min utilisation of two providers drawn at random, if below `most`",
           "the utilisation that offers tell",
           "Mitzenmacher, IEEE TPDS 12(10), 2001 (two choices)",
           {{"most", "1", "utilisation from which on nobody is asked"}}},
          filtered_by_provider<least_loaded>};
}

} // namespace sofof::policies

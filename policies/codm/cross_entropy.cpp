// CODM "cross_entropy": the best for all, sought by sampling.
#include "policies/algorithms/assignment/provider_assignment.hpp"
#include "policies/algorithms/assignment/sampled.hpp"
#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

/// The assignment's objective and limits; as good as sampling gets, but nobody
/// is sent home where there is room.
class sampled_assignment final : public central_policy {
public:
  std::vector<central_decision>
  decide(const central_context& context) override {
    const auto asked = assignment::problem_of(context, options_);
    auto found =
        sampled(asked.what,
                {.samples = static_cast<int>(samples_),
                 .elite = elite_,
                 .iterations = static_cast<int>(iterations_)},
                context.noise.part("cross entropy").part(context.number));
    fill_room(asked.what, found.choices);
    return decisions_of(context, asked, found);
  }
  void visit_options(option_visitor& s) override {
    options_.visit_options(s);
    s.field("samples", samples_, {1, 1e5});
    s.field("elite", elite_, {1e-3, 1});
    s.field("iterations", iterations_, {0, 1e4});
  }
  double epoch_s() const override { return options_.epoch_s; }
  std::string_view name() const override { return "cross_entropy"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<sampled_assignment>(*this);
  }

private:
  assignment::assignment_options options_;
  std::int64_t samples_ = 200; // of an iteration
  double elite_ = 0.1;         // share of the samples that is learned from
  std::int64_t iterations_ = 30;
};

} // namespace

codm_entry codm_cross_entropy() {
  return {{"cross_entropy",
           "Seeks by sampling what assignment reckons: who together win most.",
           "as assignment; each iteration draws samples, and moves the "
           "probabilities towards the frequencies among the best of them",
           "as assignment",
           "Rubinstein & Kroese 2004; the central optimum of Chen et al., ToN "
           "24(5), 2016",
           {{"epoch_s", "s", "that requests wait for each other"},
            {"price", "1", "of a change, in units of gains"},
            {"wait", "time", "for a worker that a result may have in the mean"},
            {"samples", "1", "drawn in each iteration"},
            {"elite", "1", "share of the samples that is learned from"},
            {"iterations", "1", "of drawing and learning"}}},
          filtered_by_request<sampled_assignment>};
}

} // namespace sofof::policies

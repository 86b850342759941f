// Simple ways to choose among providers that come into question.
#pragma once

#include "policies/context.hpp"

namespace sofof {

/// LODM "random": asks any of them, with a given probability.
class random_choice final : public local_policy {
public:
  local_decision decide(const local_context& context) override;
  void fields(settings& s) override;
  std::string_view name() const override { return "random"; }
  std::unique_ptr<local_policy> clone() const override;

private:
  double probability_ = 0.5; // of asking anybody
};

/// LODM "nearest": asks the one nearest to where the vehicle is now.
class nearest_choice final : public local_policy {
public:
  local_decision decide(const local_context& context) override;
  std::string_view name() const override { return "nearest"; }
  std::unique_ptr<local_policy> clone() const override;
};

/// LODM "least_loaded": asks the one with the least utilisation, of two drawn
/// at random ("the power of two choices": Mitzenmacher, IEEE TPDS 12(10) 2001),
/// unless none has room.
class least_loaded_choice final : public local_policy {
public:
  local_decision decide(const local_context& context) override;
  void fields(settings& s) override;
  std::string_view name() const override { return "least_loaded"; }
  std::unique_ptr<local_policy> clone() const override;

private:
  double most_ = 1; // utilisation from which on nobody is asked
};

} // namespace sofof

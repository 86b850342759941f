// A provider that could serve a vehicle, as the vehicle sees it.
#pragma once

#include "base/ids.hpp"

namespace sofof {

struct candidate {
  provider_id provider = 0;
  double gain = 0;        ///< What a cycle there costs less than one on board,
                          ///< weighed as in policies/api/gain.hpp.
  double utilisation = 0; ///< Of the provider, as it said.
  friend bool operator==(const candidate&, const candidate&) = default;
};

void visit_fields(auto& v, candidate& x) {
  v("provider", x.provider);
  v("gain", x.gain);
  v("utilisation", x.utilisation);
}

} // namespace sofof

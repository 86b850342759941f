// Parts of a response that did not occur count as no time, so that means of
// parts add up to the mean of all.
#include "recording/response_table.hpp"

namespace sofof::recording {

namespace {

/// @param provider  0: the vehicle.
void add_place(std::string& all, provider_id provider,
               const provider_names& names) {
  if (!all.empty())
    all += '>';
  all += provider == 0 ? "vehicle" : name_of(provider, names);
}

} // namespace

void split_responses::add(const messages::response_record& x) {
  all.add(x.response());
  waited_s.add(to_seconds(x.waited));
  services_s.resize(x.parts.size());
  for (std::size_t k = 0; k < x.parts.size(); ++k)
    services_s[k].add(to_seconds(x.parts[k].took.value_or(duration{0})));
  control_s.add(to_seconds(x.control));
  skipped += x.waited > duration{0};
}

std::string split_of(const messages::response_record& x,
                     const provider_names& names) {
  std::string all;
  for (const auto& part : x.parts)
    add_place(all, part.provider, names);
  return all;
}

std::string split_of(const messages::prediction_record& x,
                     const provider_names& names) {
  std::string all;
  for (const auto& place : x.split)
    add_place(all, place.value_or(0), names);
  return all;
}

} // namespace sofof::recording

// Text as what a registry of services says.
#include "network/mec/service_info.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <variant>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace sofof::network::mec011;
  const std::string text{data, data + size};
  (void)read_problem(text);
  const auto list = read_services(text);
  if (const auto* why = std::get_if<std::string>(&list))
    sofof::fuzz::require(!why->empty());
  else
    for (const auto& x : std::get<service_list>(list).services) {
      sofof::fuzz::require(!x.addresses.empty()
                           && x.addresses.size() <= most_addresses);
      const auto again = read_service(to_json(x));
      sofof::fuzz::require(std::get<service_info>(again) == x);
    }
  const auto one = read_service(text);
  sofof::fuzz::require(one.index() == 0 || !std::get<1>(one).empty());
  return 0;
}

// The smallest program that serves as a function: results are their inputs.
#include "examples/programs/service_program.hpp"

int main() {
  return service_program::serve(
      {[](const service_program::input& x) { return std::optional{x.what}; }});
}

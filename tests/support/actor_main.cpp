// The entry point of the test binaries that know our messages.
#define DOCTEST_CONFIG_IMPLEMENT
#include "messages/type_ids.hpp"

#include <caf/init_global_meta_objects.hpp>
#include <doctest/doctest.h>

int main(int argc, char** argv) {
  caf::init_global_meta_objects<caf::id_block::sofof>();
  caf::core::init_global_meta_objects();
  return doctest::Context(argc, argv).run();
}

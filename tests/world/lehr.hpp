// The map of Ulm-Lehr and its routes.
#pragma once

#include "tests/support/map_file.hpp"

namespace sofof::test {

inline const map_file& lehr() {
  static const auto file =
      read_map(SOFOF_SOURCE_DIR "/config/maps/ulm_lehr.toml");
  return file;
}

} // namespace sofof::test

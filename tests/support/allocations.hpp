// Counts what is asked of the heap, in test programs that are linked with
// tests/support/allocations.cpp.
#pragma once

namespace sofof::test {

/// Of this program until now.
extern long allocations;

} // namespace sofof::test

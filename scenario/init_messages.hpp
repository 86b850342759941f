// CAF and our messages.
#pragma once

namespace sofof::scenario {

/// Makes CAF know our messages; once per process, before any runtime.
void init_messages();

} // namespace sofof::scenario

#pragma once

namespace plaza {

/// True after request_stop() until the run that it was meant for has ended.
bool stop_requested() noexcept;

/// A run has ended: the next one starts unasked.
void clear_stop_request() noexcept;

}  // namespace plaza

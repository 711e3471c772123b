#pragma once

#include "core/stop_request.hpp"

namespace d2b {

/// Enables interrupts of GEOS in this process during its lifetime. GEOS calls one global function without
/// parameters in its larger loops, for all threads. Its interrupt flag is global as well: the first thread to
/// see it clears it, whoever requested it. Therefore the flag is not used. Instead, the callback throws,
/// which aborts only the current thread's call, like an exception of GEOS itself.
class GeosInterrupt {
  public:
    GeosInterrupt();
    GeosInterrupt(const GeosInterrupt&) = delete;
    GeosInterrupt& operator=(const GeosInterrupt&) = delete;
    ~GeosInterrupt();

    /// Makes GEOS calls of this thread fail soon after a stop is requested; callers then have to check
    /// `stop`. Must not be nested.
    class Watch {
      public:
        explicit Watch(const StopRequest& stop);
        Watch(const Watch&) = delete;
        Watch& operator=(const Watch&) = delete;
        ~Watch();
    };
};

}  // namespace d2b

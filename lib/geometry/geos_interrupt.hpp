#pragma once

#include "core/stop_request.hpp"

namespace d2b {

/// While one lives, GEOS may be stopped in this process. GEOS asks in the midst of its larger loops through a
/// function without a parameter, one for all threads. Its own request to stop is one for all threads as well:
/// the first thread to see it takes it away, whoever made it. So none is made: what GEOS asks throws, which
/// ends the call of this thread alone, as GEOS's own exception would.
class GeosInterrupt {
  public:
    GeosInterrupt();
    GeosInterrupt(const GeosInterrupt&) = delete;
    GeosInterrupt& operator=(const GeosInterrupt&) = delete;
    ~GeosInterrupt();

    /// While one lives, calls of GEOS from this thread fail soon after an end is asked for; who makes them
    /// then asks `stop` as well. Does not nest.
    class Watch {
      public:
        explicit Watch(const StopRequest& stop);
        Watch(const Watch&) = delete;
        Watch& operator=(const Watch&) = delete;
        ~Watch();
    };
};

}  // namespace d2b

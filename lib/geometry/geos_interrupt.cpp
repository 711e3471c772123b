#define GEOS_USE_ONLY_R_API
#include "geometry/geos_interrupt.hpp"

#include <mutex>

#include <geos_c.h>

namespace d2b {
namespace {

// Globals are unavoidable, because GEOS passes no argument to its callback.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
thread_local const StopRequest* watched = nullptr;
GEOSInterruptCallback* of_others = nullptr;  // previously registered callback
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

extern "C" void ask() {
    if (of_others != nullptr)
        of_others();
    if (watched != nullptr)
        watched->check();
}

struct Users {
    std::mutex mutex;
    int count = 0;
};

Users& users() {
    static Users all;
    return all;
}

}  // namespace

GeosInterrupt::GeosInterrupt() {
    Users& all = users();
    const std::lock_guard lock(all.mutex);
    if (all.count++ == 0)
        of_others = GEOS_interruptRegisterCallback(ask);
}

GeosInterrupt::~GeosInterrupt() {
    Users& all = users();
    const std::lock_guard lock(all.mutex);
    if (--all.count > 0)
        return;
    // Keep the callback of anyone who registered after us.
    if (GEOSInterruptCallback* last = GEOS_interruptRegisterCallback(of_others); last != ask)
        GEOS_interruptRegisterCallback(last);
}

GeosInterrupt::Watch::Watch(const StopRequest& stop) {
    watched = &stop;
}

GeosInterrupt::Watch::~Watch() {
    watched = nullptr;
}

}  // namespace d2b

#include "view/cairo.hpp"

#include <dlfcn.h>
#include <string>

#include "dem2buildings/error.hpp"

namespace d2b::view {

void* load_symbol(const char* library, const char* function) {
    // Never closed, because GLib and similar libraries do not support unloading.
    void* const opened = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
    void* const found = opened != nullptr ? dlsym(opened, function) : nullptr;
    if (found == nullptr) {
        const char* const reason = dlerror();  // NOLINT(concurrency-mt-unsafe): of this thread alone
        throw OutputError("The picture cannot be drawn (" +
                          std::string(reason != nullptr ? reason : library) +
                          "); install Pango 1.50 (on Debian: libpangocairo-1.0-0) or leave -preview out.");
    }
    return found;
}

}  // namespace d2b::view

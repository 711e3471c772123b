#include "view/cairo.hpp"

#include "core/system/process.hpp"

namespace d2b::view {

void* load_symbol(const char* library, const char* function) {
    if (!system::can_load_symbols())
        throw OutputError(
            "This program draws no pictures on this system; leave -preview out, and draw the layers in "
            "a GIS.");
    std::string reason;
    void* const found = system::load_symbol(library, function, reason);
    if (found == nullptr)
        throw OutputError("The picture cannot be drawn (" + reason +
                          "); install Pango 1.50 (on Debian: libpangocairo-1.0-0) or leave -preview out.");
    return found;
}

}  // namespace d2b::view

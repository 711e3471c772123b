#include "write/zlib.hpp"

#include <cstddef>
#include <memory>

#include <cpl_conv.h>
#include <cpl_string.h>

#include "dem2buildings/error.hpp"

namespace d2b::writing {

std::string zlib_compressed(std::string_view bytes) {
    constexpr int smallest = 9;
    std::size_t size = 0;
    const std::unique_ptr<void, decltype(&VSIFree)> packed(
        CPLZLibDeflate(bytes.data(), bytes.size(), smallest, nullptr, 0, &size), &VSIFree);
    if (!packed)
        throw OutputError("There is not enough memory to pack the page; use a smaller window (-te).");
    return {static_cast<const char*>(packed.get()), size};
}

}  // namespace d2b::writing

// Whatever a file between two steps of a run in tiles holds, its readers take it or name its
// fault; a file that they take speaks of nothing that is not there, and is written again as it was.
#include "core/byte_stream.hpp"
#include "fuzz/tile_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0)
        return 0;
    try {
        (void)d2b::test::read_tile_file(std::as_bytes(std::span(data, size)));
    } catch (const d2b::CorruptRecord&) {
        return 0;
    }
    return 0;
}

#include "read/standard_input.hpp"

#include <cstddef>
#include <span>
#include <vector>

#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"

namespace d2b {

bool is_standard_input(std::string_view source) {
    return source.starts_with("/vsistdin/") || source.starts_with("/vsistdin?");
}

KeptStandardInput::KeptStandardInput(const std::string& source)
    : file_("", "The standard input", FileName::kept) {
    constexpr std::size_t chunk = std::size_t{1} << 20;
    const GdalMessages messages;
    const GdalOwner<VSILFILE*, VSIFCloseL> from(VSIFOpenL(source.c_str(), "rb"));
    if (!from)
        throw InputError("The standard input cannot be read: " + messages.reason() + ".");
    std::vector<std::byte> buffer(chunk);
    while (const std::size_t got = VSIFReadL(buffer.data(), 1, chunk, from.get()))
        file_.append(std::span(buffer).first(got));
    if (file_.size() == 0)
        throw InputError("Nothing came in on the standard input; send a raster to it or give a file.");
}

std::unique_ptr<KeptStandardInput> keep_standard_input(const std::string& source) {
    return is_standard_input(source) ? std::make_unique<KeptStandardInput>(source) : nullptr;
}

}  // namespace d2b

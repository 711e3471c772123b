#include "preview/picture_format.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace d2b {

std::optional<PictureFormat> picture_format_of(const std::string& name) {
    std::string extension = std::filesystem::path(name).extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".png")
        return PictureFormat::png;
    if (extension == ".svg")
        return PictureFormat::svg;
    if (extension == ".pdf")
        return PictureFormat::pdf;
    return std::nullopt;
}

bool begins_a_picture(const std::string& beginning) {
    return beginning.starts_with("\x89PNG\r\n") || beginning.starts_with("%PDF-") ||
           beginning.find("<svg") != std::string::npos;
}

}  // namespace d2b

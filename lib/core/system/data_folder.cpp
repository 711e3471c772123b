#include "core/system/data_folder.hpp"

#include <array>
#include <system_error>

namespace d2b::system {

std::filesystem::path data_folder_of(const std::filesystem::path& object) {
    const std::filesystem::path folder = object.parent_path();
    for (const std::filesystem::path& above : std::array{folder, folder.parent_path()}) {
        std::filesystem::path data = above / "data";
        std::error_code error;
        // Both, because other programs have folders of this name.
        if (std::filesystem::is_directory(data / "gdal", error) &&
            std::filesystem::is_regular_file(data / "proj" / "proj.db", error))
            return data;
    }
    return {};
}

}  // namespace d2b::system

#include "read/temporary_folder.hpp"

#include <filesystem>
#include <system_error>

#include <cpl_conv.h>

namespace d2b {

std::string temporary_folder() {
    if (const char* folder = CPLGetConfigOption("CPL_TMPDIR", nullptr))
        return folder;
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    return error ? "/tmp" : folder.string();
}

}  // namespace d2b

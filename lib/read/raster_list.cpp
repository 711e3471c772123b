#include "read/raster_list.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "dem2buildings/error.hpp"

namespace d2b {

std::vector<std::string> listed_rasters(const std::string& list) {
    errno = 0;
    std::ifstream file(list, std::ios::binary);
    std::vector<std::string> names;
    // errno is kept because a folder can be opened but not read.
    for (std::string line; std::getline(file, line);) {
        line.erase(line.find_last_not_of(" \t\r") + 1);
        if (!line.empty())
            names.push_back(line);
    }
    if (!file.is_open() || file.bad() || (names.empty() && errno != 0))
        throw InputError("'" + list + "' cannot be read: " + std::generic_category().message(errno) +
                         "; give a text file with the name of a raster a line.");
    if (names.empty())
        throw InputError("'" + list + "' names no raster; write the name of one a line into it.");
    return names;
}

}  // namespace d2b

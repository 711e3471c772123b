#include "write/small_file.hpp"

#include <cerrno>
#include <fstream>
#include <random>
#include <system_error>
#include <unistd.h>

#include "dem2buildings/error.hpp"
#include "write/file_moves.hpp"

namespace d2b {

void write_small_file(const std::filesystem::path& path, const std::string& text) {
    // Process numbers of several machines may be the same.
    const std::filesystem::path hidden =
        path.parent_path() / ("." + path.filename().string() + "." + std::to_string(::getpid()) + "." +
                              std::to_string(std::random_device()()));
    try {
        {
            std::ofstream file(hidden, std::ios::binary);
            file << text;
            file.flush();
            if (!file)
                throw std::system_error(errno, std::generic_category());
        }
        sync_to_disk(hidden);
        std::filesystem::rename(hidden, path);
    } catch (const std::system_error& error) {
        std::error_code ignored;
        std::filesystem::remove(hidden, ignored);
        throw OutputError("\"" + path.string() + "\" cannot be written: " + error.code().message() +
                          "; make room for it, or let it be written to.");
    }
}

}  // namespace d2b

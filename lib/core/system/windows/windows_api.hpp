#pragma once

#include <array>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <random>
#include <string>

// Only for the sources of this folder, because this header defines common words as macros.
#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
// clang-format off
#include <windows.h>  // first, because the others need its names
#include <psapi.h>
#include <shellapi.h>
// clang-format on

namespace d2b::system {

/// Translates an error of Windows to a number of errno.
[[nodiscard]] inline int errno_of(DWORD error) {
    struct Pair {
        DWORD windows;
        int posix;
    };
    constexpr std::array pairs{Pair{ERROR_FILE_NOT_FOUND, ENOENT},     Pair{ERROR_PATH_NOT_FOUND, ENOENT},
                               Pair{ERROR_INVALID_NAME, ENOENT},       Pair{ERROR_ACCESS_DENIED, EACCES},
                               Pair{ERROR_SHARING_VIOLATION, EBUSY},   Pair{ERROR_LOCK_VIOLATION, EBUSY},
                               Pair{ERROR_WRITE_PROTECT, EROFS},       Pair{ERROR_DISK_FULL, ENOSPC},
                               Pair{ERROR_HANDLE_DISK_FULL, ENOSPC},   Pair{ERROR_ALREADY_EXISTS, EEXIST},
                               Pair{ERROR_FILE_EXISTS, EEXIST},        Pair{ERROR_NOT_ENOUGH_MEMORY, ENOMEM},
                               Pair{ERROR_TOO_MANY_OPEN_FILES, EMFILE}};
    for (const Pair& pair : pairs)
        if (pair.windows == error)
            return pair.posix;
    return EIO;
}

/// Sets errno to the last error of this thread. @return the number
inline int set_errno() {
    errno = errno_of(GetLastError());
    return errno;
}

/// Tries names with random letters in place of the last six until create(path) is true, or until there is
/// another error than that of a name that is taken.
template <class Create>
[[nodiscard]] bool try_random_names(std::string& pattern, const Create& create) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
    constexpr std::size_t length = 6;
    constexpr int most = 100;
    std::random_device random;
    for (int tries = 0; tries < most; ++tries) {
        for (std::size_t i = pattern.size() - length; i < pattern.size(); ++i)
            pattern[i] = letters[random() % letters.size()];
        if (create(std::filesystem::path(pattern)))
            return true;
        if (set_errno() != EEXIST)
            return false;
    }
    return false;
}

}  // namespace d2b::system

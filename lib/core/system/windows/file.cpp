#include "core/system/file.hpp"

#include <algorithm>

#include "core/system/windows/windows_api.hpp"

namespace d2b::system {
namespace {

/// Others may read, write, rename and remove an open file, as on other systems.
constexpr DWORD share_all = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

HANDLE handle_of(std::intptr_t handle) {
    return reinterpret_cast<HANDLE>(handle);
}

std::intptr_t open_file(const std::filesystem::path& path, DWORD access, DWORD creation, DWORD flags) {
    const HANDLE handle = CreateFileW(path.c_str(), access, share_all, nullptr, creation, flags, nullptr);
    if (handle == INVALID_HANDLE_VALUE)
        set_errno();
    return reinterpret_cast<std::intptr_t>(handle);
}

DWORD part_of(std::size_t bytes) {
    constexpr std::size_t most = std::size_t{1} << 30;
    return static_cast<DWORD>(std::min(bytes, most));
}

OVERLAPPED position(std::uint64_t begin) {
    constexpr int word = 32;
    OVERLAPPED place{};
    place.Offset = static_cast<DWORD>(begin);
    place.OffsetHigh = static_cast<DWORD>(begin >> word);
    return place;
}

}  // namespace

File::File(const std::filesystem::path& path, Mode mode)
    : handle_(mode == Mode::read ? open_file(path, GENERIC_READ, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL)
                                 : open_file(path, GENERIC_WRITE, CREATE_ALWAYS, FILE_ATTRIBUTE_NORMAL)) {}

File::File(std::string& pattern, Name name) {
    // An open file cannot lose its name here, so that the system removes it when it is closed.
    const DWORD flags = FILE_ATTRIBUTE_TEMPORARY | (name == Name::none ? FILE_FLAG_DELETE_ON_CLOSE : 0);
    static_cast<void>(try_random_names(pattern, [&](const std::filesystem::path& path) {
        handle_ = open_file(path, GENERIC_READ | GENERIC_WRITE | DELETE, CREATE_NEW, flags);
        return is_open();
    }));
}

File::~File() {
    if (is_open())
        CloseHandle(handle_of(handle_));
}

std::uint64_t File::size() const {
    LARGE_INTEGER length{};
    return GetFileSizeEx(handle_of(handle_), &length) != 0 ? static_cast<std::uint64_t>(length.QuadPart) : 0;
}

void File::disable_read_ahead() const {}

bool File::read(std::uint64_t begin, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        OVERLAPPED place = position(begin);
        DWORD done = 0;
        if (ReadFile(handle_of(handle_), bytes.data(), part_of(bytes.size()), &done, &place) == 0) {
            set_errno();
            return false;
        }
        if (done == 0) {
            errno = EIO;  // the file ends before
            return false;
        }
        begin += done;
        bytes = bytes.subspan(done);
    }
    return true;
}

bool File::write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
        DWORD done = 0;
        if (WriteFile(handle_of(handle_), bytes.data(), part_of(bytes.size()), &done, nullptr) == 0) {
            set_errno();
            return false;
        }
        bytes = bytes.subspan(done);
    }
    return true;
}

std::size_t File::write_at(std::uint64_t begin, std::span<const std::byte> bytes) const {
    OVERLAPPED place = position(begin);
    DWORD done = 0;
    if (WriteFile(handle_of(handle_), bytes.data(), part_of(bytes.size()), &done, &place) == 0)
        set_errno();
    else if (done == 0)
        errno = ENOSPC;
    return done;
}

bool File::sync() const {
    if (FlushFileBuffers(handle_of(handle_)) != 0)
        return true;
    set_errno();
    return false;
}

}  // namespace d2b::system

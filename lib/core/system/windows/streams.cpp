#include "core/system/streams.hpp"

#include <array>
#include <fcntl.h>
#include <io.h>

#include "core/system/windows/windows_api.hpp"

namespace d2b::system {
namespace {

constexpr int standard_input = 0;
constexpr int standard_output = 1;
constexpr int standard_error = 2;

bool is_terminal(int file) {
    DWORD mode = 0;
    return GetConsoleMode(reinterpret_cast<HANDLE>(_get_osfhandle(file)), &mode) != 0;
}

}  // namespace

void prepare_streams() {
    // Binary, because line ends would get a second byte otherwise, and a byte of 26 would end the input.
    for (const int file : std::array{standard_input, standard_output, standard_error})
        if (_get_osfhandle(file) >= 0)
            static_cast<void>(_setmode(file, _O_BINARY));
    if (is_terminal(standard_output) || is_terminal(standard_error))
        SetConsoleOutputCP(CP_UTF8);
}

bool are_terminals() {
    return is_terminal(standard_output) && is_terminal(standard_error);
}

std::FILE* divert_stdout() {
    const int copy = _dup(standard_output);
    if (copy < 0)
        return nullptr;
    std::FILE* const file = _fdopen(copy, "wb");
    if (file != nullptr && _dup2(standard_error, standard_output) < 0) {
        static_cast<void>(std::fclose(file));
        return nullptr;
    }
    return file;
}

void restore_stdout(std::FILE* copy) {
    static_cast<void>(_dup2(_fileno(copy), standard_output));
}

bool has_space(std::FILE* stream, std::uint64_t bytes) {
    const auto handle = reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(stream)));
    if (handle == INVALID_HANDLE_VALUE)
        return false;
    if (GetFileType(handle) != FILE_TYPE_DISK)
        return true;
    constexpr DWORD most = 32768;
    std::wstring path(most, L'\0');
    path.resize(GetFinalPathNameByHandleW(handle, path.data(), most, FILE_NAME_NORMALIZED));
    ULARGE_INTEGER free{};
    const std::wstring folder = std::filesystem::path(path).parent_path().wstring();
    return GetDiskFreeSpaceExW(folder.c_str(), &free, nullptr, nullptr) == 0 || free.QuadPart >= bytes;
}

}  // namespace d2b::system

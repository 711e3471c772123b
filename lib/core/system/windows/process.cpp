#include "core/system/process.hpp"

#include <algorithm>
#include <array>
#include <csignal>

#include "core/system/data_folder.hpp"
#include "core/system/windows/windows_api.hpp"

namespace d2b::system {
namespace {

std::string utf8(const wchar_t* text) {
    const int size = WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
    std::string result(static_cast<std::size_t>(std::max(size, 1)), '\0');
    WideCharToMultiByte(CP_UTF8, 0, text, -1, result.data(), size, nullptr, nullptr);
    result.pop_back();  // the zero at the end
    return result;
}

std::filesystem::path own_file() {
    constexpr DWORD most = 32768;
    std::wstring file(most, L'\0');
    file.resize(GetModuleFileNameW(nullptr, file.data(), most));
    return file;
}

}  // namespace

std::vector<std::string> arguments(int /*argc*/, const char* const* /*argv*/) {
    // Those of main() are in the code page of the user, which lacks most letters.
    int count = 0;
    wchar_t** const words = CommandLineToArgvW(GetCommandLineW(), &count);
    std::vector<std::string> result;
    for (int i = 1; words != nullptr && i < count; ++i)
        result.push_back(utf8(words[i]));
    LocalFree(words);
    return result;
}

std::int64_t process_id() {
    return GetCurrentProcessId();
}

const std::filesystem::path& data_beside_program() {
    static const std::filesystem::path data = data_folder_of(own_file());
    return data;
}

bool can_load_symbols() {
    return false;
}

void* load_symbol(const char* library, const char* /*function*/, std::string& reason) {
    reason = library;
    return nullptr;
}

void* find_symbol(const char* /*function*/) {
    return nullptr;
}

void catch_signals(void (*handler)(int)) {
    // The handler is called once, as the C library of Windows has it.
    for (const int signal : std::array{SIGINT, SIGTERM, SIGBREAK})
        static_cast<void>(std::signal(signal, handler));
}

void ignore_file_size_signal() {}

IgnoreBrokenPipe::IgnoreBrokenPipe() = default;

IgnoreBrokenPipe::~IgnoreBrokenPipe() = default;

}  // namespace d2b::system

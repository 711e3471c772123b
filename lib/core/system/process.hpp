#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace d2b::system {

/// Words of the command line in UTF-8, without the name of the program.
[[nodiscard]] std::vector<std::string> arguments(int argc, const char* const* argv);

[[nodiscard]] std::int64_t process_id();

/// Folder with the files of GDAL and PROJ, in `gdal` and `proj`, if the program or the module of Python
/// brings them along (core/system/data_folder.hpp); "" if GDAL and PROJ are those of the system. Looked up
/// once.
[[nodiscard]] const std::filesystem::path& data_beside_program();

/// False if load_symbol() never finds anything, because no such libraries are made for the system.
[[nodiscard]] bool can_load_symbols();
/// Loads a library on first use and returns one of its functions; it is never unloaded.
/// @param reason set to a text if there is no such library or function, and null is returned
[[nodiscard]] void* load_symbol(const char* library, const char* function, std::string& reason);
/// Returns a function that is in the process already, or null.
[[nodiscard]] void* find_symbol(const char* function);

/// Lets Ctrl-C and requests to end call `handler` instead of ending the process; a second one of the same
/// kind ends it. Nothing changes for a signal that the process was started with ignored.
void catch_signals(void (*handler)(int));
/// Lets writing fail at a limit of the size of files, instead of ending the process.
void ignore_file_size_signal();

/// Writing to a pipe without a reader fails, instead of ending the process, as long as this lives.
class IgnoreBrokenPipe {
  public:
    IgnoreBrokenPipe();
    IgnoreBrokenPipe(const IgnoreBrokenPipe&) = delete;
    IgnoreBrokenPipe& operator=(const IgnoreBrokenPipe&) = delete;
    ~IgnoreBrokenPipe();

  private:
    void (*before_)(int) = nullptr;
};

}  // namespace d2b::system

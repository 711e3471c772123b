#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

namespace d2b {

/// A file, or an empty folder, that goes when this goes.
struct Passing {
    std::filesystem::path path;  ///< "": nothing goes

    Passing() = default;
    explicit Passing(std::filesystem::path what) : path(std::move(what)) {}
    Passing(const Passing&) = delete;
    Passing& operator=(const Passing&) = delete;
    ~Passing();
};

/// The mosaic that plan makes of a list of rasters. Without keep() the work folder is as it was before.
class SourceMosaic {
  public:
    /// Keeps an existing mosaic that is the same. @throws InputError as build_mosaic(), OutputError;
    /// OptionError where another plan has another one
    SourceMosaic(const std::string& list, const std::filesystem::path& work, int band);
    void keep();

  private:
    Passing folder_;  ///< the work folder, where it was not there
    Passing file_;    ///< goes before it
};

/// @throws OptionError always
[[noreturn]] void refuse_other_plan(const std::filesystem::path& work);
/// @throws OutputError always: nothing can be written into the work folder
[[noreturn]] void refuse_folder(const std::filesystem::path& work, const std::error_code& error);

}  // namespace d2b

#include "write/destination.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "options/spoken_destination.hpp"
#include "write/local_path.hpp"

namespace d2b {

namespace {

namespace fs = std::filesystem;

std::string in_quotes(const std::string& text) {
    return "\"" + text + "\"";
}

void check_siblings(const std::string& name, const fs::path& path, const VectorFormat& format) {
    for (const std::string& suffix : format.suffixes) {
        const std::string file = path.filename().string();
        const fs::path sibling = path.parent_path() / (file.substr(0, file.find('.', 1)) + suffix);
        std::error_code error;
        if (sibling != path && fs::exists(sibling, error))
            throw OptionError("Writing " + in_quotes(name) + " would replace " + in_quotes(sibling.string()) +
                              "; remove that file first or choose another name.");
    }
}

void locate_local(Destination& destination, const VectorFormat& format) {
    const fs::path path = resolved_path(destination.name);
    destination.local = true;
    destination.path = path.string();
    std::error_code error;
    destination.exists = fs::exists(path, error);
    if (fs::is_directory(path, error)) {
        if (!format.folder)
            throw OptionError(in_quotes(destination.name) + " is a folder, and " + format.name +
                              " writes a file here; give the name of a file.");
        if (fs::is_empty(path, error))
            destination.exists = false;
    }
    check_parent_folder(destination.name, path);
    if (!destination.exists)
        check_siblings(destination.name, path, format);
}

}  // namespace

void refuse_archive(const std::string& name) {
    constexpr std::array archives{"/vsizip/", "/vsitar/", "/vsi7z/", "/vsirar/"};
    constexpr std::array read_only{"/vsicurl/",    "/vsicurl?",  "/vsicurl_streaming/",
                                   "/vsisubfile/", "/vsistdin/", "/vsistdin?"};
    const auto begins = [&](const char* prefix) { return name.starts_with(prefix); };
    if (std::ranges::any_of(archives, begins))
        throw OptionError(
            in_quotes(name) +
            " lies in an archive, into which nothing is written; give a file, and pack it then.");
    if (std::ranges::any_of(read_only, begins))
        throw OptionError(in_quotes(name) + " can only be read; give a file.");
}

Destination locate(const WriteOptions& options, const VectorFormat& format) {
    if (options.overwrite && options.append)
        throw OptionError("-overwrite and -append exclude each other; give one of them.");
    Destination destination{.name = spoken_destination(options.destination), .path = options.destination};
    if (is_stream(options.destination) || is_connection(format.driver, options.destination))
        return destination;
    refuse_archive(options.destination);
    if (options.destination.starts_with("/vsi")) {
        VSIStatBufL status{};
        destination.exists = VSIStatExL(options.destination.c_str(), &status,
                                        VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) == 0;
    } else {
        locate_local(destination, format);
    }
    if (destination.exists && !options.overwrite && !options.append)
        throw OptionError(
            in_quotes(options.destination) +
            " exists; give -overwrite to replace the layers of this run in it, or -append to add to "
            "them.");
    return destination;
}

}  // namespace d2b

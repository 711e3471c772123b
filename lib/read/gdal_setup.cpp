#include "read/gdal_setup.hpp"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstddef>
#include <filesystem>
#include <iterator>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include "core/system/process.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"

namespace d2b::reading {
namespace {

/// Keeps libtiff's global handler from printing, because GDAL 3.10 reports failed reads and writes through
/// handlers of its own and leaves lines such as "_tiffWriteProc: No space left on device." to the global one.
/// Looked up at run time, because GDAL may have been built with a libtiff of its own.
void silence_libtiff() {
    using Handler = void (*)(const char*, const char*, va_list);
    using SetHandler = Handler (*)(Handler);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): systems return functions as data
    if (const auto set = reinterpret_cast<SetHandler>(system::find_symbol("TIFFSetErrorHandler")))
        set(nullptr);
}

/// Splits KEY=VALUE, because GDAL 3.6 takes it for the key and the next argument for its value.
void split_config(std::vector<std::string>& arguments) {
    for (std::size_t i = 0; i + 1 < arguments.size(); ++i) {
        const std::string pair = arguments[i + 1];
        const auto equals = pair.find('=');
        if (arguments[i] != "--config" || equals == std::string::npos)
            continue;
        arguments[i + 1] = pair.substr(0, equals);
        arguments.insert(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 2, pair.substr(equals + 1));
    }
}

/// Sets options that GDAL reads when its drivers register (GDAL_SKIP, GDAL_DRIVER_PATH, ...). They must be
/// set earlier than by GDAL's processor of switches, because that needs registered drivers.
void set_config(const std::vector<std::string>& arguments) {
    for (std::size_t i = 0; i + 2 < arguments.size(); ++i)
        if (arguments[i] == "--config")
            CPLSetConfigOption(arguments[i + 1].c_str(), arguments[i + 2].c_str());
}

using Arguments = GdalOwner<char**, CSLDestroy>;

Arguments list_of(const std::vector<std::string>& arguments) {
    // Stands for the name of the program; only messages about --optfile use it.
    Arguments list(CSLAddString(nullptr, "dem2buildings"));
    for (const std::string& argument : arguments)
        list.reset(CSLAddString(list.release(), argument.c_str()));
    return list;
}

}  // namespace

void register_formats() {
    if (GDALGetDriverCount() > 0)
        return;
    if (const std::filesystem::path& data = system::data_beside_program(); !data.empty()) {
        CPLPushFinderLocation((data / "gdal").string().c_str());
        const std::string proj = (data / "proj").string();
        const std::array<const char*, 2> folders{proj.c_str(), nullptr};
        OSRSetPROJSearchPaths(folders.data());
    }
    GDALAllRegister();
}

void start_gdal() {
    // Messages of GDAL's worker threads, or outside of our own scopes, go to the handler of the process. This
    // one drops everything except debug messages, which appear only if CPL_DEBUG asks for them.
    CPLSetErrorHandler(CPLQuietErrorHandler);
    register_formats();
    silence_libtiff();
    // Limits the cache, because rasters are read once from top to bottom and GDAL would keep a twentieth of
    // the machine's memory.
    constexpr GIntBig cache_bytes = GIntBig{128} << 20;
    if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) == nullptr)
        GDALSetCacheMax64(cache_bytes);
}

std::optional<std::vector<std::string>> apply_gdal_switches(std::vector<std::string> arguments) {
    const auto end = std::ranges::find(arguments, "--");
    const std::vector<std::string> file_names(end, arguments.end());
    arguments.erase(end, arguments.end());
    split_config(arguments);
    std::ranges::replace(arguments, "--version", "-version");  // keeps GDAL from printing its own version
    set_config(arguments);

    const GdalMessages messages;
    register_formats();
    const Arguments given = list_of(arguments);
    char** left = given.get();
    const int count = GDALGeneralCmdLineProcessor(static_cast<int>(arguments.size()) + 1, &left,
                                                  GDAL_OF_RASTER | GDAL_OF_VECTOR);
    if (count < 0)
        throw OptionError(messages.reason() + ".");
    if (count == 0)
        return std::nullopt;
    const Arguments owner(left);  // the processor returns a separate list
    std::vector<std::string> rest(left + 1, left + count);
    rest.insert(rest.end(), file_names.begin(), file_names.end());
    return rest;
}

std::string gdal_version() {
    return GDALVersionInfo("RELEASE_NAME");
}

}  // namespace d2b::reading

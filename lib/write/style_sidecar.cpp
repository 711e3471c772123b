#include "write/style_sidecar.hpp"

#include <fstream>
#include <system_error>
#include <vector>

#include <cpl_vsi.h>

#include "read/gdal_messages.hpp"
#include "write/qml_style.hpp"

namespace d2b {

namespace fs = std::filesystem;

void write_style_beside(const std::string& path, const NewLayer& layer) {
    if (layer.spec.style.title.empty())
        return;
    const bool single = fs::path(path).extension() == ".shp";
    const fs::path file =
        single ? fs::path(path).replace_extension(".qml") : fs::path(path) / (layer.table + ".qml");
    const std::string text = qml_style(layer.spec, layer.columns);
    // Failed writes are detected by the VSI layer that monitors the files.
    const GdalMessages quiet;
    VSILFILE* out = VSIFOpenL(file.c_str(), "wb");
    if (out == nullptr)
        return;
    const bool whole = VSIFWriteL(text.data(), 1, text.size(), out) == text.size();
    if (VSIFCloseL(out) != 0 || !whole)
        VSIUnlink(file.c_str());
}

bool is_our_style(const fs::path& file) {
    constexpr int lines = 3;
    std::ifstream in(file);
    std::string line;
    for (int i = 0; i < lines && std::getline(in, line); ++i)
        if (line + "\n" == style_mark)
            return true;
    return false;
}

void keep_users_styles(const fs::path& result, const fs::path& destination, bool replaces) {
    std::error_code error;
    const bool folder = fs::is_directory(result, error);
    const fs::path ours = folder ? result : result.parent_path();
    const fs::path theirs = folder ? destination : destination.parent_path();
    std::vector<fs::path> styles;
    for (const auto& entry : fs::directory_iterator(ours, error))
        if (entry.path().extension() == ".qml")
            styles.push_back(entry.path());
    for (const fs::path& style : styles) {
        const fs::path there = theirs / style.filename();
        if (!fs::exists(there, error) || (replaces && is_our_style(there)))
            continue;
        if (folder)
            fs::copy_file(there, style, fs::copy_options::overwrite_existing, error);
        else
            fs::remove(style, error);
    }
}

}  // namespace d2b

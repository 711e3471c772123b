#include "write/staging.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <set>
#include <system_error>
#include <utility>

#include "dem2buildings/error.hpp"
#include "write/file_moves.hpp"

namespace d2b {

namespace {

namespace fs = std::filesystem;

fs::path parent_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

OutputError cannot_write(const std::string& name, const std::string& reason) {
    return OutputError("Cannot write \"" + name + "\": " + reason + ".");
}

/// Copies the permissions of the replaced file.
void take_permissions(const fs::path& from, const fs::path& to) {
    std::error_code error;
    const fs::file_status status = fs::status(from, error);
    if (!error && fs::is_regular_file(status))
        fs::permissions(to, status.permissions(), error);
}

}  // namespace

Staging::Staging(std::string name, fs::path destination)
    : name_(std::move(name)), destination_(std::move(destination)) {
    const fs::path parent = parent_of(destination_);
    // Leave out the extension, because /vsizip/ would take "a.ods" anywhere in a path for an archive.
    std::string pattern = (parent / ".dem2buildings.XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
        throw cannot_write(name_, "the folder \"" + parent.string() + "\" takes no new files (" +
                                      std::generic_category().message(errno) +
                                      "); choose another destination");
    folder_ = pattern;
}

Staging::~Staging() {
    moves_.keep();
    std::error_code ignored;
    if (!keeps_old_)
        fs::remove_all(folder_, ignored);
}

void Staging::copy_in(const std::vector<std::string>& files) {
    try {
        if (fs::is_directory(destination_))
            fs::copy(destination_, dataset(), fs::copy_options::recursive);
        else
            for (const fs::path file : files)
                fs::copy_file(file, folder_ / file.filename());
    } catch (const fs::filesystem_error& error) {
        throw cannot_write(name_, "it cannot be copied (" + error.code().message() + ")");
    }
}

void Staging::seal() {
    result_.clear();
    for (const auto& entry : fs::directory_iterator(folder_))
        result_.push_back(entry.path().filename());
    const fs::path main = destination_.filename();
    std::sort(result_.begin(), result_.end(), [&main](const fs::path& a, const fs::path& b) {
        return std::pair(a == main, a) < std::pair(b == main, b);
    });
    if (result_.empty() || result_.back() != main)
        throw cannot_write(name_, "the driver has written no file of this name");
    for (const fs::path& file : result_)
        take_permissions(parent_of(destination_) / file, folder_ / file);
}

void Staging::sync() const {
    try {
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            sync_to_disk(entry.path());
    } catch (const std::system_error& error) {
        throw cannot_write(name_, error.code().message());
    }
}

void Staging::publish(const std::vector<std::string>& old_files) {
    try {
        if (fs::is_directory(dataset()))
            publish_folder(!old_files.empty());
        else
            publish_files(old_files);
    } catch (const std::system_error& error) {
        const std::string left = take_back();
        throw cannot_write(name_, "the finished result cannot be renamed (" + error.code().message() + ")" +
                                      (left.empty() ? "" : "; " + left));
    }
}

std::string Staging::confirm() const {
    try {
        sync_to_disk(parent_of(destination_));
    } catch (const std::system_error& error) {
        return error.code().message();
    }
    return "";
}

std::string Staging::take_back() {
    const std::vector<fs::path> left = moves_.take_back();
    if (left.empty())
        return "";
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder_, ignored))
        if (std::ranges::find(left, entry.path()) == left.end())
            fs::remove_all(entry.path(), ignored);
        else
            keeps_old_ = true;
    if (keeps_old_)
        return "old files of \"" + name_ + "\" lie in \"" + folder_.string() + "\" now";
    return fs::exists(destination_, ignored) ? "\"" + name_ + "\" is there already" : "";
}

void Staging::publish_folder(bool replaces) {
    if (!fs::exists(fs::symlink_status(destination_))) {
        moves_.move(dataset(), destination_);
        return;
    }
    // An empty folder may exist already; files of others must not be lost.
    if (!replaces && !(fs::is_directory(destination_) && fs::is_empty(destination_)))
        throw std::system_error(EEXIST, std::generic_category());
    moves_.replace(dataset(), destination_, folder_ / "old");
}

void Staging::publish_files(const std::vector<std::string>& old_files) {
    std::set<fs::path> old;
    for (const fs::path file : old_files)
        old.insert(file.filename());
    const fs::path parent = parent_of(destination_);
    for (const fs::path& file : old)
        if (std::ranges::find(result_, file) == result_.end())
            moves_.move(parent / file, folder_ / file);
    for (const fs::path& file : result_)
        if (old.contains(file))
            moves_.replace(folder_ / file, parent / file, folder_ / (file.string() + ".old"));
        else
            moves_.move(folder_ / file, parent / file);
}

}  // namespace d2b

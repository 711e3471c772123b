#include "write/write_watch.hpp"

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <memory>

#include <cpl_string.h>
#include <cpl_vsi.h>

namespace d2b {

namespace {

struct WatchedFile {
    VSILFILE* file;
    WriteWatch& watch;
};

WatchedFile& watched(void* file) {
    return *static_cast<WatchedFile*>(file);
}

/// Returns a dummy file that discards the output of a driver whose file could not be created.
VSILFILE* stand_in(const WriteWatch& watch) {
    const std::string name = "/vsimem" + watch.name_of("/lost");
    VSILFILE* file = VSIFOpenL(name.c_str(), "w+b");
    VSIUnlink(name.c_str());
    return file;
}

void* open_file(void* watch, const char* name, const char* access) {
    auto& self = *static_cast<WriteWatch*>(watch);
    errno = 0;
    VSILFILE* file = VSIFOpenL(name, access);
    if (file == nullptr) {
        if (access[0] != 'w')
            return nullptr;
        self.note(errno);
        file = stand_in(self);
    }
    return new WatchedFile{file, self};
}

size_t write_file(void* file, const void* data, size_t size, size_t count) {
    const WatchedFile& self = watched(file);
    errno = 0;
    const size_t written = VSIFWriteL(data, size, count, self.file);
    if (written < count) {
        self.watch.note(errno);
        VSIFSeekL(self.file, VSIFTellL(self.file) + (count - written) * size, SEEK_SET);
    }
    return count;
}

int flush_file(void* file) {
    errno = 0;
    if (VSIFFlushL(watched(file).file) != 0)
        watched(file).watch.note(errno);
    return 0;
}

int truncate_file(void* file, vsi_l_offset size) {
    errno = 0;
    if (VSIFTruncateL(watched(file).file, size) != 0)
        watched(file).watch.note(errno);
    return 0;
}

int close_file(void* file) {
    const std::unique_ptr<WatchedFile> self(&watched(file));
    errno = 0;
    if (VSIFCloseL(self->file) != 0)
        self->watch.note(errno);
    return 0;
}

int stat_file(void*, const char* name, VSIStatBufL* status, int flags) {
    return VSIStatExL(name, status, flags);
}

int unlink_file(void*, const char* name) {
    return VSIUnlink(name);
}

int rename_file(void* watch, const char* from, const char* to) {
    // The new name has the prefix or not, depending on the version of GDAL.
    const auto& self = *static_cast<WriteWatch*>(watch);
    const std::string prefix = self.name_of("");
    const std::string target = std::string(to).starts_with(prefix) ? to + prefix.size() : to;
    errno = 0;
    const int result = VSIRename(from, target.c_str());
    if (result != 0)
        static_cast<WriteWatch*>(watch)->note(errno);
    return result;
}

int make_folder(void* watch, const char* name, long mode) {
    errno = 0;
    const int result = VSIMkdir(name, mode);
    if (result != 0 && errno != EEXIST)
        static_cast<WriteWatch*>(watch)->note(errno);
    return result;
}

int remove_folder(void*, const char* name) {
    return VSIRmdir(name);
}

char** list_folder(void*, const char* name, int most) {
    return VSIReadDirEx(name, most);
}

}  // namespace

WriteWatch::WriteWatch()
    // The path after the prefix is absolute, because GDAL 3.6 deletes files by it without calling the
    // handler. The address of this object makes the prefix unique in the process.
    : prefix_("/vsid2b" + std::to_string(reinterpret_cast<std::uintptr_t>(this)) + "/") {
    const std::unique_ptr<VSIFilesystemPluginCallbacksStruct, void (*)(VSIFilesystemPluginCallbacksStruct*)>
        calls(VSIAllocFilesystemPluginCallbacksStruct(), VSIFreeFilesystemPluginCallbacksStruct);
    calls->pUserData = this;
    calls->stat = stat_file;
    calls->unlink = unlink_file;
    calls->rename = rename_file;
    calls->mkdir = make_folder;
    calls->rmdir = remove_folder;
    calls->read_dir = list_folder;
    calls->open = open_file;
    calls->tell = [](void* file) { return VSIFTellL(watched(file).file); };
    calls->seek = [](void* file, vsi_l_offset to, int from) {
        return VSIFSeekL(watched(file).file, to, from);
    };
    calls->read = [](void* file, void* data, size_t size, size_t count) {
        return VSIFReadL(data, size, count, watched(file).file);
    };
    calls->eof = [](void* file) { return VSIFEofL(watched(file).file); };
    calls->write = write_file;
    calls->flush = flush_file;
    calls->truncate = truncate_file;
    calls->close = close_file;
    VSIInstallPluginHandler(prefix_.c_str(), calls.get());
}

std::string WriteWatch::name_of(const std::string& path) const {
    return prefix_ + (path.empty() ? "" : std::filesystem::absolute(path).lexically_normal().string());
}

void WriteWatch::note(int error) {
    if (error_ == 0)
        error_ = error == 0 ? EIO : error;
}

}  // namespace d2b

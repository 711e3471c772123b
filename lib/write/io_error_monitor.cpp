#include "write/io_error_monitor.hpp"

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <system_error>

#include <cpl_string.h>
#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"

namespace d2b::writing {

namespace {

struct MonitoredFile {
    VSILFILE* file;
    IoErrorMonitor& monitor;
};

MonitoredFile& monitored(void* file) {
    return *static_cast<MonitoredFile*>(file);
}

/// Returns a dummy file that discards the output of a driver whose file could not be created.
VSILFILE* discarding_file(const IoErrorMonitor& monitor) {
    const std::string name = "/vsimem" + monitor.name_of("/lost");
    VSILFILE* file = VSIFOpenL(name.c_str(), "w+b");
    VSIUnlink(name.c_str());
    return file;
}

void* open_file(void* monitor, const char* name, const char* access) {
    auto& self = *static_cast<IoErrorMonitor*>(monitor);
    errno = 0;
    VSILFILE* file = VSIFOpenL(name, access);
    if (file == nullptr) {
        if (access[0] != 'w')
            return nullptr;
        self.record(errno);
        file = discarding_file(self);
    }
    return new MonitoredFile{file, self};
}

size_t write_file(void* file, const void* data, size_t size, size_t count) {
    const MonitoredFile& self = monitored(file);
    errno = 0;
    const size_t written = VSIFWriteL(data, size, count, self.file);
    if (written < count) {
        self.monitor.record(errno);
        VSIFSeekL(self.file, VSIFTellL(self.file) + (count - written) * size, SEEK_SET);
    }
    return count;
}

/// Seeking and reading write a buffer first.
int seek_file(void* file, vsi_l_offset to, int from) {
    errno = 0;
    const int result = VSIFSeekL(monitored(file).file, to, from);
    if (result != 0 && errno != EINVAL)
        monitored(file).monitor.record(errno);
    return result;
}

size_t read_file(void* file, void* data, size_t size, size_t count) {
    errno = 0;
    const size_t read = VSIFReadL(data, size, count, monitored(file).file);
    if (read < count && errno != 0 && errno != EISDIR)  // GDAL 3.13 tries to read folders
        monitored(file).monitor.record(errno);
    return read;
}

int flush_file(void* file) {
    errno = 0;
    if (VSIFFlushL(monitored(file).file) != 0)
        monitored(file).monitor.record(errno);
    return 0;
}

int truncate_file(void* file, vsi_l_offset size) {
    errno = 0;
    if (VSIFTruncateL(monitored(file).file, size) != 0)
        monitored(file).monitor.record(errno);
    return 0;
}

int close_file(void* file) {
    if (file == nullptr)
        return 0;  // GDAL 3.13 closes some files twice
    const std::unique_ptr<MonitoredFile> self(&monitored(file));
    errno = 0;
    if (VSIFCloseL(self->file) != 0)
        self->monitor.record(errno);
    return 0;
}

int stat_file(void*, const char* name, VSIStatBufL* status, int flags) {
    return VSIStatExL(name, status, flags);
}

int unlink_file(void*, const char* name) {
    return VSIUnlink(name);
}

int rename_file(void* monitor, const char* from, const char* to) {
    // The new name has the prefix or not, depending on the version of GDAL.
    auto& self = *static_cast<IoErrorMonitor*>(monitor);
    const std::string prefix = self.name_of("");
    const std::string target = std::string(to).starts_with(prefix) ? to + prefix.size() : to;
    errno = 0;
    const int result = VSIRename(from, target.c_str());
    if (result != 0)
        self.record(errno);
    return result;
}

int make_folder(void* monitor, const char* name, long mode) {
    errno = 0;
    const int result = VSIMkdir(name, mode);
    if (result != 0 && errno != EEXIST)
        static_cast<IoErrorMonitor*>(monitor)->record(errno);
    return result;
}

int remove_folder(void*, const char* name) {
    return VSIRmdir(name);
}

char** list_folder(void*, const char* name, int most) {
    return VSIReadDirEx(name, most);
}

}  // namespace

IoErrorMonitor::IoErrorMonitor()
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
    calls->tell = [](void* file) { return VSIFTellL(monitored(file).file); };
    calls->seek = seek_file;
    calls->read = read_file;
    calls->eof = [](void* file) { return VSIFEofL(monitored(file).file); };
    calls->write = write_file;
    calls->flush = flush_file;
    calls->truncate = truncate_file;
    calls->close = close_file;
    VSIInstallPluginHandler(prefix_.c_str(), calls.get());
}

std::string IoErrorMonitor::name_of(const std::string& path) const {
    return prefix_ + (path.empty() ? "" : std::filesystem::absolute(path).lexically_normal().string());
}

void IoErrorMonitor::require_written(const std::string& name) const {
    if (error_ != 0)
        throw OutputError("Cannot write \"" + name + "\": " + std::generic_category().message(error_) + ".");
}

void IoErrorMonitor::record(int error) {
    if (error_ == 0)
        error_ = error == 0 ? EIO : error;
}

}  // namespace d2b::writing

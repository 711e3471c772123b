#pragma once

#include <array>
#include <optional>
#include <string>

#include <cpl_conv.h>
#include <gdal.h>

#include "read/gdal_handles.hpp"

namespace d2b::reading {

/// Blocks network access that GDAL would make because a file asks for it: the CRS behind a link in a GeoJSON,
/// the schema of a GML, overviews on a server. Without it, opening somebody else's file could notify a
/// stranger's server or reach servers of an internal network. Access is granted to sources that the user
/// named:
/// - a name with an address, or of a cloud store, lets GDAL access that server;
/// - formats that are lists of addresses (VRT, WMS, WFS etc.) name servers on behalf of the user.
/// A CRS is never fetched. The gate is active in its own thread for its lifetime; gates may nest. Drivers
/// that open their sources lazily need a gate while they are read, too.
class NetworkGuard {
  public:
    /// @param name of a dataset, as given by the user
    explicit NetworkGuard(const std::string& name);
    /// Gate for an open dataset; null for one in memory.
    explicit NetworkGuard(GDALDatasetH dataset);
    NetworkGuard(const NetworkGuard&) = delete;
    NetworkGuard& operator=(const NetworkGuard&) = delete;
    ~NetworkGuard();

    [[nodiscard]] bool blocks_all() const { return fetching_ == Fetching::none; }
    /// Returns true if an address may be fetched.
    [[nodiscard]] bool allows(const std::string& address) const;

  private:
    enum class Fetching { none, one_server, any };

    /// Permission that a name alone implies.
    [[nodiscard]] static Fetching access_of(const std::string& name);
    void close();

    std::string name_;
    Fetching fetching_;
    std::optional<CPLConfigOptionSetter> no_files_;  ///< set by close() if nothing is fetched
};

/// Prefixes of remote file systems. They may be nested: /vsizip//vsicurl/...
inline constexpr std::array remote_prefixes{"/vsicurl", "/vsis3",    "/vsigs",      "/vsiaz",  "/vsiadls",
                                            "/vsioss",  "/vsiswift", "/vsiwebhdfs", "/vsihdfs"};

/// Reason why a name cannot be opened if GDAL was built without the file system that it names, such as that
/// of servers; otherwise "". GDAL itself would say that the file does not exist.
[[nodiscard]] std::string missing_file_system(const std::string& name);

/// Calls GDALOpenEx() behind a gate. @param drivers null for all @return null if it cannot be opened
[[nodiscard]] DatasetOwner open_guarded(const std::string& name, unsigned flags,
                                        const char* const* drivers = nullptr,
                                        const char* const* open_options = nullptr);

}  // namespace d2b::reading

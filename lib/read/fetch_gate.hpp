#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gdal.h>

#include "read/gdal_handles.hpp"

namespace d2b {

/// Holds back what GDAL would fetch because a file asks for it: the CRS behind a link in a GeoJSON, the
/// schema of a GML, overviews on a server. Who has data of somebody else looked at would tell a stranger's
/// server of it, or reach servers of a network that are not the stranger's to ask. Fetched is what the user
/// named:
/// - a name with an address, or of a cloud's store, lets GDAL ask that server;
/// - formats that are lists of addresses (VRT, WMS, WFS and their like) name servers in the user's stead.
/// A CRS is never fetched. The gate works in its own thread for as long as it lives; gates may nest, and
/// drivers that open what they list late need one while they are read, too.
class FetchGate {
  public:
    /// @param name of a dataset, as the user gave it
    explicit FetchGate(const std::string& name);
    /// Of a dataset that is open; null for one in memory.
    explicit FetchGate(GDALDatasetH dataset);
    FetchGate(const FetchGate&) = delete;
    FetchGate& operator=(const FetchGate&) = delete;
    ~FetchGate();

    [[nodiscard]] bool lets_nothing_through() const { return fetching_ == Fetching::none; }
    /// Whether an address may be fetched.
    [[nodiscard]] bool lets_through(const std::string& address) const;

  private:
    enum class Fetching { none, one_server, any };

    /// By what a name says of itself.
    [[nodiscard]] static Fetching named_by(const std::string& name);
    void close();

    std::string name_;
    Fetching fetching_;
    std::optional<std::string> file_before_;  ///< the option that close() sets
};

/// GDALOpenEx() behind a gate. @param drivers null for all @return null where it cannot be opened
[[nodiscard]] DatasetOwner open_gated(const std::string& name, unsigned flags,
                                      const char* const* drivers = nullptr,
                                      const char* const* open_options = nullptr);

}  // namespace d2b

#pragma once

#include <string>
#include <vector>

#include "write/destination.hpp"
#include "write/existing_dataset.hpp"

namespace d2b {

/// True if the name is among the names; case-insensitive, because OGR compares layer names like that.
[[nodiscard]] bool named(const std::vector<std::string>& names, const std::string& name);

/// Checks formats whose datasets are replaced whole. @param names layers that the run writes
/// @throws OptionError if layers or files of others would be lost
void refuse_foreign(const Destination& destination, const ExistingDataset& existing, GDALDatasetH dataset,
                    const VectorFormat& format, const WriteOptions& options,
                    const std::vector<std::string>& names);

/// @throws OutputError if a database cannot be opened for writing @throws OptionError if -append is given and
/// the driver cannot append to existing layers
void require_writable(const Destination& destination, const VectorFormat& format, const WriteOptions& options,
                      const std::vector<std::string>& names);

}  // namespace d2b

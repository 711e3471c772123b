#pragma once

#include <string>
#include <vector>

#include "write/destination.hpp"
#include "write/existing_dataset.hpp"

namespace d2b {

/// Whether the name is among the names, in any case, as OGR compares names of layers.
[[nodiscard]] bool named(const std::vector<std::string>& names, const std::string& name);

/// For what is replaced as a whole. @param names layers that the run writes
/// @throws OptionError where layers or files of others would be lost
void refuse_foreign(const Destination& destination, const ExistingDataset& existing, GDALDatasetH dataset,
                    const VectorFormat& format, const WriteOptions& options,
                    const std::vector<std::string>& names);

/// @throws OutputError where a database cannot be opened for writing @throws OptionError where -append is
/// asked for and the driver adds no features to layers that are there
void require_writable(const Destination& destination, const VectorFormat& format, const WriteOptions& options,
                      const std::vector<std::string>& names);

}  // namespace d2b

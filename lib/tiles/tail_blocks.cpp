#include "tiles/tail_blocks.hpp"

#include <utility>

namespace d2b {

void TailBlocks::add(const ByteWriter& block) {
    if (block.bytes().empty())
        return;
    blocks_.push_back({block.bytes().size(), digest_of(block.bytes())});
    bytes_.insert(bytes_.end(), block.bytes().begin(), block.bytes().end());
}

ByteReader read_block(const SealedFile& file, std::uint64_t begin, const TailBlocks::Block& block) {
    std::vector<std::byte> bytes = file.tail(begin, block.size);
    if (digest_of(bytes) != block.digest)
        throw InputError(file.damaged("its bytes are not those that were written"));
    return ByteReader(std::move(bytes));
}

}  // namespace d2b

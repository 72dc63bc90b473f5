#pragma once
// Compressed blocks of bytes, as XML VTK files hold them.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dartboard {

enum class Compressor { zlib, lz4, lzma };

/// The compressor of VTK's name for it, as in vtkZLibDataCompressor.
std::optional<Compressor> compressor_of_vtk(std::string_view name);

/// The most bytes that so many compressed ones can become: a file that promises more need not be given the memory.
std::uint64_t largest_expansion(Compressor compressor, std::uint64_t compressed);

/// Append the content of a block, which has exactly `size` bytes; false, and nothing appended, when it has not.
///
/// pre  size <= largest_expansion(compressor, block.size())
bool decompress(Compressor compressor, std::string_view block, std::size_t size, std::string& out);

}  // namespace dartboard

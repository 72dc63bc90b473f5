#pragma once
// Compressed blocks of bytes, as XML VTK files hold them.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dartboard {

enum class Compressor { zlib, lz4 };

/// The compressor with this name in VTK, such as vtkZLibDataCompressor.
std::optional<Compressor> compressor_of_vtk(std::string_view name);
std::string_view vtk_name(Compressor compressor);

/// The most bytes that so many compressed bytes can expand to: a file that promises more is refused the memory.
std::uint64_t largest_expansion(Compressor compressor, std::uint64_t compressed);

/// Append the content of a block, which must have exactly `size` bytes; otherwise false, and nothing is appended.
///
/// pre  size <= largest_expansion(compressor, block.size())
bool decompress(Compressor compressor, std::string_view block, std::size_t size, std::string& out);

/// Appends the compressed block, with the compressor at its fastest, and returns its length.
///
/// pre  less than a GiB
std::size_t append_compressed(Compressor compressor, std::string_view block, std::string& out);

}  // namespace dartboard

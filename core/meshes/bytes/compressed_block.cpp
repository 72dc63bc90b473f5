#include "core/meshes/bytes/compressed_block.h"

#include <lz4.h>
#include <zlib.h>

#include <limits>
#include <new>

namespace dartboard {
namespace {

bool inflate_zlib(std::string_view block, char* to, std::size_t size) {
  uLongf written = size;
  uLong used = block.size();
  const int status =
      uncompress2(reinterpret_cast<Bytef*>(to), &written, reinterpret_cast<const Bytef*>(block.data()), &used);
  return status == Z_OK && written == size && used == block.size();
}

bool inflate_lz4(std::string_view block, char* to, std::size_t size) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (block.size() > most || size > most) return false;
  return LZ4_decompress_safe(block.data(), to, static_cast<int>(block.size()), static_cast<int>(size)) ==
         static_cast<int>(size);
}

}  // namespace

std::optional<Compressor> compressor_of_vtk(std::string_view name) {
  for (const Compressor one : {Compressor::zlib, Compressor::lz4})
    if (name == vtk_name(one)) return one;
  return std::nullopt;
}

std::string_view vtk_name(Compressor compressor) {
  return compressor == Compressor::zlib ? "vtkZLibDataCompressor" : "vtkLZ4DataCompressor";
}

// Deflate: 258 bytes for two bits. LZ4: 255 for a byte of a length. Each with some more for its last match.
std::uint64_t largest_expansion(Compressor compressor, std::uint64_t compressed) {
  const std::uint64_t each = compressor == Compressor::zlib ? 1032 : 255;
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  return compressed >= most / each - 1 ? most : (compressed + 1) * each;
}

bool decompress(Compressor compressor, std::string_view block, std::size_t size, std::string& out) {
  const std::size_t before = out.size();
  out.resize(before + size);
  char* const to = out.data() + before;
  const bool whole = compressor == Compressor::zlib ? inflate_zlib(block, to, size) : inflate_lz4(block, to, size);
  if (!whole) out.resize(before);
  return whole;
}

// The fastest of each: coordinates shrink little, whatever the effort, and numbers of cells much with any.
std::size_t append_compressed(Compressor compressor, std::string_view block, std::string& out) {
  const std::size_t before = out.size();
  std::size_t size = 0;
  switch (compressor) {
    case Compressor::zlib: {
      uLongf written = compressBound(block.size());
      out.resize(before + written);
      const int status = compress2(reinterpret_cast<Bytef*>(out.data() + before), &written,
                                   reinterpret_cast<const Bytef*>(block.data()), block.size(), Z_BEST_SPEED);
      size = status == Z_OK ? written : 0;
      break;
    }
    case Compressor::lz4: {
      const int most = LZ4_compressBound(static_cast<int>(block.size()));
      out.resize(before + static_cast<std::size_t>(most));
      size = static_cast<std::size_t>(
          LZ4_compress_default(block.data(), out.data() + before, static_cast<int>(block.size()), most));
      break;
    }
  }
  if (size == 0) throw std::bad_alloc();  // no other cause is left: there is room for the largest result
  out.resize(before + size);
  return size;
}

}  // namespace dartboard
